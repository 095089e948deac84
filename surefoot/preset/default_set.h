#pragma once
// The embedded default: a generated biped and a set of generated clips, so that everything works without a single
// downloaded file. This header is the whole seam: what makes the clips may change behind it.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/roles.h>

#include <memory>
#include <vector>

namespace surefoot {

struct DefaultSet {
    std::shared_ptr<const Skeleton> skeleton;
    RoleMap roles;
    /// Cyclic clips at 60 frames a second that start at a left foot strike: idle; walk, jog, run and back, each
    /// straight, _left and _right; strafe_left and strafe_right; turn_left and turn_right on the spot, and the same
    /// _slow. Velocity and yaw rate of Motion::root are constant, feet stand still where they stand, soles at y = 0.
    std::vector<Motion> clips;
};

/// Takes a few milliseconds; the same bytes every time.
DefaultSet make_default_set();

}  // namespace surefoot
