#pragma once
// How far apart two clips' poses are when both are at the same point of their cycle: what blending has to bridge.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/roles.h>

#include <vector>

namespace surefoot {

struct ClipFacts;

/// Joint positions of a clip in root space at k_pose_phases equal steps of phase (0 is a left foot strike; clips
/// without steps are sampled evenly from their first frame).
struct PoseTable {
    int joints = 0;
    bool stepping = false;
    std::vector<Vec3> positions;  ///< [phase * joints + joint] of the joints that roles name, in order of role
};
inline constexpr int k_pose_phases = 16;

PoseTable make_pose_table(const Motion& motion, const ClipFacts& facts, const RoleMap& roles);

/// Mean distance of the joints over a cycle [m]. Where one of the two has no steps, each of its poses meets all of the
/// other's. NaN where the tables do not belong to one skeleton.
float pose_distance(const PoseTable& a, const PoseTable& b);

}  // namespace surefoot
