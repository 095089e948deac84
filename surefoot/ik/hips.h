#pragma once
// The height of the hips over uneven ground: a spring on the heights of the footholds, and a look-ahead limiter that
// gives way to a leg before it would be too short.
//
// A spring that is clamped when a leg runs out of length jerks (FEET: 4 to 15 times the flat walk's jerk). Here the
// shortfall of the legs is known ahead; its minimum over a window is smoothed by a kernel that lies inside the window,
// so the result is smooth and never above what the legs can reach.

#include <array>
#include <cstdint>

namespace surefoot {

/// Height of a foothold and when the root passes over it.
struct FootholdPass {
    double time = 0;   ///< [s] on the state's clock
    float height = 0;  ///< [m]
};

/// The footholds before and after now, ascending in time: a polyline, constant before its first and after its last.
struct FootholdLine {
    static constexpr int k_capacity = 8;
    std::array<FootholdPass, k_capacity> passes{};
    int count = 0;

    float at(double time) const noexcept;
    /// Inserts in order of time; where full, the earliest is dropped. Two at nearly the same time become their mean.
    void add(FootholdPass pass) noexcept;
    /// Drops all after `time`, and all but the last two before it.
    void keep_past(double time) noexcept;
};

/// A critically damped spring, exact for a target that stands still during the step.
struct HeightSpring {
    float value = 0, rate = 0;  ///< [m], [m/s]
    void step(float target, float stiffness, float dt) noexcept;
    /// The same for who steps many and knows `decay`, exp(-stiffness * dt).
    void step(float target, float stiffness, float dt, float decay) noexcept;
};

/// What is left of a jump in height, on its way to 0: position, velocity and acceleration go on from it, for a step in
/// acceleration is seen as a jerk. Critically damped, of the third order; exact.
struct HeightRest {
    float value = 0, rate = 0, acceleration = 0;  ///< [m], [m/s], [m/s^2]
    void step(float stiffness, float dt) noexcept;
};

/// Shortfall of the legs (<= 0 m) on a fixed grid of time, past and to come, and the smooth height below it.
class HipLimiter {
  public:
    static constexpr int k_rate = 30;   ///< [1/s] slots a second
    static constexpr int k_half = 7;    ///< slots from the middle of the window to its end: +- 0.233 s
    static constexpr int k_slots = 60;  ///< ring: 14 past, 37 to come, and some
    static constexpr int k_past = 2 * k_half;

    /// As though the shortfall had always been this.
    void fill(double time, float shortfall) noexcept;
    /// Sets the shortfall at a slot; slots up to it that were never set take the last one that was.
    void set(std::int64_t slot, float shortfall) noexcept;
    /// Smooth and, at the slots, at most the shortfall there.
    float at(double time) const noexcept;

  private:
    float get(std::int64_t slot) const noexcept;
    std::array<float, k_slots> ring_{};
    std::int64_t last_ = 0;  ///< the latest slot that was set
};

}  // namespace surefoot
