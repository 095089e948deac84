#pragma once
// A head that looks ahead. Private to the room.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/roles.h>

namespace surefoot {

/// Actors look at the floor before them and at what stands around; a game's character looks where it goes. Neck and
/// head take out what the gaze is off the horizon.
void level_head(Motion& motion, const RoleMap& roles);

}  // namespace surefoot
