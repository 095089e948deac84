#include <surefoot/clip/foot_prints.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/harmonic/harmonic_gait.h>
#include <surefoot/ik/two_bone.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

/// cos and sin of the multiples of a phase.
struct Waves {
    std::array<float, 1 + 2 * k_most_harmonics> wave;

    Waves() noexcept {}  // not set
    Waves(float phase, int harmonics) noexcept {
        const SinCos first = sin_cos(2 * k_pi * static_cast<double>(phase));
        double c = 1, s = 0;
        wave[0] = 1;
        for (int k = 1; k <= harmonics; ++k) {
            const double next = c * first.cos - s * first.sin;
            s = s * first.cos + c * first.sin;
            c = next;
            wave[at(2 * k - 1)] = static_cast<float>(c);
            wave[at(2 * k)] = static_cast<float>(s);
        }
    }
};

/// Reads series one after the other.
class SeriesReader {
  public:
    SeriesReader(const float* values, const Waves& waves, int harmonics) noexcept
        : values_(values), waves_(&waves), length_(1 + 2 * harmonics) {}

    float next() noexcept {
        float sum = 0;
        for (int i = 0; i < length_; ++i) sum += values_[i] * waves_->wave[at(i)];
        values_ += length_;
        return sum;
    }
    Vec3 next_vector() noexcept {
        const float x = next(), y = next();
        return {x, y, next()};
    }
    void use(const Waves& waves) noexcept { waves_ = &waves; }

  private:
    const float* values_;
    const Waves* waves_;
    int length_;
};

/// The foot seen from the root, from its series at its own phase.
FootGoal foot_goal(const HarmonicGait& gait, const GaitRhythm& rhythm, std::size_t side, float phase,
                   std::span<const float> values) noexcept {
    const float strike = side == 0 ? 0.0f : 0.5f, share = phase - strike - std::floor(phase - strike);
    const FootPrint print = foot_print(gait, values, side, foot_series_phase(share, rhythm.lift[side], gait.foot_lift));
    const FootStep step = step_of(rhythm, side);
    const float age = foot_age(step, step, since_strike(rhythm, side, share));
    const RootFrame moved = integrate(rhythm.velocity, rhythm.turn_rate, age);
    const Transform stands = stand_on(gait.legs.side[side], print.rotation, print.heel, print.ball);
    return {inverse(to_transform(moved)) * stands, print.toes};
}

Transform model_of(const Skeleton& skeleton, std::span<const Transform> locals, int joint) noexcept {
    Transform model;
    for (; joint != k_no_joint; joint = skeleton.parents[at(joint)]) model = locals[at(joint)] * model;
    return model;
}

/// How far a hip has to sink [m] so that its leg, on the way to straight, slows down softly: near straight, a
/// centimetre of reach is worth 20 degrees of knee, and means over many strides are that far off.
float hip_drop(Vec3 hip, Vec3 ankle, float leg, float free) noexcept {
    const float reach = distance(hip, ankle), limited = soft_limit(reach, leg, free, 0);
    if (limited >= reach) return 0;
    const float aside = planar_length(hip - ankle), height = hip.y - ankle.y;
    return std::max(0.0f, height - std::sqrt(std::max(0.0f, limited * limited - aside * aside)));
}

/// Lowers the hips as far as both legs need.
void lower_hips(const Skeleton& skeleton, const Legs& soles, const std::array<FootGoal, 2>& feet, float free,
                std::span<Transform> locals) noexcept {
    float drop = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const Leg& leg = soles.side[side];
        drop += hip_drop(model_of(skeleton, locals, leg.upper).translation, feet[side].foot.translation, leg.length(),
                         free);
    }
    const int hips = soles.hips;
    const Transform parent = model_of(skeleton, locals, skeleton.parents[at(hips)]);
    locals[at(hips)].translation += rotate(conjugate(parent.rotation), {0, -drop, 0});
}

/// Bends toes upwards that would go under the floor as the foot rolls over its ball: many captures know no toes.
void bend_toes(const Leg& leg, const Skeleton& skeleton, FootGoal& goal) noexcept {
    if (leg.toes == k_no_joint || skeleton.parents[at(leg.toes)] != leg.foot) return;
    const Transform toes = goal.foot * Transform{goal.toes, skeleton.rest[at(leg.toes)].translation};
    const Vec3 tip = rotate(toes.rotation, leg.toe_tip);
    constexpr float k_share = 0.75f;                // of the bend that keeps them above it: all of it is too quick
    constexpr float k_steepest = 0.5f;              // sine of how steeply they hang at most, near the floor
    constexpr float k_near = 0.04f, k_away = 0.2f;  // [m] heights of their joint between which they are let go
    const float size = length(tip), lowest = std::max(-toes.translation.y, -k_steepest * size);
    if (tip.y >= lowest || size < 1e-4f || planar_length(tip) < 1e-3f * size) return;
    const float t = std::clamp((k_away - toes.translation.y) / (k_away - k_near), 0.0f, 1.0f);
    const float bend = k_share * t * t * (3 - 2 * t) * (asin(lowest / size) - asin(tip.y / size));
    const Quat up = axis_angle(normalized(cross(tip, k_up)), bend);
    goal.toes = normalized(conjugate(goal.foot.rotation) * up * toes.rotation);
}

/// Far beyond any gait, and powers of what lies within are still numbers. Null: nothing is wrong.
const char* problem_of_ranges(const GaitBasis& basis) noexcept {
    constexpr float k_most_speed = 20, k_most_turn = 720, k_least_unit = 0.05f;  // [m/s], [deg/s], [m/s]
    const auto is_speed = [](float speed) { return std::fabs(speed) <= k_most_speed; };
    const auto is_range = [&](float least, float most) { return is_speed(least) && is_speed(most) && least < most; };
    if (!(std::fabs(basis.travel_deg) <= 180)) return "the direction of travel is not -180 to 180 degrees";
    if (!(std::fabs(basis.climb) <= 2)) return "it climbs more steeply than anyone can";
    if (!is_range(basis.least_speed, basis.most_speed) && !(basis.least_speed == 0 && basis.most_speed == 0))
        return "the range of speeds is empty or not usable";
    if (!(basis.most_turn >= 1 && basis.most_turn <= k_most_turn)) return "the range of turns is not usable";
    if (!is_range(basis.walk_until, basis.run_from)) return "the speeds of walking and running are not usable";
    for (std::size_t m = 0; m < 2; ++m) {
        const auto [slowest, fastest] = basis.fitted_speeds[m];
        if (!is_speed(basis.middle_speed[m]) || !(basis.speed_unit[m] >= k_least_unit) ||
            !is_speed(basis.speed_unit[m]) || !is_speed(slowest) || !is_speed(fastest) || !(slowest <= fastest) ||
            !(basis.fitted_turn[m] >= 0 && basis.fitted_turn[m] <= k_most_turn))
            return "the speeds or turns of the fitted strides are not usable";
    }
    return nullptr;
}

/// The numbers from `first` on, as many as `values` holds: the sum of the basis' terms.
void add_terms(const HarmonicGait& gait, float speed, float turn_deg, std::size_t first,
               std::span<float> values) noexcept {
    std::array<float, k_most_basis_terms> weights;
    term_weights(gait.basis, speed, turn_deg, weights);
    const std::size_t stride = at(value_count(gait));
    std::fill(values.begin(), values.end(), 0.0f);
    for (std::size_t t = 0; t < at(gait.basis.terms()); ++t) {
        if (weights[t] == 0) continue;
        const float* from = gait.coefficients.data() + t * stride + first;
        for (std::size_t i = 0; i < values.size(); ++i) values[i] += weights[t] * from[i];
    }
}

/// A family's root moves as asked; rhythms stay sane.
void bound_rhythm(const HarmonicGait& gait, float speed, float turn_deg, float* rhythm) noexcept {
    if (gait.family()) {
        const SinCos travel = sin_cos(static_cast<double>(gait.basis.travel_deg) * k_pi / 180);
        rhythm[0] = speed * static_cast<float>(travel.sin);
        rhythm[1] = speed * gait.basis.climb;
        rhythm[2] = speed * static_cast<float>(travel.cos);
        rhythm[3] = turn_deg * k_radians_per_degree;
    }
    constexpr float k_slowest_step = 0.2f, k_slowest_breath = 0.02f;  // [Hz]
    rhythm[4] = std::clamp(rhythm[4], gait.family() ? k_slowest_step : k_slowest_breath, 4.0f);
    rhythm[5] = std::clamp(rhythm[5], 0.2f, 0.8f);
    // Sprinters' feet stand for a quarter of the cycle. What is extrapolated to less is no rhythm of the actor's.
    constexpr float k_shortest_stance = 0.28f, k_longest_stance = 0.85f;
    for (int side = 0; side < 2; ++side)
        rhythm[6 + side] = std::clamp(rhythm[6 + side], k_shortest_stance, k_longest_stance);
}

std::size_t foot_values(const HarmonicGait& gait) noexcept { return at(k_foot_series * (1 + 2 * gait.foot_harmonics)); }
/// Where a foot's series begin among the values.
std::size_t foot_values(const HarmonicGait& gait, std::size_t side) noexcept {
    return at(value_count(gait) - k_rhythm_values) - (2 - side) * foot_values(gait);
}

FootPrint read_print(const HarmonicGait& gait, const float* values, std::size_t side, float series_phase) noexcept {
    const Waves waves(series_phase, gait.foot_harmonics);
    SeriesReader read(values, waves, gait.foot_harmonics);
    FootPrint print;
    print.rotation = gait.foot_mean[side] * from_rotation_vector(read.next_vector());
    print.heel = read.next_vector();
    print.ball = read.next_vector();
    print.toes = normalized(gait.toes_mean[side] * from_rotation_vector(read.next_vector()));
    return print;
}

}  // namespace

int value_count(const HarmonicGait& gait) noexcept {
    const int series = 3 * static_cast<int>(gait.mean.size() + gait.moving.size());
    return series * (1 + 2 * gait.harmonics) + 2 * k_foot_series * (1 + 2 * gait.foot_harmonics) + k_rhythm_values;
}

std::string problem(const HarmonicGait& gait) {
    if (!gait.skeleton) return "the gait has no skeleton";
    if (const std::string text = problem(*gait.skeleton); !text.empty()) return text;
    const auto in = [](int value, int least, int most) { return value >= least && value <= most; };
    if (!in(gait.harmonics, 1, k_most_harmonics) || !in(gait.foot_harmonics, 1, k_most_harmonics))
        return "the number of harmonics is not between 1 and " + std::to_string(k_most_harmonics);
    const GaitBasis& basis = gait.basis;
    if (!in(basis.modes, 1, 2) || !in(basis.degree, 0, 3)) return "the modes or the degree of the basis are not usable";
    if (const char* text = problem_of_ranges(basis)) return text;
    if (!(gait.foot_lift > 0.05f && gait.foot_lift < 0.95f))
        return "the stance of the feet's series is not 0.05 to 0.95";
    if (!(gait.foot_hold == 0 || (gait.foot_hold >= 0.5f && gait.foot_hold <= 1)))
        return "the share of a stance for which feet are held is not 0.5 to 1";
    const int joints = gait.skeleton->joint_count();
    std::string text = problem(gait.legs, *gait.skeleton);
    if (text.empty() && gait.legs.count > 0) text = problem(gait.soles, *gait.skeleton);
    if (!text.empty()) return "the legs are of another skeleton: " + text;
    if (static_cast<int>(gait.mean.size()) != joints) return "there is not one mean rotation a joint";
    int before = -1;
    for (const std::int16_t joint : gait.moving) {
        if (joint <= before || joint >= joints) return "the moving joints do not ascend or do not exist";
        before = joint;
    }
    if (gait.coefficients.size() != at(basis.terms()) * at(value_count(gait)))
        return "the number of coefficients does not fit the joints and harmonics";
    constexpr float k_most = 100;  // radians, metres, cycles a second: far beyond any gait, and safe to take powers of
    for (const float value : gait.coefficients)
        if (!(std::fabs(value) < k_most)) return "a coefficient is no usable number";
    const auto is_unit = [](Quat q) { return std::fabs(dot(q, q) - 1) < 1e-3f; };
    for (const Quat q : gait.mean)
        if (!is_unit(q)) return "a mean rotation is no unit quaternion";
    for (std::size_t side = 0; side < 2; ++side)
        if (!is_unit(gait.foot_mean[side]) || !is_unit(gait.toes_mean[side]))
            return "a foot's mean rotation is no unit quaternion";
    return {};
}

void powers_at(const GaitBasis& basis, GaitMode mode, float speed, float turn_deg, std::span<float> powers) noexcept {
    const auto m = static_cast<std::size_t>(mode);
    const float fitted = std::clamp(speed, basis.fitted_speeds[m][0], basis.fitted_speeds[m][1]);
    const float v = (fitted - basis.middle_speed[m]) / basis.speed_unit[m];
    const float w = std::clamp(turn_deg, -basis.fitted_turn[m], basis.fitted_turn[m]) / basis.most_turn;
    std::size_t i = 0;
    for (int degree = 0; degree <= basis.degree; ++degree)
        for (int of_turn = 0; of_turn <= degree; ++of_turn) {
            float power = 1;
            for (int k = 0; k < degree; ++k) power *= k < of_turn ? w : v;
            powers[i++] = power;
        }
}

void term_weights(const GaitBasis& basis, float speed, float turn_deg, std::span<float> weights) noexcept {
    const float running = share_of_running(basis, speed);
    for (int m = 0; m < basis.modes; ++m) {
        const float share = m == 0 ? 1 - running : running;
        const std::span<float> of_mode = weights.subspan(at(m * basis.terms_of_mode()), at(basis.terms_of_mode()));
        powers_at(basis, static_cast<GaitMode>(m), speed, turn_deg, of_mode);
        for (float& weight : of_mode) weight *= share;
    }
}

float share_of_running(const GaitBasis& basis, float speed) noexcept {
    if (basis.modes < 2) return 0;
    return smooth_step((speed - basis.walk_until) / (basis.run_from - basis.walk_until));
}

void values_at(const HarmonicGait& gait, float speed, float turn_deg, std::span<float> values) noexcept {
    add_terms(gait, speed, turn_deg, 0, values);
    bound_rhythm(gait, speed, turn_deg, values.data() + values.size() - k_rhythm_values);
}

GaitRhythm rhythm_of(const HarmonicGait&, std::span<const float> values) noexcept {
    const float* r = values.data() + values.size() - k_rhythm_values;
    return {{r[0], r[1], r[2]}, r[3], r[4], r[5], {r[6], r[7]}};
}

GaitRhythm rhythm_at(const HarmonicGait& gait, float speed, float turn_deg) noexcept {
    std::array<float, k_rhythm_values> values;
    add_terms(gait, speed, turn_deg, at(value_count(gait) - k_rhythm_values), values);
    bound_rhythm(gait, speed, turn_deg, values.data());
    return rhythm_of(gait, values);
}

float time_share(const GaitRhythm& rhythm, float phase) noexcept {
    const float whole = std::floor(phase), in = phase - whole, strike = rhythm.right_strike;
    return whole + (in < 0.5f ? 2 * in * strike : strike + (2 * in - 1) * (1 - strike));
}

float phase_of(const GaitRhythm& rhythm, float share) noexcept {
    const float whole = std::floor(share), in = share - whole, strike = rhythm.right_strike;
    return whole + (in < strike ? 0.5f * in / strike : 0.5f + 0.5f * (in - strike) / (1 - strike));
}

float since_strike(const GaitRhythm& rhythm, std::size_t side, float share) noexcept {
    const float strike = side == 0 ? 0.0f : 0.5f;
    return (time_share(rhythm, strike + share) - time_share(rhythm, strike)) / rhythm.frequency;
}

float foot_series_phase(float share, float lift, float series_lift) noexcept {
    return share < lift ? share / lift * series_lift : series_lift + (share - lift) / (1 - lift) * (1 - series_lift);
}

FootPrint foot_print(const HarmonicGait& gait, std::span<const float> values, std::size_t side,
                     float series_phase) noexcept {
    return read_print(gait, values.data() + foot_values(gait, side), side, series_phase);
}

FootPrint foot_print_at(const HarmonicGait& gait, float speed, float turn_deg, std::size_t side,
                        float series_phase) noexcept {
    std::array<float, k_foot_series*(1 + 2 * k_most_harmonics)> values;
    add_terms(gait, speed, turn_deg, foot_values(gait, side), {values.data(), foot_values(gait)});
    return read_print(gait, values.data(), side, series_phase);
}

FootStep step_of(const GaitRhythm& rhythm, std::size_t side) noexcept {
    const float strike = side == 0 ? 0.0f : 0.5f, lift = rhythm.lift[side], seconds = 1 / rhythm.frequency;
    const float stance = time_share(rhythm, strike + lift) - time_share(rhythm, strike);
    return {lift, stance * seconds, seconds};
}

void joint_pose(const HarmonicGait& gait, std::span<const float> values, std::span<const std::uint8_t> limb,
                std::span<const float> phases, std::span<Transform> locals) noexcept {
    std::array<Waves, k_most_phases> waves;
    for (std::size_t i = 0; i < phases.size(); ++i)
        waves[i] =
            i > 0 && phases[i] == phases[0] ? waves[0] : Waves(phases[i] - std::floor(phases[i]), gait.harmonics);
    const auto of = [&](std::size_t joint) -> const Waves& { return waves[limb.empty() ? 0 : limb[joint]]; };
    SeriesReader read(values.data(), waves[0], gait.harmonics);
    for (std::size_t j = 0; j < gait.mean.size(); ++j) {
        read.use(of(j));
        locals[j] = {normalized(gait.mean[j] * from_rotation_vector(read.next_vector())),
                     gait.skeleton->rest[j].translation};
    }
    for (const std::int16_t joint : gait.moving) {
        read.use(of(at(joint)));
        locals[at(joint)].translation = read.next_vector();
    }
}

void settle_on_feet(const Skeleton& skeleton, const Legs& soles, const LegPaths& legs, std::array<FootGoal, 2>& goals,
                    std::span<Transform> locals) noexcept {
    for (std::size_t side = 0; side < 2; ++side) bend_toes(soles.side[side], skeleton, goals[side]);
    constexpr float k_free = 0.97f;  // of means over many strides
    stand_on_feet(skeleton, soles, legs, goals, k_free, locals);
}

void stand_on_feet(const Skeleton& skeleton, const Legs& soles, const LegPaths& legs,
                   const std::array<FootGoal, 2>& goals, float free, std::span<Transform> locals) noexcept {
    lower_hips(skeleton, soles, goals, free, locals);
    reach_feet(legs, goals, locals);
}

void pose(const HarmonicGait& gait, std::span<const float> values, float phase, std::span<Transform> locals,
          const HarmonicPoseOptions& options) noexcept {
    joint_pose(gait, values, {}, {&phase, 1}, locals);
    if (!options.feet || gait.legs.count == 0) return;
    const GaitRhythm rhythm = rhythm_of(gait, values);
    std::array<FootGoal, 2> goals{foot_goal(gait, rhythm, 0, phase, values), foot_goal(gait, rhythm, 1, phase, values)};
    if (gait.family())
        settle_on_feet(*gait.skeleton, gait.soles, gait.legs, goals, locals);
    else
        reach_feet(gait.legs, goals, locals);
}

}  // namespace surefoot
