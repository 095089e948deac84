#pragma once
// How alike two poses of one motion are, wherever on the ground they stand.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/roles.h>

namespace surefoot {

/// World positions of the body's main joints (fingers, eyes and jaw left out) and their velocities, every frame.
struct KeyPoses {
    int joints = 0;
    std::vector<Vec3> positions;   ///< [frame * joints + joint]
    std::vector<Vec3> velocities;  ///< [m/s] central differences

    std::span<const Vec3> pose(int frame) const noexcept { return slice(positions, frame); }
    std::span<const Vec3> speeds(int frame) const noexcept { return slice(velocities, frame); }
    int frame_count() const noexcept { return joints ? static_cast<int>(positions.size()) / joints : 0; }

  private:
    std::span<const Vec3> slice(const std::vector<Vec3>& of, int frame) const noexcept {
        const std::size_t count = static_cast<std::size_t>(joints);
        return {of.data() + static_cast<std::size_t>(frame) * count, count};
    }
};

KeyPoses key_poses(const Motion& motion, const RoleMap& roles);

struct PoseMatch {
    RootFrame
        step;  ///< the move on the ground (heading and place; y is the mean rise) that takes pose a to pose b best
    float distance = 0;  ///< [m] largest joint mismatch that is left, the mean rise not counted as mismatch
    float speed = 0;     ///< [m/s] largest mismatch of a joint's velocity
};

/// Least squares over the joints (planar Procrustes, closed form).
PoseMatch match_poses(const KeyPoses& poses, int a, int b);

/// The step that makes the *largest* mismatch least, which is what a viewer sees at a seam: least squares whose weights
/// grow with the mismatch until the worst joints share it (Lawson 1961). Costs about a dozen times match_poses.
PoseMatch match_poses_evenly(const KeyPoses& poses, int a, int b);

/// The same with the step given.
PoseMatch match_poses(const KeyPoses& poses, int a, int b, const RootFrame& step);

}  // namespace surefoot
