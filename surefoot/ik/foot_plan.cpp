// Planning: once a step, footholds and swings; with them, how far the hips must give way.

#include <surefoot/ik/foot_forecast.h>
#include <surefoot/ik/pace.h>
#include <surefoot/ik/replant.h>
#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr int k_standing_samples = 5;       // a stance that begins this soon is the one the foot is in
constexpr double k_same_strike = 0.05;      // [s] a coming foothold that moved less than this
constexpr float k_same_place = 0.02f;       // [m] and this is kept: replanning for noise costs smoothness
constexpr float k_no_move = 0.003f;         // [m] less is none
constexpr double k_late = 0.3;              // [s] before the strike: no wholly other foothold is sought out
constexpr float k_settle_share = 0.5f;      // of the search, that a foot so late may still go to from the one it has
constexpr double k_committed = 0.17;        // [s] before a strike a step of a held foot is not turned aside
constexpr float k_flicker = 0.08f;          // [m] a contact this near the plant just left is its end, not a landing
constexpr double k_longest_passing = 0.35;  // [s] after the strike, where the root's passing is not in sight
constexpr double k_plan_interval = 0.5;     // [s] plan at least this often; the forecast reaches 0.35 s farther
constexpr float k_least_leg = 0.5f;      // share of its length to which the hips will fold a leg to reach, no further
constexpr float k_uneven_rise = 0.02f;   // [m] from one foothold to the next, from which ground counts as uneven
constexpr float k_uneven_tilt = 0.013f;  // sine of half the tilt: 1.5 degrees
// Where a clip sinks its feet, either the feet are too low or the outline of the soles is: a third of it is taken out.
constexpr float k_unsink = 0.33f;
constexpr float k_most_rise = 30 * k_radians_per_degree;
constexpr double k_rise_after = 0.13, k_rise_fall = 0.23;  // [s] after the lift: still short of reach; flat again
constexpr double k_shortest_rise = 0.08;                   // [s] a heel that comes up faster would kick
constexpr float k_rise_worth = 0.003f;                     // [m] of hip height
constexpr int k_rise_rounds = 7;                           // of bisection: a quarter of a degree
constexpr float k_step_height = 0.05f;                     // of the leg's length, where the clip's own foot stays down
constexpr double k_moment = 1.0 / 60;                      // [s] for velocities by difference

class Planner {
  public:
    Planner(const FootRig& rig, FootPlacementState& state, const GroundProbe& probe, const Forecast& forecast) noexcept
        : rig_(rig), state_(state), probe_(probe), forecast_(forecast) {}

    void plan_foot(std::size_t side) noexcept;
    void plan_hips() noexcept;

  private:
    const Leg& leg(std::size_t side) const noexcept { return rig_.legs.side[side]; }
    float leg_length(std::size_t side) const noexcept { return leg(side).length(); }
    Plant make_plant(std::size_t side, const ContactRun& run) const noexcept;
    Plant settle(std::size_t side, const ContactRun& run, const Plant& sought, double left) const noexcept;
    Plant completed(std::size_t side, const ContactRun& run, Plant plant) const noexcept;
    void start_foot(std::size_t side) noexcept;
    void plan_stance(std::size_t side) noexcept;
    void plan_swing(std::size_t side, const ContactRun& landing) noexcept;
    void replan_swing(std::size_t side) noexcept;
    void join(std::size_t side, const FootState& before) noexcept;
    void clear_ground(std::size_t side) noexcept { plan_clearance(rig_, state_.feet[side], side, probe_, forecast_); }
    void plan_line() noexcept;
    float shortfall(std::size_t side, int sample) const noexcept;
    float least_shortfall(std::size_t side, double from, double until) const noexcept;
    void plan_rise(std::size_t side) noexcept;

    const FootRig& rig_;
    FootPlacementState& state_;
    const GroundProbe& probe_;
    const Forecast& forecast_;
    std::array<float, Forecast::k_samples> base_{};  // [m] the hips' base over the forecast
};

Plant Planner::make_plant(std::size_t side, const ContactRun& run) const noexcept {
    const FootSettings& s = rig_.settings;
    const Footprint foot = forecast_.footprint(side, run, leg_length(side));
    return completed(side, run, find_foothold(foot, probe_, s.search_along, s.search_across));
}

/// A foot turns on its way in curves: the place that was sought out for it, or a better one near it for the foot as it
/// will stand there now. The less time there is to go there, the nearer.
Plant Planner::settle(std::size_t side, const ContactRun& run, const Plant& sought, double left) const noexcept {
    const FootSettings& s = rig_.settings;
    const Footprint foot = forecast_.footprint(side, run, leg_length(side));
    const float share = k_settle_share * static_cast<float>(std::clamp(left / k_late, 0.0, 1.0));
    Footprint there = foot;
    there.centre = {sought.foothold.x, 0, sought.foothold.z};
    Plant plant = find_foothold(there, probe_, share * s.search_along, share * s.search_across);
    plant.centre = foot.centre;
    return completed(side, run, plant);
}

/// A foothold with all else that its plant has.
Plant Planner::completed(std::size_t side, const ContactRun& run, Plant plant) const noexcept {
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
    foot.shift_early = foot.shift_late = {};
    if (foot.lift <= state_.clock) join(side, before);
    clear_ground(side);
}

void Planner::plan_swing(std::size_t side, const ContactRun& landing) noexcept {
    FootState& foot = state_.feet[side];
    const bool held = forecast_.rests[side] && (foot.has_next ? foot.next : foot.plant).held;
    foot.next = make_plant(side, landing);
    foot.next.held = held;
    foot.step_height = held ? k_step_height * leg_length(side) : 0;
    foot.strike = std::max(forecast_.time(landing.first), std::max(foot.lift, state_.clock) + k_moment);
    foot.has_next = true;
}

/// In mid-swing the plan is kept unless steering has moved the foothold.
void Planner::replan_swing(std::size_t side) noexcept {
    FootState& foot = state_.feet[side];
    const double now = state_.clock;
    // It would have to leap; it steps again instead.
    if (forecast_.rests[side] && foot.next.held && foot.strike - now < k_committed) return;
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
    const FootState before = foot;
    if (same && planar_length(foot_there.centre - foot.next.centre) < k_no_move) return;
    plan_swing(side, run);
    // A foot that comes from a little elsewhere, or is nearly there, keeps about to a foothold that was sought out.
    const bool late = foot.strike - now < k_late &&
                      planar_length(foot.next.centre - before.next.foothold) < rig_.settings.search_along;
    if ((same || late) && is_sought_out(before.next)) {
        const bool held = foot.next.held;
        foot.next = settle(side, run, before.next, foot.strike - now);
        foot.next.held = held;
    }
    const double share = (now - before.lift) / (before.strike - before.lift);
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
    const PlacedFoot was = place_foot(before, now, p, leg(side)), went = place_foot(before, later, q, leg(side));
    const PlacedFoot is = blend_plants(foot, now, p, leg(side)), goes = blend_plants(foot, later, q, leg(side));
    const Vec3 offset = was.ankle - is.ankle, rate = ((went.ankle - goes.ankle) - offset) * (1.0f / k_moment);
    foot.fade_from = foot.hump_from = now;
    foot.fade_until = foot.strike;
    foot.fade_offset = {offset.x, 0, offset.z};
    foot.fade_rate = {rate.x, 0, rate.z};
    foot.fade_turn = to_rotation_vector(was.tilt * conjugate(is.tilt));
    foot.hump.start_value = offset.y;
    foot.hump.start_slope = rate.y * static_cast<float>(foot.strike - now);
}

/// The footholds around now, by the time the root passes over them.
void Planner::plan_line() noexcept {
    FootholdLine& line = state_.line;
    line.keep_past(state_.clock);
    bool standing = true;  // but for feet that only step to where the host has moved the stance
    double until = state_.clock + k_longest_passing;
    std::array<FootholdPass, 2 * (1 + Forecast::k_most_runs)> passes;
    std::size_t count = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const FootState& foot = state_.feet[side];
        if (foot.plant.passing > state_.clock || line.count == 0)
            passes[count++] = {foot.plant.passing, foot.plant.foothold.y};
        if (!foot.has_next) continue;
        standing = standing && foot.next.held;
        until = std::max(until, foot.strike);
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
        const auto height = [&](const FootState& foot) { return (foot.has_next ? foot.next : foot.plant).foothold.y; };
        count = 0;
        passes[count++] = {until, 0.5f * (height(state_.feet[0]) + height(state_.feet[1]))};
    }
    for (std::size_t i = 0; i < count; ++i) line.add(passes[i]);
}

/// How far the hips' base stands above what a leg can reach at a sample; above 0 where the leg is long enough.
float Planner::shortfall(std::size_t side, int sample) const noexcept {
    const LegPoints& p = forecast_.legs[side][static_cast<std::size_t>(sample)];
    const float length = distance(p.hip, p.knee) + distance(p.knee, p.ankle);
    const Vec3 ankle = place_foot(state_.feet[side], forecast_.time(sample), p, leg(side)).ankle;
    const float reach = std::max(rig_.settings.reach * length, distance(p.hip, p.ankle));
    const float across = planar_length(ankle - p.hip), low = k_least_leg * length;
    const float rise = std::sqrt(std::max(reach * reach - across * across, low * low));
    return ankle.y + rise - p.hip.y - base_[static_cast<std::size_t>(sample)];
}

float Planner::least_shortfall(std::size_t side, double from, double until) const noexcept {
    float least = 0;
    for (int i = 0; i < Forecast::k_samples; ++i)
        if (forecast_.time(i) >= from && forecast_.time(i) <= until) least = std::min(least, shortfall(side, i));
    return least;
}

/// Where only the trailing leg keeps the hips low (uphill), its heel rises about the ball before it lifts, as far as
/// that helps. Only in walks: where the other foot stands by then.
void Planner::plan_rise(std::size_t side) noexcept {
    FootState& foot = state_.feet[side];
    const FootState& other = state_.feet[1 - side];
    const double now = state_.clock;
    if (foot.rise > 0 && now >= foot.rise_from && now < foot.rise_until) return;  // under way
    foot.rise = 0;
    if (!foot.has_next || foot.lift <= now) return;
    const bool double_support = !other.has_next || other.lift > foot.lift || other.strike < foot.lift;
    if (!double_support) return;
    double flat_until = now;
    for (int i = 0; i < Forecast::k_samples && forecast_.time(i) < foot.lift; ++i)
        if (forecast_.heel_down[side][static_cast<std::size_t>(i)]) flat_until = forecast_.time(i);
    if (foot.lift - flat_until < k_shortest_rise) return;
    const double until = foot.lift + k_rise_after;
    const float wanted =
        std::min({least_shortfall(1 - side, flat_until, until), least_shortfall(side, now, flat_until)});
    if (least_shortfall(side, flat_until, until) > wanted - k_rise_worth) return;
    foot.rise_from = flat_until;
    foot.rise_peak = foot.lift;
    foot.rise_until = std::min(foot.lift + k_rise_fall, foot.strike - 2 * k_moment);
    float low = 0, high = k_most_rise;
    for (int round = 0; round < k_rise_rounds; ++round) {
        foot.rise = 0.5f * (low + high);
        (least_shortfall(side, flat_until, until) < wanted ? low : high) = foot.rise;
    }
    foot.rise = high;
    foot.hump.start_value = foot.hump.start_slope = 0;
    clear_ground(side);
}

void Planner::plan_hips() noexcept {
    plan_line();
    const double lead = 2.0 / static_cast<double>(rig_.settings.hip_stiffness);  // the spring's lag on a ramp
    if (!state_.started) {
        const float here = state_.line.at(state_.clock + lead);
        state_.base = {here, (state_.line.at(state_.clock + lead + 0.1) - here) / 0.1f};
    }
    HeightSpring base = state_.base;
    constexpr float k_step = 1.0f / Forecast::k_rate;
    const float stiffness = rig_.settings.hip_stiffness, decay = exp(-stiffness * k_step);
    for (int i = 0; i < Forecast::k_samples; ++i) {
        if (i) base.step(state_.line.at(forecast_.time(i) + lead), stiffness, k_step, decay);
        base_[static_cast<std::size_t>(i)] = base.value;
    }
    plan_rise(0);
    plan_rise(1);
    std::array<float, Forecast::k_samples> short_by;
    for (int i = 0; i < Forecast::k_samples; ++i)
        short_by[static_cast<std::size_t>(i)] = std::min({0.0f, shortfall(0, i), shortfall(1, i)});
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

void plan_feet(const FootRig& rig, FootPlacementState& state, const GroundProbe& probe,
               const LegPreview& preview) noexcept {
    Forecast forecast;
    look_ahead(rig, state.clock, preview, forecast);
    measure_cadence(state.pace, forecast);
    replant(rig, state, forecast);
    if (!state.started)
        for (FootState& foot : state.feet) foot.plant.foothold.y = probe.fallback;
    Planner planner(rig, state, probe, forecast);
    planner.plan_foot(0);
    planner.plan_foot(1);
    planner.plan_hips();
    state.started = true;
    state.next_plan = state.clock + k_plan_interval;
    for (std::size_t side = 0; side < 2; ++side) {
        FootState& foot = state.feet[side];
        foot.foreseen_at = is_swinging(foot, state.clock) ? foot.strike : state.next_plan;
        foot.rests = forecast.rests[side];
        const LegPoints then = forecast.at(side, foot.foreseen_at);
        foot.foreseen = (then.heel + then.ball) * 0.5f;
    }
    ++state.plans;
}

}  // namespace surefoot
