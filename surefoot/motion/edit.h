#pragma once
// Edits of whole clips. All keep the skeleton; none needs root motion to be extracted, and all keep it consistent where
// it is.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/mirror.h>
#include <surefoot/rig/roles.h>

namespace surefoot {

/// Frames first_frame to last_frame inclusive (clamped to the clip; at least one frame remains). The result is not
/// marked cyclic unless it is the whole clip. Root frames are kept as they are; see start_at_origin.
Motion cut(const Motion& motion, int first_frame, int last_frame);

/// Moves and turns the clip so that its first root frame is at the origin facing +Z (its height is kept).
void start_at_origin(Motion& motion);

/// Left and right exchanged: world positions are reflected in the plane x = 0. Joints are paired by role, then by the
/// side in their names, the rest with themselves. Exact where the skeleton's rest pose is symmetric; else each side
/// keeps its own bone lengths and takes the other's reflected rotations. Mirroring twice gives the clip back.
Motion mirror(const Motion& motion, const RoleMap& roles);

/// Partner of each joint under mirroring (itself for joints on the middle line): by role, then by name.
std::vector<int> mirror_pairs(const Skeleton& skeleton, const RoleMap& roles);
/// What `mirror` does to each pose, for the runtime.
MirrorMap mirror_map(const Skeleton& skeleton, const RoleMap& roles);

/// The clip played backwards; root motion runs backwards too and starts where it started. Cyclic stays cyclic.
Motion reverse(const Motion& motion);

/// The same clip at another frame rate [Limit: > 0]: slerp of rotations, linear translations and root frames.
/// Duration is kept: a clip whose duration is no whole number of new frames gets the nearest count and a rate that
/// differs accordingly (never by more than half a frame). Throws Error where `fps` is no positive number.
Motion resample(const Motion& motion, float fps);

inline constexpr float k_slowest_retime = 0.8f, k_fastest_retime = 1.25f;

/// The clip played `rate` times as fast, at (nearly) its own frame rate: the same steps in less or more time, so speed
/// and turn grow with the rate. Moments of the clip come at time / rate. Beyond [k_slowest_retime, k_fastest_retime]
/// weight no longer looks like weight (a walk played 1.5 times as fast is no brisk walk): throws Error there.
Motion retime(const Motion& motion, float rate);

/// Pose and root between frames: `time` in seconds from the first frame, clamped (cyclic clips wrap, travel added).
void sample(const Motion& motion, float time, RootFrame& root, std::span<Transform> locals);

struct LoopClosing {
    float seam = 0;        ///< [m] largest joint position mismatch, first to last frame, in root space, as it was
    float seam_speed = 0;  ///< [m/s] largest joint velocity mismatch there, in root space, as it was
    float added = 0;       ///< [m] largest displacement of a joint in root space that closing added in any frame
};

/// What close_loop would report as seam and seam_speed, without changing anything (added stays 0).
LoopClosing measure_seam(const Motion& motion);

struct LoopOptions {
    /// Fit the root's step over the cycle to the body's own first (world poses unchanged); else it is taken as it is.
    bool fit_step = true;
    /// [s] on either side of the seam in which velocities are led into each other; 0 leaves them as they are, which
    /// adds less displacement and more of a jolt. Half a metre a second costs 0.6 cm at 0.08 s.
    float velocity_width = 0.08f;
};

/// Makes first and last pose equal (relative to the root); sets `cyclic`. Needs extracted root motion: what travels
/// must be in the root frames. The mismatch is spread over the cycle, half at either end, rotations by rotation
/// vectors, translations linearly. Run extract_root_motion again afterwards for a root path that is smooth across the
/// seam.
LoopClosing close_loop(Motion& motion, const LoopOptions& options = {});

/// A cyclic clip begun at another of its frames: the same loop, entered later. `first_frame` in [0, frame_count - 1);
/// root frames go on over the old seam with the cycle's travel added. Clips that are not cyclic come back unchanged.
Motion rotate_cycle(const Motion& motion, int first_frame);

/// What a joint with one child turns about its own bone, against rest, is taken out of it; the child keeps its place in
/// model space. Collar bones do not turn so, but captures and retargeting sometimes have them do. Joints with no child
/// or several stay as they are.
void untwist(Motion& motion, int joint);

/// Clips of one skeleton and frame rate one after the other: each starts at the root frame where the last one ended
/// (its first frame replaces the last frame before it). Needs at least one.
Motion concatenate(std::span<const Motion> parts);

}  // namespace surefoot
