#include <surefoot/base/error.h>
#include <surefoot/fit/cycle_samples.h>
#include <surefoot/fit/derive.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/fit/ridge.h>
#include <surefoot/harmonic/series.h>
#include <surefoot/math/trig.h>
#include <surefoot/rig/roles.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace surefoot {
namespace {

using FootPart = GaitSeries::FootPart;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A family of one mode over a range of speeds, whose values at a speed are what `values` says.
void set_over_speeds(HarmonicGait& gait, float least, float most,
                     const std::function<std::vector<float>(float)>& values) {
    constexpr int k_samples = 9;
    GaitBasis& basis = gait.basis;
    basis.modes = 1;
    basis.degree = 2;
    basis.least_speed = least, basis.most_speed = most;
    basis.fitted_speeds[0] = {least, most};
    basis.fitted_turn = {basis.most_turn, basis.most_turn};
    basis.middle_speed[0] = 0.5f * (least + most);
    basis.speed_unit[0] = std::max(0.1f, 0.5f * (most - least));
    const auto terms = at(basis.terms());
    RidgeProblem problem(terms, at(value_count(gait)));
    std::vector<float> powers(terms);
    for (int i = 0; i < k_samples; ++i) {
        const float speed = least + (most - least) * static_cast<float>(i) / (k_samples - 1);
        powers_at(basis, GaitMode::walk, speed, 0, powers);
        problem.add_sample(powers, values(speed), 1);
    }
    gait.coefficients = problem.solve();
    round_coefficients(gait);
}

RoleMap roles_of(const HarmonicGait& gait) {
    std::vector<Transform> rest(gait.skeleton->rest.size());
    local_to_model(*gait.skeleton, gait.skeleton->rest, rest);
    return find_roles(*gait.skeleton, rest).roles;
}

/// Adds to a joint's rotation one about an axis of the model, times each of the series' numbers in `wave`.
void add_turn(const GaitSeries& series, int joint, Quat model, Vec3 axis, std::span<const float> wave) {
    const Vec3 own = rotate(conjugate(model), axis);
    const float part[3] = {own.x, own.y, own.z};
    for (int a = 0; a < 3; ++a) {
        const std::span<float> to = series.rotation(joint, a);
        for (std::size_t i = 0; i < std::min(wave.size(), to.size()); ++i) to[i] += part[a] * wave[i];
    }
}

/// Moves the hips by a vector of the model, times each of the series' numbers in `wave`.
void move_hips(const HarmonicGait& gait, const GaitSeries& series, std::span<const Quat> models, Vec3 by,
               std::span<const float> wave) {
    const int hips = gait.soles.hips, moving = series.moving_index(hips), parent = gait.skeleton->parents[at(hips)];
    if (moving < 0) return;
    const Vec3 own = parent == k_no_joint ? by : rotate(conjugate(models[at(parent)]), by);
    const float part[3] = {own.x, own.y, own.z};
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < wave.size(); ++i) series.translation(moving, axis)[i] += part[axis] * wave[i];
}

/// A series of `foot_harmonics` that is `height` at its highest in mid-swing and 0 while the foot stands.
std::vector<float> swing_bump(const HarmonicGait& gait, float height) {
    constexpr int k_samples = 256;
    std::vector<float> wave(at(1 + 2 * gait.foot_harmonics));
    for (int i = 0; i < k_samples; ++i) {
        const float phase = (static_cast<float>(i) + 0.5f) / k_samples;
        const float t = (phase - gait.foot_lift) / (1 - gait.foot_lift);
        if (t <= 0) continue;
        const double early = static_cast<double>(t * (1.8f - 0.8f * t));  // up first, then forward
        const double s = sin_cos(k_pi * early).sin, y = static_cast<double>(height) * s * s;
        wave[0] += static_cast<float>(y / k_samples);
        for (int k = 1; k <= gait.foot_harmonics; ++k) {
            const SinCos w = sin_cos(2 * k_pi * k * static_cast<double>(phase));
            wave[at(2 * k - 1)] += static_cast<float>(2 * w.cos * y / k_samples);
            wave[at(2 * k)] += static_cast<float>(2 * w.sin * y / k_samples);
        }
    }
    return wave;
}

void add(std::span<float> series, std::span<const float> wave) {
    for (std::size_t i = 0; i < series.size(); ++i) series[i] += wave[i];
}

}  // namespace

HarmonicGait stretched(const HarmonicGait& gait, float least_speed, float most_speed) {
    if (gait.family()) throw Error("it is a family already", gait.name, "fit one clip");
    const GaitRhythm rhythm = rhythm_of(gait, gait.coefficients);
    const float speed = planar_length(rhythm.velocity);
    if (!(speed > 0.05f)) throw Error("it goes nowhere", gait.name, "only gaits that travel have other speeds");
    if (!(least_speed > 0 && most_speed > least_speed))
        throw Error("the range of speeds is empty", gait.name, "give the slowest and the fastest, above 0");
    HarmonicGait result = gait;
    // Nearly ahead, back or sideways is exactly so: what is asked for is a direction, and few captures keep it.
    const auto travel = static_cast<float>(
        atan2(static_cast<double>(rhythm.velocity.x), static_cast<double>(rhythm.velocity.z)) * 180 / k_pi);
    const float quarter = 90 * std::floor(travel / 90 + 0.5f);
    constexpr float k_nearly = 15;
    result.basis.travel_deg = std::fabs(travel - quarter) < k_nearly ? quarter : travel;
    set_over_speeds(result, least_speed, most_speed, [&](float wanted) {
        constexpr float k_least = 0.5f;
        // Slower, strides shorten as cadence drops. Quicker it is cadence that makes the speed: wider swings of limbs
        // that the clip already swings far would be torn.
        const float part = wanted / speed, power = part < 1 ? 0.5f : 0.2f;
        const float share = std::max(k_least, exp(power * static_cast<float>(log(static_cast<double>(part)))));
        std::vector<float> values = gait.coefficients;
        const GaitSeries series(gait, values);
        for (int j = 0; j < static_cast<int>(gait.mean.size()); ++j)
            for (int axis = 0; axis < 3; ++axis) scale_waves(series.rotation(j, axis), share);
        for (int m = 0; m < static_cast<int>(gait.moving.size()); ++m)
            for (int axis = 0; axis < 3; ++axis) scale_waves(series.translation(m, axis), share);
        scale_steps(gait, series, 0.5f * (1 + share));
        series.rhythm()[4] *= wanted / speed / share;
        series.rhythm()[3] = 0;
        return values;
    });
    return result;
}

HarmonicGait shifting_weight(const HarmonicGait& standing, const WeightShift& shift) {
    const GaitRhythm rhythm = rhythm_of(standing, standing.coefficients);
    if (standing.family() || length(rhythm.velocity) > 0)
        throw Error("it does not stand", standing.name, "fit a clip of someone standing");
    const int breaths = shift.breaths;
    HarmonicGait result = standing;
    constexpr int k_kept = 3;  // a breath is round: more waves of it say nothing
    const auto kept = [&](int harmonics) { return std::min({harmonics, k_kept, k_most_harmonics / breaths}); };
    const int body = kept(standing.harmonics), feet = kept(standing.foot_harmonics);
    result.harmonics = body * breaths, result.foot_harmonics = feet * breaths;
    result.coefficients.assign(at(value_count(result)), 0.0f);
    std::vector<float> source = standing.coefficients;
    const GaitSeries from(standing, source), to(result, result.coefficients);
    const auto spread = [&](std::span<const float> a, std::span<float> b, int harmonics) {
        b[0] = a[0];
        for (int k = 1; k <= harmonics; ++k)
            for (int i = 0; i < 2; ++i) b[at(2 * k * breaths - 1 + i)] = a[at(2 * k - 1 + i)];
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (int j = 0; j < static_cast<int>(standing.mean.size()); ++j)
            spread(from.rotation(j, axis), to.rotation(j, axis), body);
        for (int m = 0; m < static_cast<int>(standing.moving.size()); ++m)
            spread(from.translation(m, axis), to.translation(m, axis), body);
        for (std::size_t side = 0; side < 2; ++side)
            for (const FootPart part : {FootPart::rotation, FootPart::heel, FootPart::ball, FootPart::toes})
                spread(from.foot(side, part, axis), to.foot(side, part, axis), feet);
    }
    std::copy_n(from.rhythm().begin(), k_rhythm_values, to.rhythm().begin());
    to.rhythm()[4] /= static_cast<float>(breaths);
    const RoleMap roles = roles_of(result);
    const std::vector<Quat> models = mean_models(result);
    // The weight rests on one foot for a while: the third wave flattens the tops of the first.
    const float drop = shift.drop_deg * k_radians_per_degree;
    std::vector<float> wave{0, 0, 1, 0, 0, 0, 0.15f};
    move_hips(result, to, models, {shift.sway, 0, 0}, wave);
    std::vector<int> trunk;
    for (const Role role : {Role::spine, Role::chest, Role::upper_chest})
        if (roles.has(role)) trunk.push_back(roles[role]);
    for (float& v : wave) v *= drop;
    // Over the left foot the right side sinks: a turn about the way ahead, which lowers what is on -X.
    add_turn(to, result.soles.hips, models[at(result.soles.hips)], {0, 0, 1}, wave);
    for (float& v : wave) v *= -1 / static_cast<float>(std::max<std::size_t>(1, trunk.size()));
    for (const int joint : trunk) add_turn(to, joint, models[at(joint)], {0, 0, 1}, wave);
    round_coefficients(result);
    return result;
}

HarmonicGait on_stairs(const HarmonicGait& family, const StairSteps& stairs) {
    if (!family.family() || family.basis.travel_deg != 0)
        throw Error("it is no family that goes ahead", family.name, "fit one: surefoot fit TAKES --family");
    std::vector<float> walk(at(value_count(family)));
    values_at(family, stairs.walk_speed, 0, walk);
    HarmonicGait result = family;
    result.foot_hold = 0;  // their feet are new
    result.basis.climb = stairs.riser / stairs.tread;
    const std::vector<Quat> models = mean_models(family);
    const RoleMap roles = roles_of(family);
    const GaitSeries series(family, walk);
    const float up = stairs.riser > 0 ? 1.0f : 0.0f;
    constexpr float k_foot_roll = 0.3f;  // of the walk's: on a tread a foot lands and stays nearly flat
    scale_steps(family, series, k_foot_roll);
    for (std::size_t side = 0; side < 2; ++side)
        for (const FootPart part : {FootPart::heel, FootPart::ball})
            scale_about(series.foot(side, part, 2), 0.5f * family.foot_lift, k_foot_roll);
    // Straight from tread to tread a foot would cut the edge between them.
    const std::vector<float> lift = swing_bump(family, 0.7f * std::fabs(stairs.riser) + (up > 0 ? 0.13f : 0.03f));
    constexpr float k_first_up = 0.45f;                       // of the lift that the foot stays behind meanwhile
    constexpr float k_toes_up = -110 * k_radians_per_degree;  // for a metre of lift
    for (std::size_t side = 0; side < 2; ++side) {
        const Vec3 pitch = rotate(conjugate(family.foot_mean[side]), {k_toes_up * up, 0, 0});
        for (std::size_t i = 0; i < lift.size(); ++i) {
            series.foot(side, FootPart::rotation, 0)[i] += pitch.x * lift[i];
            series.foot(side, FootPart::rotation, 1)[i] += pitch.y * lift[i];
            series.foot(side, FootPart::rotation, 2)[i] += pitch.z * lift[i];
        }
        for (const FootPart part : {FootPart::heel, FootPart::ball}) {
            add(series.foot(side, part, 1), lift);
            for (std::size_t i = 0; i < lift.size(); ++i) series.foot(side, part, 2)[i] -= k_first_up * lift[i];
            // Footholds are a tread apart wherever they are, and the whole foot is on it if the body comes over it.
            series.foot(side, part, 2)[0] += up > 0 ? 0.03f : -0.02f;
        }
    }
    // The body sinks by what the lower leg cannot reach, and leans where it goes.
    const float lean[1] = {(up > 0 ? 3.5f : -1.0f) * k_radians_per_degree};
    for (const Role role : {Role::hips, Role::spine, Role::chest})
        if (roles.has(role)) add_turn(series, roles[role], models[at(roles[role])], {1, 0, 0}, lean);
    const float whole[1] = {1};
    move_hips(family, series, models, {0, up > 0 ? -0.05f : -0.06f, 0}, whole);
    for (std::size_t side = 0; side < 2; ++side) series.rhythm()[6 + side] = up > 0 ? 0.62f : 0.6f;
    series.rhythm()[5] = 0.5f;
    set_over_speeds(result, stairs.least_speed, stairs.most_speed, [&](float speed) {
        std::vector<float> values = walk;
        GaitSeries(family, values).rhythm()[4] = speed / (2 * stairs.tread);
        return values;
    });
    return result;
}

}  // namespace surefoot
