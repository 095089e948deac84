#pragma once
// What plays in a frame before it has a time: clips with their shares, and the pace of the phase they share. What
// locomotion.h is made of, and what a graph (program/) mixes with other leaves. Private to the runtime.

#include <surefoot/graph/locomotion.h>

namespace surefoot {

/// A clip with its share in this frame.
struct Active {
    std::int32_t clip = 0;
    float weight = 0;  ///< of shares that add up to 1; negative where a space extrapolates
    Vec3 velocity;     ///< [m/s] at which the root shall go with it
    float turn = 0;    ///< [rad/s] the same
};

struct Mix {
    Active active[k_max_locomotion_leaves];  ///< the first `count`
    int count = 0;
    Vec3 velocity;         ///< [m/s] of the root
    float turn = 0;        ///< [rad/s]
    bool clamped = false;  ///< what was asked for lay outside a space

    std::span<const Active> all() const noexcept { return {active, static_cast<std::size_t>(count)}; }
};

/// Adds what a space answers at a point, all weighed by `share`; what no axis of it says about turning is `turn_deg`
/// [deg/s].
void add_space(Mix& mix, const LocomotionSpace& space, std::int32_t& hint, const SpacePoint& point, float turn_deg,
               float share) noexcept;

/// Adds what a graph's two spaces answer to a request, whose styles are left to add_style.
void add_locomotion(Mix& mix, const LocomotionGraph& graph, std::int32_t& facing_hint, std::int32_t& lateral_hint,
                    const LocomotionRequest& request) noexcept;

/// The style that a request asks for, or null.
const LocomotionStyle* style_of(const LocomotionGraph& graph, const LocomotionRequest& request) noexcept;

/// Lays a style of the whole body over a mix: its samples get `weight`, those there are keep the rest.
void mix_in_style(Mix& mix, const LocomotionStyle& style, float weight) noexcept;
/// A masked style's samples, for a root that moves like that.
Mix style_layer(const LocomotionStyle& style, Vec3 velocity, float turn) noexcept;

/// Finds the rate of a shared phase, cycles a second, from all that plays in it (DESIGN: |sum w v| / |sum w s|; see
/// graph/README.md). Weights need not add up to 1.
class SharedPace {
  public:
    /// `phase` and `cycle` are those of the shared phase now. Clips without steps have their say in how fast the feet
    /// go, not in how fast clips are played.
    void add(const Active& active, const PackedClip& clip, float phase, std::uint32_t cycle) noexcept;
    float rate() const noexcept;

  private:
    /// Velocity of the ground under the feet, or its travel a cycle: planar and by turning, in metres.
    struct Stride {
        float x = 0, z = 0, turn = 0;

        friend Stride operator*(Stride a, float s) noexcept { return {a.x * s, a.z * s, a.turn * s}; }
        Stride& operator+=(Stride b) noexcept { return *this = {x + b.x, z + b.z, turn + b.turn}; }
        float length() const noexcept;
    };
    static Stride stride_of(Vec3 velocity, float turn_rate) noexcept;
    friend float foot_speed(Vec3 velocity, float turn_rate) noexcept;

    Stride moved_, stride_;
    float stride_sizes_ = 0, weights_ = 0, taken_off_ = 0, mean_ = 0, slowest_ = 0, fastest_ = 0;
};

/// Goes on by `step` cycles; `cycle` counts the full ones, also backward.
void advance_phase(float& phase, std::uint32_t& cycle, float step) noexcept;

/// Time of a clip without steps on a clock [s]: cyclic ones go round, others there and back.
float clock_time(const PackedClip& clip, double clock) noexcept;

/// One leaf a clip, though several spaces may hold it (an idle). What is taken off comes last: signs of rotations are
/// told by what is there already. Returns how many; `leaves` has room for all that is active.
int make_leaves(std::span<const PackedClip> clips, std::span<const Active> active, double clock, float phase,
                std::uint32_t cycle, std::span<Leaf> leaves) noexcept;

/// Lays a local pose over another where `mask` (by joint; null: everywhere) says so, with `weight` of all of it.
void lay_over(std::span<Transform> base, std::span<const Transform> above, float weight, const float* mask) noexcept;

}  // namespace surefoot
