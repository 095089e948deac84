#pragma once
// What a walker will do if nothing else is asked for. Private to course/.

#include <surefoot/course/walk.h>

#include <algorithm>

namespace surefoot {

/// Looks mostly come in order, each a little farther than the last: they go on from there, a frame at a time. `Going`
/// is a character on its way; it is copied, and copies as large as the last must not allocate.
template <class Going>
class Foresight {
  public:
    /// Time has passed: what was foreseen counts no more.
    void begin(const Going& now) {
        foreseen_ = now;
        ahead_ = 0;
    }
    /// `now`, `ahead` seconds on; `go(going, dt)` makes it go on. The last call of it is the one that arrives.
    template <class Go>
    const Going& at(const Going& now, float ahead, Go&& go) {
        if (ahead < ahead_) begin(now);
        for (; ahead_ + k_step <= ahead + k_rounding; ahead_ += k_step) go(foreseen_, k_step);
        there_ = foreseen_;
        go(there_, std::max(ahead - ahead_, 0.0f));
        return there_;
    }

  private:
    static constexpr float k_step = 1 / k_walk_fps, k_rounding = 1e-5f;  // [s]
    Going foreseen_, there_;
    float ahead_ = 0;
};

}  // namespace surefoot
