// Mode colvin2013: Colvin & Kajala 2013, §IV.B, the five steps as printed.

#include <surefoot/ik/colvin_trace.h>
#include <surefoot/ik/placing.h>

#include <algorithm>

namespace surefoot {
namespace {

/// The side of the thigh to which the knee bends, perpendicular to it.
Vec3 thigh_forward(const FootRig& rig, std::size_t side, const WorldLeg& leg) noexcept {
    const LegPoints& p = leg.points;
    const Vec3 thigh = normalized(p.knee - p.hip), off = p.knee - p.ankle;
    const Vec3 bend = off - thigh * dot(off, thigh), hint = world_knee_forward(rig, side, leg);
    return length(bend) > 0.02f * length(off) ? normalized(bend)
                                              : normalized(hint - thigh * dot(hint, thigh), {0, 0, 1});
}

using WorldLegs = std::array<WorldLeg, 2>;

WorldLegs world_legs(const FootRig& rig, const FootInput& input) noexcept {
    return {world_leg(rig.legs.side[0], input.legs.side[0], input.root),
            world_leg(rig.legs.side[1], input.legs.side[1], input.root)};
}

ColvinFrame colvin_frame(const FootRig& rig, const FootInput& input, const GroundProbe& probe,
                         const WorldLegs& legs) noexcept {
    ColvinFrame frame;
    frame.ground = probe.fallback;  // the root stands on the ground under it
    for (std::size_t side = 0; side < 2; ++side) {
        const LegPoints& p = legs[side].points;
        // Step 1: ground under the animated foot, plus the animated foot's own height.
        frame.legs[side].target = {p.ankle.x, probe.height(p.ankle.x, p.ankle.z) + p.ankle.y, p.ankle.z};
        // Step 2: where thigh and calf cannot reach, the root sinks.
        const float reach = distance(p.hip, p.knee) + distance(p.knee, p.ankle);
        frame.lowered = std::min(frame.lowered,
                                 colvin_step2_lower_root(p.hip + k_up * frame.ground, frame.legs[side].target, reach));
    }
    const Vec3 lift = k_up * (frame.ground + frame.lowered);
    for (std::size_t side = 0; side < 2; ++side) {
        const LegPoints& p = legs[side].points;
        ColvinInput& in = frame.legs[side];
        in.hip = p.hip + lift;
        in.knee = p.knee + lift;
        in.ankle = p.ankle + lift;
        in.forward = rotate(from_yaw(input.root.yaw), {0, 0, 1});
        in.upper_forward = thigh_forward(rig, side, legs[side]);
    }
    return frame;
}

}  // namespace

void place_colvin(const FootRig& rig, const FootInput& input, const GroundProbe& probe, FootOutput& output) noexcept {
    const WorldLegs legs = world_legs(rig, input);
    const ColvinFrame frame = colvin_frame(rig, input, probe, legs);
    output = {};
    output.moves_legs = true;
    output.hips_offset = frame.ground + frame.lowered - input.root.position.y;
    for (std::size_t side = 0; side < 2; ++side) {
        const TwoBoneResult solved = solve_colvin(frame.legs[side]);
        // The foot keeps its rotation relative to the calf: the paper turns thigh and calf only.
        output.leg[side] = to_locals(legs[side], solved.upper, solved.lower, solved.lower, solved.lower);
        output.pulled_in[side] = solved.pulled_in;
        output.planted[side] = false;
    }
}

ColvinFrame colvin_frame(const FootRig& rig, const FootInput& input, const Ground& ground) noexcept {
    return colvin_frame(rig, input, probe_for(rig, input, ground), world_legs(rig, input));
}

}  // namespace surefoot
