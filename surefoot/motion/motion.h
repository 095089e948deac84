#pragma once
// An editable clip: every joint of every frame in full precision, root motion apart from the pose.
//
// Space: world(joint) = to_transform(root[frame]) * chain of locals. Until root motion is extracted, all root frames
// are identity and the pose carries the travel. Frames are uniform in time: frame f is at f / fps seconds. A cyclic
// clip's last frame equals the first one cycle later (frame_count - 1 intervals make one cycle).

#include <surefoot/rig/skeleton.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

struct Motion {
    std::string name;                          ///< safe to show; see io/clip_name.h for file names
    std::shared_ptr<const Skeleton> skeleton;  ///< never null
    float fps = 30;                            ///< [Limit: > 0] frames a second
    bool cyclic = false;
    std::vector<RootFrame> root;    ///< one a frame
    std::vector<Transform> locals;  ///< [frame * joint_count + joint], relative to the parent joint

    int frame_count() const noexcept { return static_cast<int>(root.size()); }
    int joint_count() const noexcept { return skeleton->joint_count(); }
    /// Time from the first to the last frame, seconds.
    float duration() const noexcept { return frame_count() > 1 ? static_cast<float>(frame_count() - 1) / fps : 0.0f; }
    std::span<Transform> frame(int f) noexcept {
        return {locals.data() + static_cast<std::size_t>(f) * static_cast<std::size_t>(joint_count()),
                static_cast<std::size_t>(joint_count())};
    }
    std::span<const Transform> frame(int f) const noexcept {
        return {locals.data() + static_cast<std::size_t>(f) * static_cast<std::size_t>(joint_count()),
                static_cast<std::size_t>(joint_count())};
    }
};

/// A motion of `frames` frames in rest pose with identity root.
Motion make_motion(std::shared_ptr<const Skeleton> skeleton, std::string name, int frames, float fps);

/// World transforms of all joints at a frame (joint_count() of them), root motion included.
void world_pose(const Motion& motion, int frame, std::span<Transform> world);

/// The farthest that any joint is in the world from where the other motion has it [m], frame by frame. [Limit: both of
/// one skeleton and as many frames]
float largest_distance(const Motion& a, const Motion& b);

/// What is wrong with a motion (empty: nothing): no frames, arrays of wrong length, numbers that are not finite,
/// an unsound skeleton. The text names frame and joint.
std::string problem(const Motion& motion);

}  // namespace surefoot
