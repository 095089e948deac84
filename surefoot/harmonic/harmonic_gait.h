#pragma once
// Fitted gaits: what a captured cycle does, as a few sines and cosines of the phase.
//
//     values_at(gait, 1.4f, 20.0f, values);                      // once for each speed and turn
//     pose(gait, values, phase, locals);                         // each frame
//
// Every joint turns by a rotation vector against its mean rotation, mean * exp(v(phase)), and each component of v is a
// Fourier series a0 + sum ak cos 2 pi k phase + bk sin 2 pi k phase; so do the few translations that move (the hips).
// Series of few harmonics do not keep a foot still, so feet have series of their own: heel and ball as seen from the
// middle of the stance, where a foot that stands is one constant (clip/foot_prints.h), and the legs are solved for
// them. A family's coefficients depend smoothly on speed and turn: low polynomials, one for walking and one for
// running, mixed between; a gait of one clip has the constant 1 in their place. fit/fit_gait.h fits both.
//
// Space: local poses as seen from a root that moves steadily (velocity and turn rate of `rhythm`). Phase: cycles, 0 at
// the left foot's strike, 0.5 at the right one's; between the strikes it runs at a steady pace each. Nothing here
// allocates, fails or calls libm.

#include <surefoot/graph/foot_blend.h>
#include <surefoot/rig/leg.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

inline constexpr int k_most_harmonics = 24;
inline constexpr int k_most_basis_terms = 20;

/// How a person goes: at one speed one may do either, and their mean is neither.
enum class GaitMode : std::uint8_t { walk, run };

/// Functions of speed and turn that coefficients are sums of: for each mode the products of powers of speed and turn up
/// to `degree` in all. Between two speeds walking goes over into running.
struct GaitBasis {
    int modes = 1;          ///< 1: a single clip, or a family that only walks; 2: that walks and runs
    int degree = 0;         ///< [Limit: 0 to 3]; 0 with one mode does not depend on speed and turn at all
    float travel_deg = 0;   ///< which way a family goes, seen from where it faces: 0 ahead, 90 to its left, 180 back
    float climb = 0;        ///< metres up for a metre along: stairs
    float least_speed = 0;  ///< [m/s] along its travel: the range in which a family may be asked to go
    float most_speed = 1;   ///< [m/s] [Limit: >= least_speed]
    float most_turn = 120;  ///< [deg/s] to either side [Limit: > 0]
    /// Where the strides of each mode end: beyond them the body does as at the end, and only the ground passes faster
    /// or slower under it (the feet hold it at any speed). Slowest and fastest [m/s], and widest turn [deg/s].
    std::array<std::array<float, 2>, 2> fitted_speeds{{{0, 1}, {0, 1}}};
    std::array<float, 2> fitted_turn{120, 120};
    float walk_until = 1.6f;                        ///< [m/s] below it all is walking
    float run_from = 2.6f;                          ///< [m/s] above it all is running [Limit: > walk_until]
    std::array<float, 2> middle_speed{1.2f, 2.6f};  ///< [m/s] by mode: speeds count from here in units of
    std::array<float, 2> speed_unit{0.5f, 1.0f};    ///< [m/s] this [Limit: > 0]

    int terms_of_mode() const noexcept { return (degree + 1) * (degree + 2) / 2; }
    int terms() const noexcept { return modes * terms_of_mode(); }
};

/// How a gait keeps time and what its root does.
struct GaitRhythm {
    Vec3 velocity;                          ///< [m/s] of the root in its own frame
    float turn_rate = 0;                    ///< [rad/s] positive to the left
    float frequency = 1;                    ///< [cycles/s]
    float right_strike = 0.5;               ///< share of the cycle's time at which the right foot strikes
    std::array<float, 2> lift{0.6f, 0.6f};  ///< by Side: share of the foot's own phase at which it leaves the ground
};
inline constexpr int k_rhythm_values = 8;  ///< velocity x y z, turn rate, frequency, right strike, lift left and right

struct HarmonicGait {
    std::string name;
    std::shared_ptr<const Skeleton> skeleton;
    Legs soles;              ///< for tools that measure it
    LegPaths legs;           ///< without paths (count 0) feet are as the joints' series leave them
    int harmonics = 5;       ///< of joints and translations [Limit: 1 to k_most_harmonics]
    int foot_harmonics = 8;  ///< of the feet [Limit: 1 to k_most_harmonics]
    float foot_lift = 0.6f;  ///< (0, 1) share of a foot's series that is its stance
    float foot_hold = 0;     ///< share of a stance for which the series hold the foot still [Limit: 0.5 to 1]; 0: none
    std::vector<Quat> mean;  ///< [joint]
    std::vector<std::int16_t> moving;          ///< joints whose translation has a series, ascending; others rest
    std::array<Quat, 2> foot_mean, toes_mean;  ///< by Side: of the foot in the root's frame, of the toes in the foot's
    GaitBasis basis;
    /// [term][value]. The values: 3 series a joint, 3 a moving joint, by Side 12 of a foot (rotation, heel, ball,
    /// toes), each of 1 + 2 * harmonics numbers (a0, a1, b1, a2, b2, …), then k_rhythm_values.
    std::vector<float> coefficients;
    /// (speed [m/s], turn [deg/s]) of the cycles behind it: where they end, the gait is extrapolated.
    std::vector<std::array<float, 2>> cycles;
    bool family() const noexcept { return basis.terms() > 1; }
};

inline constexpr int k_foot_series = 12;

/// Numbers of one gait of the family: the length of `values` below.
int value_count(const HarmonicGait& gait) noexcept;

/// What is wrong with a gait, as a sentence; empty: nothing, and then the functions below cannot fail.
std::string problem(const HarmonicGait& gait);

/// The products of powers in the order 1, v, w, v v, v w, w w, …: basis.terms_of_mode() numbers.
void powers_at(const GaitBasis& basis, GaitMode mode, float speed, float turn_deg, std::span<float> powers) noexcept;

/// What each term of the basis weighs: basis.terms() numbers, 0 for those of a mode that has no share.
void term_weights(const GaitBasis& basis, float speed, float turn_deg, std::span<float> weights) noexcept;

/// Share of running at a speed, 0 to 1, with slope 0 at both ends.
float share_of_running(const GaitBasis& basis, float speed) noexcept;

/// The numbers of the gait at a speed along its travel [m/s] and a turn [deg/s, positive to the left]. A family's root
/// then moves exactly so, and its rhythm stays within sane limits however far it is extrapolated; a gait of one clip
/// has its own speed. Cost: basis.terms() multiply-adds a value.
void values_at(const HarmonicGait& gait, float speed, float turn_deg, std::span<float> values) noexcept;

GaitRhythm rhythm_of(const HarmonicGait& gait, std::span<const float> values) noexcept;
/// The rhythm alone at a speed and turn, the same bits: what keeps time without a pose.
GaitRhythm rhythm_at(const HarmonicGait& gait, float speed, float turn_deg) noexcept;

/// Share of a cycle's time [0, 1) at a phase, which may be any number (whole cycles are added), and back.
float time_share(const GaitRhythm& rhythm, float phase) noexcept;
float phase_of(const GaitRhythm& rhythm, float share) noexcept;

/// Time [s] since a foot's strike at a share of its own cycle.
float since_strike(const GaitRhythm& rhythm, std::size_t side, float share) noexcept;

/// Where a foot's series is when its own phase (0 at its strike) is `share`: stance over stance, swing over swing.
float foot_series_phase(float share, float lift, float series_lift) noexcept;

/// A foot as its series have it, seen from where the root is in the middle of the stance.
struct FootPrint {
    Quat rotation;
    Vec3 heel, ball;  ///< [m]
    Quat toes;        ///< local rotation of the toe joint
};
/// At a phase of the foot's series (`foot_series_phase`), 0 to 1.
FootPrint foot_print(const HarmonicGait& gait, std::span<const float> values, std::size_t side,
                     float series_phase) noexcept;

/// The same without the values: for those who want one foot at one moment.
FootPrint foot_print_at(const HarmonicGait& gait, float speed, float turn_deg, std::size_t side,
                        float series_phase) noexcept;

/// Stance and duration of a foot's step [s].
FootStep step_of(const GaitRhythm& rhythm, std::size_t side) noexcept;

/// The joints' series alone: joint j at `phases[limb[j]]`; an empty `limb`: all at phases[0]. At most k_most_phases.
inline constexpr int k_most_phases = 8;
void joint_pose(const HarmonicGait& gait, std::span<const float> values, std::span<const std::uint8_t> limb,
                std::span<const float> phases, std::span<Transform> locals) noexcept;

/// Puts the feet of a pose where they shall be: toes bend up from the floor, the hips sink as far as both legs need so
/// that none snaps straight, and the legs are solved.
void settle_on_feet(const Skeleton& skeleton, const Legs& soles, const LegPaths& legs, std::array<FootGoal, 2>& goals,
                    std::span<Transform> locals) noexcept;

/// The same for feet whose toes keep to the floor already. Up to the share `free` of its length a leg reaches as it
/// will (0.97 is a knee bent by 28 degrees, 0.99 by 16); beyond that the hips sink more and more.
void stand_on_feet(const Skeleton& skeleton, const Legs& soles, const LegPaths& legs,
                   const std::array<FootGoal, 2>& goals, float free, std::span<Transform> locals) noexcept;

struct HarmonicPoseOptions {
    bool feet = true;  ///< legs solved for the feet; off: the joints' series alone
};

/// The local pose at a phase: joint_count() transforms.
void pose(const HarmonicGait& gait, std::span<const float> values, float phase, std::span<Transform> locals,
          const HarmonicPoseOptions& options = {}) noexcept;

}  // namespace surefoot
