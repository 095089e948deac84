#pragma once
// Feet that slide where they should stand, held to the ground.

#include <surefoot/motion/steer.h>
#include <surefoot/rig/leg.h>

namespace surefoot {

struct PlantReport {
    float moved = 0;   ///< [m] farthest that a foot was moved
    float turned = 0;  ///< [rad] farthest that one was turned
    float missed = 0;  ///< [m] farthest that a leg was too short for its foot's place
};

/// Takes the slip out of every stance: what the part of the sole that touches the ground (heel, ball or both, as the
/// foot rolls) travels and turns while the foot stands is taken back, evenly to either side of the stance's mean place,
/// and in the swing the foot goes over from one correction to the next. On the ball alone a foot may pivot. Heights,
/// the roll of the foot and the body stay. Needs extracted root motion; a foot without stances is left alone. Cost:
/// linear in frames and joints.
Motion plant(const Motion& motion, const RoleMap& roles, const Legs& legs, const StanceFlags& stances,
             PlantReport* report = nullptr);

}  // namespace surefoot
