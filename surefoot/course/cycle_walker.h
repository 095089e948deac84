#pragma once
// Goes in one cycle after another, each at its own pace, and may change to another cycle on the way: what somebody who
// shapes a gait looks at.

#include <surefoot/course/walk.h>

namespace surefoot {

class CycleWalker final : public Walker {
  public:
    /// `cycle` has root motion and at least two frames. Throws Error.
    CycleWalker(Motion cycle, const Legs& legs);

    /// From now on this one: at the same share of the cycle, from the same place. Throws Error as above, and then
    /// nothing has changed. It may be of another skeleton; whoever places this walker then has to be made anew.
    void change(Motion cycle, const Legs& legs);

    /// Which share of the cycle is over, [0, 1).
    double share() const noexcept;

    const std::shared_ptr<const Skeleton>& skeleton() const override { return cycle_.skeleton; }
    const Legs& legs() const override { return legs_; }
    std::span<const Transform> standing() const override { return standing_; }
    /// It goes at its own speed, whatever is asked for.
    void start(float speed_mps) override;
    void advance(float dt) noexcept override { time_ += static_cast<double>(dt); }
    RootFrame requested() const noexcept override;
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override;

  private:
    void stand();

    Motion cycle_;
    Legs legs_;
    std::vector<Transform> standing_;
    mutable std::vector<Transform> scratch_;
    RootFrame origin_;  ///< where the cycle began, had it been played from the start
    double time_ = 0;   ///< [s] since then
};

}  // namespace surefoot
