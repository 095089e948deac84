#pragma once
// Walks a character over a course, frame by frame at 60 Hz, as a game would.

#include <surefoot/course/course.h>
#include <surefoot/course/metrics.h>
#include <surefoot/ik/foot_placement.h>
#include <surefoot/motion/motion.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace surefoot {

inline constexpr float k_walk_fps = 60;

/// A source of un-placed motion on flat ground: a looped clip or a baked character with its graph.
class Walker {
  public:
    virtual ~Walker() = default;
    virtual const std::shared_ptr<const Skeleton>& skeleton() const = 0;
    virtual const Legs& legs() const = 0;
    /// A standing pose in model space.
    virtual std::span<const Transform> standing() const = 0;
    /// Back to the start: the root at the origin facing +Z, already walking.
    virtual void start(float speed_mps) = 0;
    /// Advances by dt (0 at the first frame); gives the root in the world and the pose.
    virtual void step(float dt, RootFrame& root, std::span<Transform> locals) = 0;
    /// What comes next if nothing is steered, without advancing.
    virtual void peek(std::span<const float> ahead, std::span<RootFrame> roots,
                      const std::function<void(std::size_t, std::span<const Transform>)>& pose) const = 0;
};

/// Plays one cyclic clip (root motion extracted) again and again, sped up or slowed down to the speed asked for.
std::unique_ptr<Walker> make_clip_walker(const Motion& clip, const Legs& legs);

struct WalkRequest {
    float speed_mps = 1.4f;
    float seconds = 10;
    FootMode mode = FootMode::surefoot;
};

struct Walked {
    Motion motion;                             ///< in the world, at k_walk_fps: root frames and placed poses
    std::array<std::vector<bool>, 2> planted;  ///< by Side, one a frame: what foot placement says
    int plans = 0;                             ///< how often it planned
};

Walked walk(Walker& walker, const Ground& ground, const WalkRequest& request);

}  // namespace surefoot
