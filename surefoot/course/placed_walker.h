#pragma once
// A walker with its feet on a ground, one step of time after the other: what `walk` records, and what somebody who
// steers looks at.

#include <surefoot/course/walk.h>

#include <memory>
#include <span>
#include <vector>

namespace surefoot {

/// Foot placement's own limit of the pace, instead of one that is given.
inline constexpr float k_own_limit = -1;

class PlacedWalker {
  public:
    /// `walker` and `ground` must outlive it.
    PlacedWalker(Walker& walker, const Ground& ground, const FootSettings& settings = {});
    ~PlacedWalker();
    PlacedWalker(const PlacedWalker&) = delete;
    PlacedWalker& operator=(const PlacedWalker&) = delete;

    /// Back to the start of the way: the first frame. `speed_limit` [m/s] is said to the walker after it.
    void start(float speed_mps, float speed_limit = k_own_limit);
    /// The same from where the walker is now: for who takes over a walker on its way.
    void take_up(float speed_limit = k_own_limit);
    /// `dt` > 0 seconds on.
    void advance(float dt, float speed_limit = k_own_limit) noexcept;
    /// Another way to place feet: they let go in the old one, then take hold in the new one, within a second and
    /// without a jump.
    void set_mode(FootMode mode) noexcept { mode_ = mode; }
    /// On the way from one mode to another.
    bool changes_mode() const noexcept { return rig_.settings.mode != mode_ || takes_hold_; }

    const Skeleton& skeleton() const noexcept { return *walker_.skeleton(); }
    const FootRig& rig() const noexcept { return rig_; }
    const RootFrame& root() const noexcept { return root_; }                  ///< world; on the ground under it
    std::span<const Transform> locals() const noexcept { return locals_; }    ///< placed
    std::span<const Transform> unplaced() const noexcept { return models_; }  ///< model space, as on flat ground
    const FootOutput& feet() const noexcept { return output_; }
    const FootPlacementState& state() const noexcept { return state_; }
    float speed_limit() const noexcept { return limit_; }  ///< [m/s] what the walker was told last

  private:
    class Preview;
    void approach_mode() noexcept;
    void place(float dt, float speed_limit) noexcept;

    Walker& walker_;
    const Ground& ground_;
    FootRig rig_;
    std::unique_ptr<Preview> preview_;
    FootPlacementState state_;
    FootOutput output_;
    RootFrame root_;
    std::vector<Transform> locals_, models_;
    float limit_ = k_no_speed_limit;
    FootMode mode_;  ///< that is wanted
    bool takes_hold_ = false;
};

}  // namespace surefoot
