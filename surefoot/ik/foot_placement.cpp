#include <surefoot/ik/foot_forecast.h>
#include <surefoot/ik/pace.h>
#include <surefoot/ik/placing.h>
#include <surefoot/ik/replant.h>
#include <surefoot/ik/ride.h>
#include <surefoot/ik/two_bone.h>
#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr double k_check_interval = 1.0 / 15;  // [s] how often a coming foothold is looked at again
constexpr double k_landing = 0.2;  // [s] before a strike it is looked at in every frame: a stop cannot wait any longer
constexpr float k_moved = 0.006f;  // [m] by which steering must have moved it to plan anew
constexpr float k_too_late = 0.06f;     // [s] before a strike nothing is planned anew
constexpr float k_fade_stiffness = 20;  // [1/s] of the spring on the weight: nine tenths within a fifth of a second
constexpr float k_faded = 2e-3f;        // as good as there: half a millimetre of a foot 25 cm off
constexpr float k_flat = 0.035f, k_most_drift = 0.1f;  // of the leg's length
constexpr float k_sinking = 14, k_rising = 10;         // [1/s] of what is left of earlier plans
constexpr float k_hold = 40;                           // [1/s]
constexpr float k_lean_stiffness = 6;                  // [1/s]
constexpr float k_spring_step = 1.0f / 60;             // [s] the forecast's step: longer frames are cut into such

// --- mode none

void place_root(const FootInput& input, const GroundProbe& probe, FootOutput& output) noexcept {
    output = {};
    output.hips_offset = probe.fallback - input.root.position.y;
}

// --- mode surefoot

/// What lifts a toe tip out of the ground, on top of the foot's own rotation. On level ground a tip may be as deep as
/// the clip has it.
Quat bend_toes(const WorldLeg& leg, const PlacedFoot& placed, Vec3 ankle, const GroundProbe& probe) noexcept {
    const Vec3 joint = ankle + rotate(placed.tilt, leg.toe_joint - leg.points.ankle);
    const Vec3 toe = rotate(placed.toes_tilt, leg.points.toe_tip - leg.toe_joint), tip = joint + toe;
    const float own = std::min(0.0f, leg.points.toe_tip.y) * (1 - placed.uneven);
    return bend_toe_up(toe, probe.height(tip.x, tip.z) + own - tip.y);
}

/// True where steering has moved what was foreseen: the foothold of a foot that swings, or the way of one that stands,
/// which now shall go, or stay.
bool steered_away(const FootRig& rig, const FootPlacementState& state, const LegPreview& preview) noexcept {
    for (std::size_t side = 0; side < 2; ++side) {
        const FootState& foot = state.feet[side];
        const auto ahead = static_cast<float>(foot.foreseen_at - state.clock);
        if (ahead < k_too_late) continue;
        LegsPose legs;
        RootFrame root;
        preview.sample({&ahead, 1}, {&legs, 1}, {&root, 1});
        const LegPoints p = world_leg(rig.legs.side[side], legs.side[side], root).points;
        if (planar_length((p.heel + p.ball) * 0.5f - foot.foreseen) > k_moved) return true;
    }
    return false;
}

bool lands_soon(const FootPlacementState& state) noexcept {
    return std::any_of(state.feet.begin(), state.feet.end(), [&](const FootState& foot) {
        return is_swinging(foot, state.clock) && foot.strike - state.clock < k_landing;
    });
}

/// All but how much it applies.
void forget(FootPlacementState& state) noexcept {
    const HeightSpring weight = state.weight;
    state = {};
    state.weight = weight;
}

void advance(const FootRig& rig, FootPlacementState& state, float dt) noexcept {
    const float stiffness = rig.settings.hip_stiffness;
    const double lead = 2.0 / static_cast<double>(stiffness);
    constexpr int k_most_steps = 60;
    const int steps = std::clamp(static_cast<int>(std::ceil(dt / k_spring_step - 0.01f)), 1, k_most_steps);
    const float step = dt / static_cast<float>(steps);
    for (int i = 0; i < steps; ++i) {
        state.clock += static_cast<double>(step);
        state.base.step(state.line.at(state.clock + lead), stiffness, step);
        state.hips_rest.step(state.hips_rest.value > 0 ? k_sinking : k_rising, step);
    }
}

/// Height of the hips as it is planned, and how that goes on.
HeightRest planned_hips(const FootRig& rig, const FootPlacementState& state) noexcept {
    constexpr float k_moment = 1.0f / 60;  // [s]
    const auto limit = [&](float later) { return state.limiter.at(state.clock + static_cast<double>(later)); };
    const float before = limit(-k_moment), now = limit(0), after = limit(k_moment);
    const float w = rig.settings.hip_stiffness;
    const float target = state.line.at(state.clock + 2.0 / static_cast<double>(w));
    return {state.base.value + now, state.base.rate + (after - before) * (0.5f / k_moment),
            w * (w * (target - state.base.value) - 2 * state.base.rate) +
                (before - 2 * now + after) * (1 / (k_moment * k_moment))};
}

/// A new plan may find that the legs are short at once, where steering changed or ground came into sight late: the hips
/// go there as smoothly as they can.
void plan_smoothly(const FootRig& rig, FootPlacementState& state, const GroundProbe& probe,
                   const LegPreview& preview) noexcept {
    const bool goes_on = state.started;
    const HeightRest before = goes_on ? planned_hips(rig, state) : HeightRest{};
    plan_feet(rig, state, probe, preview);
    if (!goes_on) return;
    const HeightRest after = planned_hips(rig, state);
    state.hips_rest.value += before.value - after.value;
    state.hips_rest.rate += before.rate - after.rate;
    state.hips_rest.acceleration += before.acceleration - after.acceleration;
}

/// A foot that stands flat on a foothold that was sought out stays there though the clip's own foot drifts, as it does
/// where a walk is blended with a stand: there may be no room beside it.
void hold(FootState& foot, const LegPoints& points, float leg_length, float dt) noexcept {
    const float low = k_flat * leg_length;
    if (foot.plant.held) return;
    if (!is_sought_out(foot.plant) || points.heel.y > low || points.ball.y > low) return;
    const Vec3 drift = (points.heel + points.ball) * 0.5f - foot.plant.centre;
    if (planar_length(drift) > k_most_drift * leg_length) return;
    foot.plant.centre += Vec3{drift.x, 0, drift.z} * (1 - exp(-k_hold * dt));
}

/// 0 of a foot that stands, 1 in the middle of its swing, smooth between them.
float in_the_air(const FootState& foot, double clock) noexcept {
    if (!is_swinging(foot, clock)) return 0;
    constexpr float k_ends = 0.25f;  // of the swing
    const auto share = static_cast<float>((clock - foot.lift) / (foot.strike - foot.lift));
    return smootherstep(std::min(1.0f, std::min(share, 1 - share) / k_ends));
}

/// `first`: it has long been on this slope.
float ease_lean(const FootRig& rig, FootPlacementState& state, float slope, bool first, float dt) noexcept {
    if (!rig.settings.lean) return 0;
    const float wanted = slope_lean(slope);
    if (first)
        state.lean = {wanted, 0};
    else
        state.lean.step(wanted, k_lean_stiffness, dt);
    return state.lean.value;
}

void place_planned(const FootRig& rig, FootPlacementState& state, const FootInput& input, const GroundProbe& probe,
                   const LegPreview& preview, FootOutput& output) noexcept {
    if (input.teleport) forget(state);
    const bool first = !state.started;
    bool plan = first;
    if (!plan) {
        ride(state, probe, std::max(input.dt, 0.0f));
        advance(rig, state, std::max(input.dt, 0.0f));
        for (FootState& foot : state.feet)
            if (foot.has_next && state.clock >= foot.strike) {
                foot.plant = foot.next;
                foot.has_next = false;
                foot.rise = 0;
                foot.lift = foot.strike = k_never;
                plan = true;
            }
        plan |= state.clock >= state.next_plan;
        if (!plan && (state.clock >= state.next_check || lands_soon(state))) {
            plan = steered_away(rig, state, preview);
            state.next_check = state.clock + k_check_interval;
        }
    }
    plan |= feel_drag(rig, state, input);
    if (plan) plan_smoothly(rig, state, probe, preview);
    if (rig.settings.limit_pace) keep_pace(rig, state, input, probe, preview);

    const float hips = state.base.value + state.limiter.at(state.clock) + state.hips_rest.value;
    output = {};
    output.speed_limit = state.pace.limit;
    output.moves_legs = true;
    output.hips_offset = hips - input.root.position.y;
    std::array<Quat, 2> tilts;
    for (std::size_t side = 0; side < 2; ++side) {
        const WorldLeg leg = world_leg(rig.legs.side[side], input.legs.side[side], input.root);
        FootState& foot = state.feet[side];
        output.planted[side] = !foot.has_next || state.clock < foot.lift;
        if (output.planted[side]) hold(foot, leg.points, rig.legs.side[side].length(), std::max(input.dt, 0.0f));
        const PlacedFoot placed = place_foot(foot, state.clock, leg.points, rig.legs.side[side]);
        tilts[side] = ground_tilt(foot, state.clock);
        TwoBone in;
        in.hip = leg.points.hip + k_up * hips;
        in.knee = leg.points.knee + k_up * hips;
        in.ankle = leg.points.ankle + k_up * hips;
        in.target = placed.ankle;
        in.knee_forward = world_knee_forward(rig, side, leg);
        in.target = unfolded_target(in, in_the_air(foot, state.clock));
        const TwoBoneResult solved = solve_two_bone(in);
        const Quat bend = rig.legs.side[side].toes == k_no_joint ? Quat{} : bend_toes(leg, placed, solved.ankle, probe);
        output.leg[side] = to_locals(leg, solved.upper, solved.lower, placed.tilt, bend * placed.toes_tilt);
        output.pulled_in[side] = solved.pulled_in;
    }
    output.lean = ease_lean(rig, state, slope_along(tilts, input.root.yaw), first, std::max(input.dt, 0.0f));
    feel_ground(rig, state, input, probe, output);
}

}  // namespace

GroundProbe probe_for(const FootRig& rig, const FootInput& input, const Ground& ground) noexcept {
    GroundProbe probe{ground, input.root.position.y, rig.settings.ground_up, rig.settings.ground_down,
                      input.root.position.y};
    probe.fallback = probe.height(input.root.position.x, input.root.position.z);
    return probe;
}

/// New local rotations from world rotations to put before the animated ones.
FootOutput::LegRotations to_locals(const WorldLeg& leg, Quat upper, Quat lower, Quat foot, Quat toes) noexcept {
    return {normalized(conjugate(leg.upper_parent) * upper * leg.upper),
            normalized(conjugate(upper * leg.lower_parent) * lower * leg.lower),
            normalized(conjugate(lower * leg.foot_parent) * foot * leg.foot),
            normalized(conjugate(foot * leg.toes_parent) * toes * leg.toes)};
}

Vec3 world_knee_forward(const FootRig& rig, std::size_t side, const WorldLeg& leg) noexcept {
    return rotate(leg.upper, rig.knee_forward[side]);
}

const char* foot_mode_name(FootMode mode) noexcept {
    switch (mode) {
        case FootMode::none:
            return "none";
        case FootMode::colvin2013:
            return "colvin2013";
        case FootMode::surefoot:
            break;
    }
    return "surefoot";
}

Vec3 knee_forward(const Leg& leg, std::span<const Transform> standing) noexcept {
    const Transform& foot = standing[static_cast<std::size_t>(leg.foot)];
    const Transform& upper = standing[static_cast<std::size_t>(leg.upper)];
    return rotate(conjugate(upper.rotation), rotate(foot.rotation, leg.forward));
}

FootRig make_foot_rig(const Skeleton& skeleton, const Legs& legs, std::span<const Transform> standing,
                      const FootSettings& settings) {
    FootRig rig;
    rig.legs = legs;
    rig.settings = settings;
    rig.solver = std::make_shared<const SwingSolver>();
    rig.hips = legs.hips;
    rig.lean_joints = find_lean_joints(skeleton, standing);
    rig.parents = skeleton.parents;
    for (std::size_t side = 0; side < 2; ++side) rig.knee_forward[side] = knee_forward(legs.side[side], standing);
    return rig;
}

namespace {

/// In model space; a joint without a parent has the model's own.
Quat parent_rotation(const FootRig& rig, std::span<const Transform> models, int joint) noexcept {
    const int parent = rig.parents[static_cast<std::size_t>(joint)];
    return parent == k_no_joint ? Quat{} : models[static_cast<std::size_t>(parent)].rotation;
}

}  // namespace

LegsPose read_legs(const FootRig& rig, std::span<const Transform> models) noexcept {
    const auto at = [&](int joint) { return models[static_cast<std::size_t>(joint)]; };
    LegsPose pose;
    for (std::size_t side = 0; side < 2; ++side) {
        const Leg& leg = rig.legs.side[side];
        LegPose& out = pose.side[side];
        out.upper = at(leg.upper);
        out.lower = at(leg.lower);
        out.foot = at(leg.foot);
        out.toes = leg.toes == k_no_joint ? out.foot : at(leg.toes);
        out.upper_parent = parent_rotation(rig, models, leg.upper);
        out.lower_parent = parent_rotation(rig, models, leg.lower);
        out.foot_parent = parent_rotation(rig, models, leg.foot);
        out.toes_parent = leg.toes == k_no_joint ? out.foot_parent : parent_rotation(rig, models, leg.toes);
    }
    return pose;
}

namespace {

/// The weight asked for, eased.
float ease_weight(FootPlacementState& state, const FootInput& input) noexcept {
    const float wanted = std::clamp(input.weight, 0.0f, 1.0f);
    if (state.weight.value < 0 || input.teleport)
        state.weight = {wanted, 0};
    else
        state.weight.step(wanted, k_fade_stiffness, std::max(input.dt, 0.0f));
    if (std::fabs(state.weight.value - wanted) < k_faded) state.weight = {wanted, 0};
    return state.weight.value;
}

/// From the clip's own pose to the placed one.
void fade(const FootRig& rig, const FootInput& input, float weight, FootOutput& output) noexcept {
    output.hips_offset *= weight;
    output.lean *= weight;
    for (std::size_t side = 0; output.moves_legs && side < 2; ++side) {
        const WorldLeg leg = world_leg(rig.legs.side[side], input.legs.side[side], input.root);
        const FootOutput::LegRotations own = to_locals(leg, {}, {}, {}, {});
        FootOutput::LegRotations& placed = output.leg[side];
        for (Quat FootOutput::LegRotations::*joint :
             {&FootOutput::LegRotations::upper, &FootOutput::LegRotations::lower, &FootOutput::LegRotations::foot,
              &FootOutput::LegRotations::toes})
            placed.*joint = slerp(own.*joint, placed.*joint, weight);
        output.planted[side] = output.planted[side] && weight > 0.5f;
    }
}

}  // namespace

void place_feet(const FootRig& rig, FootPlacementState& state, const FootInput& input, const Ground& ground,
                const LegPreview* preview, FootOutput& output) noexcept {
    const float weight = ease_weight(state, input);
    if (weight == 0) {  // in the air: footholds are sought anew when feet come down
        forget(state);
        output = {};
        return;
    }
    const GroundProbe probe = probe_for(rig, input, ground);
    switch (rig.settings.mode) {
        case FootMode::none:
            place_root(input, probe, output);
            break;
        case FootMode::colvin2013:
            place_colvin(rig, input, probe, output);
            break;
        case FootMode::surefoot:
            if (preview)
                place_planned(rig, state, input, probe, *preview, output);
            else
                place_colvin(rig, input, probe, output);
            break;
    }
    if (weight < 1) fade(rig, input, weight, output);
}

void apply(const FootRig& rig, const FootOutput& output, std::span<const Transform> models,
           std::span<Transform> locals) noexcept {
    const Quat parent = parent_rotation(rig, models, rig.hips);
    locals[static_cast<std::size_t>(rig.hips)].translation += rotate(conjugate(parent), k_up * output.hips_offset);
    lean(rig.lean_joints, rig.parents, output.lean, models, locals);
    if (!output.moves_legs) return;
    for (std::size_t side = 0; side < 2; ++side) {
        const Leg& leg = rig.legs.side[side];
        locals[static_cast<std::size_t>(leg.upper)].rotation = output.leg[side].upper;
        locals[static_cast<std::size_t>(leg.lower)].rotation = output.leg[side].lower;
        locals[static_cast<std::size_t>(leg.foot)].rotation = output.leg[side].foot;
        if (leg.toes != k_no_joint) locals[static_cast<std::size_t>(leg.toes)].rotation = output.leg[side].toes;
    }
}

Quat bend_toe_up(Vec3 toe, float lacking) noexcept {
    constexpr float k_most = 60 * k_radians_per_degree;
    const float length_of_toe = length(toe);
    if (!(lacking > 0) || length_of_toe < 1e-4f) return {};
    const float now = asin(std::clamp(toe.y / length_of_toe, -1.0f, 1.0f));
    const float then = asin(std::clamp((toe.y + lacking) / length_of_toe, -1.0f, 1.0f));
    return axis_angle(normalized(cross(toe, k_up), {1, 0, 0}), std::min(then - now, k_most));
}

void lift_toe_tips(const FootRig& rig, std::span<const Transform> models, std::span<Transform> locals) noexcept {
    for (std::size_t side = 0; side < 2; ++side) {
        const Leg& leg = rig.legs.side[side];
        if (leg.toes == k_no_joint) continue;
        const Transform& toes = models[static_cast<std::size_t>(leg.toes)];
        const Vec3 toe = rotate(toes.rotation, leg.toe_tip);
        const float lacking = -(toes.translation.y + toe.y);
        if (!(lacking > 0)) continue;
        const Quat parent = parent_rotation(rig, models, leg.toes);
        locals[static_cast<std::size_t>(leg.toes)].rotation =
            normalized(conjugate(parent) * bend_toe_up(toe, lacking) * toes.rotation);
    }
}

}  // namespace surefoot
