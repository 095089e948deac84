#pragma once
// A clip of one character put onto another: other proportions, another rest pose, other joints and axes.
//
//     Motion theirs = retarget(clip, {skeleton, roles, legs}, {their_skeleton, their_roles, their_legs});
//
// How. Joints meet by role. Both characters are brought to the same T-stance (motion/stance.h); what a joint turns
// against it in model space, its partner turns against its own. Spines and necks of different joint counts share the
// turn evenly along the chain. Everything that travels is scaled by the ratio of the legs' lengths: the root's path,
// the hips' sway, their height above the ankles. So steps stay natural and speed scales with the legs, while cadence
// stays; turn rates and slopes do not change. The feet are then put where they belong by two-bone inverse kinematics
// (ik/two_bone.h): the sole points that touch the ground follow the scaled path of the source's, so what stood still
// stands still, whatever the sizes of the feet; feet are set wider or closer by the difference in hip width. Where a
// leg would have to be straighter than it can be, the hips sink, smoothly. Arms are moved by rotation only.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/leg.h>

namespace surefoot {

/// A character as retargeting sees it.
struct RetargetBody {
    std::shared_ptr<const Skeleton> skeleton;
    RoleMap roles;
    Legs legs;  ///< soles measured where the feet stand flat (rig/leg.h)
    /// A pose in model space in which no bone is twisted about itself, joint_count() long; empty: the rest pose.
    std::vector<Transform> shape;
};

struct RetargetOptions {
    /// [Range: 0.9 to 1] share of a leg's length to which it may stretch without the hips sinking. Legs that the source
    /// stretches further may stretch as far.
    float straightest_leg = 0.995f;
    /// [s] sigma of the Gaussian that smooths the sinking of the hips.
    float sink_smoothing = 0.08f;
};

/// What retargeting did, for messages and tests.
struct RetargetReport {
    float scale = 1;  ///< target's leg length over the source's: of speeds and paths
    float sink = 0;   ///< [m] by how much the hips sank at most
};

/// `motion` on the target's skeleton: same frames, frame rate, cyclic flag and name. Its skeleton must be the source's,
/// its ground at y = 0 (in root space; in the world, where root motion is not extracted). Joints that only the target
/// has, and what lies above its hips, keep their place in its shape pose relative to their parents; those without a
/// role that both skeletons name alike, below parents named alike, turn alike. Bones keep the target's lengths. The
/// target's feet rest on y = 0 where the source's do. Throws Error naming the roles that are missing: hips and both
/// legs are needed on both sides. Costs time linear in frames and joints.
Motion retarget(const Motion& motion, const RetargetBody& source, const RetargetBody& target,
                const RetargetOptions& options = {}, RetargetReport* report = nullptr);

}  // namespace surefoot
