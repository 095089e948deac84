#pragma once
// Ground that moves: platforms, lifts, ferries. Inner header of the ik room.
//
// Everything that is planned lives in the frame of what the character stands on: the root is carried by the host
// (FootOutput::ground_velocity), the places of the clip's feet with it, and each foothold by its own surface.

#include <surefoot/ik/foot_forecast.h>

namespace surefoot {

/// `dt` seconds have passed: footholds, and what else the state knows of the world, go with the ground.
void ride(FootPlacementState& state, const GroundProbe& probe, float dt) noexcept;

/// What the ground under each foot is and how it moves, for the host.
void feel_ground(const FootRig& rig, FootPlacementState& state, const FootInput& input, const GroundProbe& probe,
                 FootOutput& output) noexcept;

}  // namespace surefoot
