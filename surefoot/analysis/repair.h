#pragma once
// Frames that a capture or an exporter dropped.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/roles.h>

#include <string>
#include <vector>

namespace surefoot {

struct Repair {
    int first = 0, last = 0;            ///< frames of the input that are left
    std::vector<std::string> warnings;  ///< what was done, with frame numbers of the input
};

/// Finds frames in which the hips are somewhere else altogether (CMU 09_10 holds some at the origin: no body moves 20
/// m/s from one frame to the next and back), cuts them off at the ends and fills them from their neighbours inside.
/// Where more than a third of the frames would go, nothing is touched and a warning says so.
Repair repair_dropped_frames(Motion& motion, const RoleMap& roles);

}  // namespace surefoot
