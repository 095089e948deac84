#pragma once
// The figures of a walk while it goes on: those of its last seconds.

#include <surefoot/course/figures.h>
#include <surefoot/course/placed_walker.h>

#include <deque>
#include <optional>

namespace surefoot {

class RollingMetrics {
  public:
    /// Of the last `seconds` at k_walk_fps.
    explicit RollingMetrics(float seconds = 4);

    void clear() noexcept;
    /// A frame more; call it at k_walk_fps of the walk's own time.
    void add(const PlacedWalker& placed, const Legs& legs);
    /// Nothing before there are two seconds. `info` says which marks hold; drift is not measured.
    std::optional<MeasuredWalk> measure(const Ground& ground, const WalkInfo& info, FootMode mode) const;

    /// The last frame, in the world; and as on flat ground (the twin). Only after `add`.
    const TrackFrame& walked() const noexcept { return walked_.back(); }
    const TrackFrame& twin() const noexcept { return twin_.back(); }

  private:
    std::size_t most_;
    std::deque<TrackFrame> walked_, twin_;
    std::vector<Transform> world_;
};

}  // namespace surefoot
