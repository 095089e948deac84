#pragma once
// A number on its way to another: a cubic that leaves with the slope it has and arrives at rest. What is aimed anew on
// the way goes on without a jump in value or slope, and what has arrived is exactly what was asked for.

#include <algorithm>

namespace surefoot {

struct Glide {
    float from = 0, slope = 0;  ///< value and slope [1/s] where it began
    float target = 0;
    float elapsed = 0, duration = 0;  ///< [s]

    bool arrived() const noexcept { return elapsed >= duration; }
    /// `ahead` seconds from now.
    float value(float ahead = 0) const noexcept {
        const float t = elapsed + ahead;
        if (t >= duration) return target;
        const float x = t / duration, y = 1 - x;
        return from * (y * y * (1 + 2 * x)) + target * (x * x * (3 - 2 * x)) + slope * duration * (x * y * y);
    }
    float rate(float ahead = 0) const noexcept {
        const float t = elapsed + ahead;
        if (t >= duration) return 0;
        const float x = t / duration, y = 1 - x;
        return 6 * x * y * (target - from) / duration + slope * (y * y - 2 * x * y);
    }
    /// [s] until it has arrived.
    float left() const noexcept { return std::max(0.0f, duration - elapsed); }
};

inline Glide at_rest(float value) noexcept { return {value, 0, value, 0, 0}; }

/// Goes for `target` in `seconds` (0: at once); on the way there already, nothing changes.
inline void aim(Glide& glide, float target, float seconds) noexcept {
    if (target == glide.target) return;
    glide = {glide.value(), glide.rate(), target, 0, std::max(seconds, 0.0f)};
}

inline void advance(Glide& glide, float dt) noexcept { glide.elapsed = std::min(glide.elapsed + dt, glide.duration); }

}  // namespace surefoot
