#pragma once
// Root motion: the travel of a clip as a frame on the ground (position and heading) apart from the pose.
//
// Before extraction all root frames are identity and the pose carries the travel. After it, the root runs along a
// low-passed path under the hips and looks where the torso looks; the hips' sway stays in the pose, which then stays
// near the origin facing +Z. World poses are the same before and after.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/roles.h>

namespace surefoot {

struct RootMotionOptions {
    /// [s] Gaussian sigma of the low-pass over heading, body velocity and what is left. 0.35 s leaves 2 % of the
    /// forward surge of a walk (1.8 Hz) in the path and 14 % of its sideways sway (0.9 Hz), and follows a real start
    /// or stop within a few centimetres. Cyclic clips of steps that repeat come out nearly straight.
    float smoothing = 0.35f;
    /// Root height: 0 throughout (flat ground), or the low-passed rise of the hips from the first frame on (slopes,
    /// stairs, ledges).
    bool follow_climb = false;
};

/// Heading of the torso [rad, (-pi, pi]]: the normal of hips and shoulders on the ground plane, not a joint's axis.
/// Needs both upper legs or both arms (0 without). Pelvis and shoulders counter-rotate in a gait, so their mean is
/// steadier than either. `models` may be in model or world space; the result is in that space.
float torso_yaw(const RoleMap& roles, std::span<const Transform> models);

/// Splits root motion from the pose (existing root frames are baked first). Needs roles[hips]; without hips nothing
/// changes. A joint above the hips (a dedicated root) is folded: it rests at the root frame, and what it carried goes
/// to its children, so that all other joints keep their world poses. A clip marked cyclic is treated as periodic with
/// its travel added; others are continued by their local linear trend, so that velocities hold to the ends.
/// Cost: O(frames * (joints + fps * smoothing)).
void extract_root_motion(Motion& motion, const RoleMap& roles, const RootMotionOptions& options = {});

/// Root motion back into the joints without parents; root frames become identity. World poses unchanged.
void bake_root_motion(Motion& motion);

/// Exchanges the root frames for others (one a frame) under unchanged world poses.
void set_root_frames(Motion& motion, std::span<const RootFrame> frames);

/// Puts a dedicated root joint (all joints above the hips) to rest at the root frame; what it carried goes to its
/// children, so that all other joints keep their world poses. Nothing happens without one, or without hips.
void fold_dedicated_root(Motion& motion, const RoleMap& roles);

/// Moves the clip against its root frames by `offset`: the ground to height 0, or the path to the origin. Dedicated
/// root joints above the hips stay where they are; everything below them moves.
void shift_pose(Motion& motion, const RoleMap& roles, Vec3 offset);

/// Turns and moves the whole clip in the world: world' = by * world. Only root frames change.
void move_clip(Motion& motion, const RootFrame& by);

}  // namespace surefoot
