// Planning: once a step, footholds and swings; with them, how far the hips must give way.

#include <surefoot/ik/foot_forecast.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr int k_standing_samples = 5;       // a stance that begins this soon is the one the foot is in
constexpr double k_same_strike = 0.05;      // [s] a coming foothold that moved less than this
constexpr float k_same_place = 0.02f;       // [m] and this is kept: replanning for noise costs smoothness
constexpr float k_flicker = 0.08f;          // [m] a contact this near the plant just left is its end, not a landing
constexpr double k_longest_passing = 0.35;  // [s] after the strike, where the root's passing is not in sight
constexpr double k_plan_interval = 0.5;     // [s] plan at least this often; the forecast reaches 0.35 s farther
constexpr float k_path_margin = 0.02f;      // [m] ground this far ahead of and behind a swinging point counts
constexpr float k_toe_bend = 0.01f;         // [m] toes that are down bend out of the way by this much
constexpr float k_toe_down = 0.005f;        // [m]
constexpr int k_ramp = 3;                   // samples over which the path margin comes in after lift and before strike
constexpr float k_least_leg = 0.5f;      // share of its length to which the hips will fold a leg to reach, no further
constexpr float k_uneven_rise = 0.02f;   // [m] from one foothold to the next, from which ground counts as uneven
constexpr float k_uneven_tilt = 0.013f;  // sine of half the tilt: 1.5 degrees
// Where a clip sinks its feet, either the feet are too low or the outline of the soles is: half of it is believed.
constexpr float k_unsink = 0.5f;
constexpr double k_moment = 1.0 / 60;  // [s] for velocities by difference

float smootherstep(float x) noexcept { return x * x * x * (10 + x * (-15 + 6 * x)); }

/// How deep the clip itself sinks heel or ball into its own ground; it begins smoothly.
float own_depth(const LegPoints& points) noexcept {
    constexpr float k_soft = 0.004f;  // [m]
    const float depth = std::max(0.0f, -std::min(points.heel.y, points.ball.y));
    return depth * depth / (depth + k_soft);
}

Vec3 plant_ankle(const Plant& plant, const LegPoints& points, float leg_length) noexcept {
    const Vec3 ankle = planted(plant, points.ankle, leg_length);
    return plant.uneven > 0 ? ankle + k_up * (plant.uneven * own_depth(points)) : ankle;
}

/// The blend of the two plants, without hump and fade.
PlacedFoot blend_plants(const FootState& foot, double clock, const LegPoints& points, float leg_length) noexcept {
    const auto stand = [&](const Plant& plant) {
        return PlacedFoot{plant_ankle(plant, points, leg_length), plant.tilt, plant.uneven};
    };
    if (!foot.has_next || clock <= foot.lift) return stand(foot.plant);
    if (clock >= foot.strike) return stand(foot.next);
    const float s = smootherstep(static_cast<float>((clock - foot.lift) / (foot.strike - foot.lift)));
    const PlacedFoot a = stand(foot.plant), b = stand(foot.next);
    const Vec3 turn = to_rotation_vector(foot.next.tilt * conjugate(foot.plant.tilt));
    return {a.ankle + (b.ankle - a.ankle) * s, from_rotation_vector(turn * s) * foot.plant.tilt,
            a.uneven + (b.uneven - a.uneven) * s};
}

/// What is left of the fade: cubic Hermite from (offset, rate) to (0, 0).
struct Fade {
    Vec3 offset;
    float turn_share = 0;
};
Fade fade_at(const FootState& foot, double clock) noexcept {
    if (clock >= foot.fade_until || foot.fade_until <= foot.fade_from) return {};
    const auto length = static_cast<float>(foot.fade_until - foot.fade_from);
    const float t = std::clamp(static_cast<float>(clock - foot.fade_from) / length, 0.0f, 1.0f);
    const float rest = (1 - t) * (1 - t);
    return {foot.fade_offset * (rest * (1 + 2 * t)) + foot.fade_rate * (rest * t * length), 1 - smootherstep(t)};
}

bool is_swinging(const FootState& foot, double clock) noexcept {
    return foot.has_next && clock >= foot.lift && clock < foot.strike;
}

class Planner {
  public:
    Planner(const FootRig& rig, FootPlacementState& state, const GroundProbe& probe, const Forecast& forecast) noexcept
        : rig_(rig), state_(state), probe_(probe), forecast_(forecast) {}

    void plan_foot(std::size_t side) noexcept;
    void plan_hips() noexcept;

  private:
    float leg_length(std::size_t side) const noexcept { return rig_.legs.side[side].length(); }
    Plant make_plant(std::size_t side, const ContactRun& run) const noexcept;
    void start_foot(std::size_t side) noexcept;
    void plan_stance(std::size_t side) noexcept;
    void plan_swing(std::size_t side, const ContactRun& landing) noexcept;
    void replan_swing(std::size_t side) noexcept;
    void join(std::size_t side, const FootState& before) noexcept;
    void clear_ground(std::size_t side) noexcept;
    float needed(const LegPoints& points, const PlacedFoot& placed, Vec3 margin) const noexcept;
    void plan_line() noexcept;
    float shortfall(int sample, float base) const noexcept;

    const FootRig& rig_;
    FootPlacementState& state_;
    const GroundProbe& probe_;
    const Forecast& forecast_;
};

Plant Planner::make_plant(std::size_t side, const ContactRun& run) const noexcept {
    const FootSettings& s = rig_.settings;
    Plant plant =
        find_foothold(forecast_.footprint(side, run, leg_length(side)), probe_, s.search_along, s.search_across);
    const double middle =
        forecast_.time(run.first) +
        std::min(0.5 * static_cast<double>(run.last - run.first) / Forecast::k_rate, k_longest_passing);
    plant.passing = forecast_.passing(plant.centre, middle);
    const float rise = std::fabs(plant.foothold.y - state_.feet[1 - side].plant.foothold.y);
    const float slope = std::sqrt(plant.tilt.x * plant.tilt.x + plant.tilt.z * plant.tilt.z);
    plant.uneven = k_unsink * smootherstep(std::min(1.0f, std::max(rise / k_uneven_rise, slope / k_uneven_tilt)));
    return plant;
}

/// The first plan: where a foot stands now, or hangs.
void Planner::start_foot(std::size_t side) noexcept {
    FootState& foot = state_.feet[side];
    const bool standing = forecast_.run_count[side] > 0 && forecast_.runs[side][0].first <= k_standing_samples;
    foot.plant = make_plant(side, standing ? forecast_.runs[side][0] : ContactRun{0, 0});
    foot.lift = state_.clock;
}

void Planner::plan_foot(std::size_t side) noexcept {
    if (!state_.started) start_foot(side);
    if (is_swinging(state_.feet[side], state_.clock))
        replan_swing(side);
    else
        plan_stance(side);
}

void Planner::plan_stance(std::size_t side) noexcept {
    FootState& foot = state_.feet[side];
    const FootState before = foot;
    const auto& runs = forecast_.runs[side];
    const bool standing = forecast_.run_count[side] > 0 && runs[0].first <= k_standing_samples;
    const int landing = standing ? 1 : 0;
    foot.has_next = false;
    foot.lift = foot.strike = k_never;
    if (landing >= forecast_.run_count[side]) return;
    foot.lift = standing ? forecast_.time(runs[0].last) : state_.clock;
    plan_swing(side, runs[static_cast<std::size_t>(landing)]);
    foot.hump_from = foot.lift;
    foot.hump = {};
    if (foot.lift <= state_.clock) join(side, before);
    clear_ground(side);
}

void Planner::plan_swing(std::size_t side, const ContactRun& landing) noexcept {
    FootState& foot = state_.feet[side];
    foot.next = make_plant(side, landing);
    foot.strike = std::max(forecast_.time(landing.first), std::max(foot.lift, state_.clock) + k_moment);
    const LegPoints& at_strike = forecast_.legs[side][static_cast<std::size_t>(landing.first)];
    foot.strike_probe = (at_strike.heel + at_strike.ball) * 0.5f;
    foot.has_next = true;
}

/// In mid-swing the plan is kept unless steering has moved the foothold.
void Planner::replan_swing(std::size_t side) noexcept {
    FootState& foot = state_.feet[side];
    const double now = state_.clock;
    int landing = -1;
    for (int i = 0; i < forecast_.run_count[side] && landing < 0; ++i) {
        const ContactRun& run = forecast_.runs[side][static_cast<std::size_t>(i)];
        const Vec3 centre = forecast_.footprint(side, run, leg_length(side)).centre;
        const bool flicker = run.first == 0 && planar_length(centre - foot.plant.centre) < k_flicker &&
                             now - foot.lift < foot.strike - now;
        if (!flicker) landing = i;
    }
    if (landing < 0) return;
    const ContactRun& run = forecast_.runs[side][static_cast<std::size_t>(landing)];
    const Footprint foot_there = forecast_.footprint(side, run, leg_length(side));
    const bool same = std::fabs(forecast_.time(run.first) - foot.strike) < k_same_strike &&
                      planar_length(foot_there.centre - foot.next.centre) < k_same_place;
    if (same) return;

    const FootState before = foot;
    const double share = (now - foot.lift) / (foot.strike - foot.lift);
    plan_swing(side, run);
    // The same share of the new swing has passed.
    foot.lift = now - share * (foot.strike - now) / std::max(1 - share, 0.05);
    join(side, before);
    clear_ground(side);
}

/// Position and velocity go on from what the old plan made of them: level parts and turn fade out, the vertical part
/// is where the new hump begins.
void Planner::join(std::size_t side, const FootState& before) noexcept {
    FootState& foot = state_.feet[side];
    const double now = state_.clock, later = now + k_moment;
    const LegPoints p = forecast_.at(side, now), q = forecast_.at(side, later);
    const PlacedFoot was = place_foot(before, now, p, leg_length(side)),
                     went = place_foot(before, later, q, leg_length(side));
    const PlacedFoot is = blend_plants(foot, now, p, leg_length(side)),
                     goes = blend_plants(foot, later, q, leg_length(side));
    const Vec3 offset = was.ankle - is.ankle, rate = ((went.ankle - goes.ankle) - offset) * (1.0f / k_moment);
    foot.fade_from = foot.hump_from = now;
    foot.fade_until = foot.strike;
    foot.fade_offset = {offset.x, 0, offset.z};
    foot.fade_rate = {rate.x, 0, rate.z};
    foot.fade_turn = to_rotation_vector(was.tilt * conjugate(is.tilt));
    foot.hump.start_value = offset.y;
    foot.hump.start_slope = rate.y * static_cast<float>(foot.strike - now);
}

/// Least height of the ankle above its height in the clip so that heel, ball and toe tip clear the ground.
float Planner::needed(const LegPoints& points, const PlacedFoot& placed, Vec3 margin) const noexcept {
    const std::array<Vec3, 3> soles{points.heel, points.ball, points.toe_tip};
    float need = -1e3f;
    for (std::size_t k = 0; k < soles.size(); ++k) {
        const Vec3 arm = rotate(placed.tilt, soles[k] - points.ankle), place = placed.ankle + arm;
        const std::array<Vec3, 3> under{place, place + margin, place - margin};
        std::array<float, 3> heights;
        probe_.heights(under, heights);
        const float ground = std::max({heights[0], heights[1], heights[2]});
        float own = std::min(rig_.settings.swing_clearance, soles[k].y);
        if (own < 0) own *= 1 - placed.uneven;
        float least = ground + own - (points.ankle.y + arm.y);
        if (k == 2 && soles[k].y < k_toe_down) least -= k_toe_bend;
        need = std::max(need, least);
    }
    return need;
}

void Planner::clear_ground(std::size_t side) noexcept {
    FootState& foot = state_.feet[side];
    const double from = foot.hump_from, length = foot.strike - from;
    const Vec3 travel = normalized(foot.next.centre - foot.plant.centre, {0, 0, 0});
    HumpTask task;
    for (int j = -1; j <= k_hump_samples; ++j) {
        const double clock = from + length * static_cast<double>(j) / (k_hump_samples - 1);
        const LegPoints points = forecast_.at(side, clock);
        PlacedFoot placed = blend_plants(foot, clock, points, leg_length(side));
        task.base[static_cast<std::size_t>(j + 1)] = placed.ankle.y - points.ankle.y;
        if (j < 0 || j == k_hump_samples) continue;
        placed.ankle += fade_at(foot, clock).offset;
        const int from_end = std::min(j, k_hump_samples - 1 - j);
        const float margin = k_path_margin * std::min(1.0f, static_cast<float>(from_end) / k_ramp);
        task.need[static_cast<std::size_t>(j)] = needed(points, placed, travel * margin);
    }
    task.start_value = foot.hump.start_value;
    task.start_slope = foot.hump.start_slope;
    foot.hump = rig_.solver->solve(task);
}

/// The footholds around now, by the time the root passes over them.
void Planner::plan_line() noexcept {
    FootholdLine& line = state_.line;
    line.keep_past(state_.clock);
    bool standing = true;
    std::array<FootholdPass, 2 * (1 + Forecast::k_most_runs)> passes;
    std::size_t count = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const FootState& foot = state_.feet[side];
        if (foot.plant.passing > state_.clock || line.count == 0)
            passes[count++] = {foot.plant.passing, foot.plant.foothold.y};
        if (!foot.has_next) continue;
        standing = false;
        passes[count++] = {foot.next.passing, foot.next.foothold.y};
        // Steps beyond the next one count with the plain ground under them.
        for (int i = 0; i < forecast_.run_count[side]; ++i) {
            const ContactRun& run = forecast_.runs[side][static_cast<std::size_t>(i)];
            if (forecast_.time(run.first) < foot.strike + k_same_strike) continue;
            const Vec3 centre = forecast_.footprint(side, run, leg_length(side)).centre;
            const double middle = 0.5 * (forecast_.time(run.first) + forecast_.time(run.last));
            passes[count++] = {forecast_.passing(centre, middle), probe_.height(centre.x, centre.z)};
        }
    }
    if (standing) {
        const float middle = 0.5f * (state_.feet[0].plant.foothold.y + state_.feet[1].plant.foothold.y);
        count = 0;
        passes[count++] = {state_.clock + k_longest_passing, middle};
    }
    for (std::size_t i = 0; i < count; ++i) line.add(passes[i]);
}

/// By how much the shorter of the two legs keeps the hips below `base` at a sample.
float Planner::shortfall(int sample, float base) const noexcept {
    float least = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const LegPoints& p = forecast_.legs[side][static_cast<std::size_t>(sample)];
        const float length = distance(p.hip, p.knee) + distance(p.knee, p.ankle);
        const Vec3 ankle = place_foot(state_.feet[side], forecast_.time(sample), p, leg_length(side)).ankle;
        const float reach = std::max(rig_.settings.reach * length, distance(p.hip, p.ankle));
        const float across = planar_length(ankle - p.hip), low = k_least_leg * length;
        const float rise = std::sqrt(std::max(reach * reach - across * across, low * low));
        least = std::min(least, ankle.y + rise - p.hip.y - base);
    }
    return least;
}

void Planner::plan_hips() noexcept {
    plan_line();
    const double lead = 2.0 / static_cast<double>(rig_.settings.hip_stiffness);  // the spring's lag on a ramp
    if (!state_.started) {
        const float here = state_.line.at(state_.clock + lead);
        state_.base = {here, (state_.line.at(state_.clock + lead + 0.1) - here) / 0.1f};
    }
    HeightSpring base = state_.base;
    std::array<float, Forecast::k_samples> short_by;
    for (int i = 0; i < Forecast::k_samples; ++i) {
        if (i)
            base.step(state_.line.at(forecast_.time(i) + lead), rig_.settings.hip_stiffness, 1.0f / Forecast::k_rate);
        short_by[static_cast<std::size_t>(i)] = shortfall(i, base.value);
    }
    if (!state_.started) state_.limiter.fill(state_.clock, short_by[0]);
    const auto first = static_cast<std::int64_t>(std::ceil(state_.clock * HipLimiter::k_rate));
    for (std::int64_t slot = first;; ++slot) {
        const double at = (static_cast<double>(slot) / HipLimiter::k_rate - state_.clock) * Forecast::k_rate;
        const int low = std::max(static_cast<int>(std::floor(at)) - 1, 0), high = static_cast<int>(std::ceil(at)) + 1;
        if (high >= Forecast::k_samples) break;
        float least = 0;
        for (int i = low; i <= high; ++i) least = std::min(least, short_by[static_cast<std::size_t>(i)]);
        state_.limiter.set(slot, least);
    }
}

}  // namespace

PlacedFoot place_foot(const FootState& foot, double clock, const LegPoints& points, float leg_length) noexcept {
    PlacedFoot placed = blend_plants(foot, clock, points, leg_length);
    if (!foot.has_next || clock < foot.hump_from || clock >= foot.strike) return placed;
    const auto share = static_cast<float>((clock - foot.hump_from) / (foot.strike - foot.hump_from));
    const Fade fade = fade_at(foot, clock);
    placed.ankle += fade.offset + k_up * foot.hump.at(share);
    if (fade.turn_share > 0) placed.tilt = from_rotation_vector(foot.fade_turn * fade.turn_share) * placed.tilt;
    return placed;
}

void plan_feet(const FootRig& rig, FootPlacementState& state, const GroundProbe& probe,
               const LegPreview& preview) noexcept {
    Forecast forecast;
    look_ahead(rig, state.clock, preview, forecast);
    if (!state.started)
        for (FootState& foot : state.feet) foot.plant.foothold.y = probe.fallback;
    Planner planner(rig, state, probe, forecast);
    planner.plan_foot(0);
    planner.plan_foot(1);
    planner.plan_hips();
    state.started = true;
    state.next_plan = state.clock + k_plan_interval;
    ++state.plans;
}

}  // namespace surefoot
