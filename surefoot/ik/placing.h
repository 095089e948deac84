#pragma once
// What the modes of foot placement share. Inner header of the ik room.

#include <surefoot/ik/foot_forecast.h>

namespace surefoot {

/// Looks for ground around the root's height; where there is none, it is as high as under the root.
GroundProbe probe_for(const FootRig& rig, const FootInput& input, const Ground& ground) noexcept;

/// New local rotations from world rotations to put before the animated ones.
FootOutput::LegRotations to_locals(const WorldLeg& leg, Quat upper, Quat lower, Quat foot, Quat toes) noexcept;

/// Where a straight knee would bend to, world.
Vec3 world_knee_forward(const FootRig& rig, std::size_t side, const WorldLeg& leg) noexcept;

/// Mode colvin2013.
void place_colvin(const FootRig& rig, const FootInput& input, const GroundProbe& probe, FootOutput& output) noexcept;

}  // namespace surefoot
