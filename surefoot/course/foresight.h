#pragma once
// What a walker will do if nothing else is asked for. Private to course/.

#include <surefoot/course/walk.h>

#include <algorithm>
#include <vector>

namespace surefoot {

/// What is foreseen goes on in steps of a frame, and each is kept until time has passed: whatever order looks come in,
/// no step is gone twice. `Going` is a character on its way; it is copied, and copies as large as the last must not
/// allocate.
template <class Going>
class Foresight {
  public:
    /// Time has passed, or something else is asked for: what was foreseen counts no more.
    void begin(const Going& now) {
        if (trail_.empty()) trail_.emplace_back();
        trail_[0] = {now, 0};
        count_ = 1;
    }
    /// What `begin` was given, `ahead` seconds on; `go(going, dt)` makes it go on. The last call of it is the one that
    /// arrives.
    template <class Go>
    const Going& at(float ahead, Go&& go) {
        while (trail_[count_ - 1].ahead + k_step <= ahead + k_rounding) step(go);
        std::size_t from = count_ - 1;
        while (from > 0 && trail_[from].ahead > ahead + k_rounding) --from;
        there_ = trail_[from].going;
        go(there_, std::max(ahead - trail_[from].ahead, 0.0f));
        return there_;
    }

  private:
    struct Moment {
        Going going;
        float ahead = 0;  ///< [s]
    };
    template <class Go>
    void step(Go&& go) {
        if (count_ == trail_.size()) trail_.emplace_back();
        trail_[count_] = trail_[count_ - 1];
        go(trail_[count_].going, k_step);
        trail_[count_++].ahead += k_step;
    }

    static constexpr float k_step = 1 / k_walk_fps, k_rounding = 1e-5f;  // [s]
    std::vector<Moment> trail_{1};  ///< of which `count_` count; kept longer, so that nothing allocates
    std::size_t count_ = 1;
    Going there_;
};

}  // namespace surefoot
