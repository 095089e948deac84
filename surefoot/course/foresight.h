#pragma once
// What a walker will do if nothing else is asked for. Private to course/.

#include <surefoot/course/walk.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace surefoot {

/// What is foreseen goes on in steps of a frame. Each is kept as long as it may still come: until time has passed it,
/// or something else happens. Whatever order looks come in, no step is gone twice. `Going` is a character on its way;
/// it is copied, and copies as large as the last must not allocate.
template <class Going>
class Foresight {
  public:
    /// Who goes is here now; what was foreseen counts no more.
    void begin(const Going& now) {
        step(0) = now;
        count_ = 1;
        number_ += k_far;
    }
    /// The same for a `Going` that can be compared and has all that decides how it goes on: where it came as was
    /// foreseen, or nothing has happened, the rest still counts.
    void go_on(const Going& now) {
        if (step(0) == now) return;
        if (count_ == 1 || !(step(1) == now)) return begin(now);
        first_ = (first_ + 1) % trail_.size();
        --count_;
        ++number_;
    }
    /// What `begin` was given, `ahead` seconds on; `go(going, dt)` makes it go on. The last call of it is the one that
    /// arrives.
    template <class Go>
    const Going& at(float ahead, Go&& go) {
        const std::size_t steps = steps_until(ahead);
        while (count_ <= steps) {
            if (count_ == trail_.size()) grow();
            step(count_) = step(count_ - 1);
            go(step(count_), k_step);
            ++count_;
        }
        there_ = step(steps);
        go(there_, rest_after(steps, ahead));
        return there_;
    }
    /// Of a moment that is a whole number of steps ahead: a number that it keeps; 0 of others.
    std::uint64_t number(float ahead) const noexcept {
        const std::size_t steps = steps_until(ahead);
        return rest_after(steps, ahead) == 0 ? number_ + steps : 0;
    }

  private:
    static std::size_t steps_until(float ahead) noexcept {
        return static_cast<std::size_t>(std::max((ahead + k_rounding) / k_step, 0.0f));
    }
    static float rest_after(std::size_t steps, float ahead) noexcept {
        const float rest = ahead - static_cast<float>(steps) * k_step;
        return rest > k_rounding ? rest : 0;
    }
    Going& step(std::size_t steps) noexcept { return trail_[(first_ + steps) % trail_.size()]; }
    void grow() {
        std::rotate(trail_.begin(), trail_.begin() + static_cast<std::ptrdiff_t>(first_), trail_.end());
        first_ = 0;
        trail_.emplace_back();
    }

    static constexpr float k_step = 1 / k_walk_fps, k_rounding = 1e-5f;  // [s]
    static constexpr std::uint64_t k_far = 1u << 24u;                    // steps that nobody looks ahead
    std::vector<Going> trail_{1};  ///< a ring, of which `count_` from `first_` on count; so that nothing allocates
    std::size_t first_ = 0, count_ = 1;
    std::uint64_t number_ = 1;  ///< of the first
    Going there_;
};

}  // namespace surefoot
