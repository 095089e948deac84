#pragma once
// The legs over the coming second, un-placed, on flat ground: what planning reads. Inner header of the ik room.

#include <surefoot/ik/foot_placement.h>

namespace surefoot {

/// One leg at one moment, in the world, on flat ground (y = 0 under the root).
struct LegPoints {
    Vec3 hip, knee, ankle, heel, ball, toe_tip;
};

/// A leg with the world rotations that placing changes.
struct WorldLeg {
    LegPoints points;
    Vec3 toe_joint;  ///< where there is one
    Quat upper, lower, foot, toes;
    Quat upper_parent, lower_parent, foot_parent, toes_parent;
};
WorldLeg world_leg(const Leg& leg, const LegPose& pose, const RootFrame& root) noexcept;

/// Consecutive samples in which a foot stands: heel, ball or toe tip low and slow.
struct ContactRun {
    int first = 0, last = 0;
};

struct Forecast {
    static constexpr int k_rate = 60;     ///< [1/s] samples a second
    static constexpr int k_samples = 73;  ///< 1.2 s: the swing to come and most of the stance after it
    static constexpr int k_most_runs = 4;

    double start = 0;  ///< [s] clock of sample 0
    std::array<std::array<LegPoints, k_samples>, 2> legs;
    std::array<Vec3, k_samples> root;
    std::array<float, k_samples> yaw;  ///< [rad] of the root
    std::array<bool, 2> rests{};       ///< by Side: the clip's foot stands as far as can be seen, still about the root
    std::array<std::array<ContactRun, k_most_runs>, 2> runs;
    std::array<int, 2> run_count{};
    std::array<std::array<bool, k_samples>, 2> heel_down, ball_down, tip_down;

    double time(int sample) const noexcept { return start + static_cast<double>(sample) / k_rate; }
    /// Smooth between the samples, held outside them.
    LegPoints at(std::size_t side, double clock) const noexcept;
    /// Mean outline of a run, from the samples in which heel and ball are both down where there are enough.
    Footprint footprint(std::size_t side, const ContactRun& run, float leg_length) const noexcept;
    /// When the root passes `place`; `otherwise`, the middle of the stance there, where the root hardly moves.
    double passing(Vec3 place, double otherwise) const noexcept;
};

/// Asks the preview and finds the contacts.
void look_ahead(const FootRig& rig, double clock, const LegPreview& preview, Forecast& forecast) noexcept;

inline bool is_swinging(const FootState& foot, double clock) noexcept {
    return foot.has_next && clock >= foot.lift && clock < foot.strike;
}

/// From 0 to 1 with slope and curvature 0 at both ends, for x in [0, 1].
constexpr float smootherstep(float x) noexcept { return x * x * x * (10 + x * (-15 + 6 * x)); }

/// Where a foot goes: its ankle, and the rotations to put on top of the clip's.
struct PlacedFoot {
    Vec3 ankle;
    Quat tilt;
    float uneven = 0;  ///< as Plant::uneven
    Quat toes_tilt;    ///< the same as `tilt` but for a risen heel
};
PlacedFoot place_foot(const FootState& foot, double clock, const LegPoints& points, const Leg& leg) noexcept;
/// Its parts: the blend of two plants with the heel's rise, and what replanning left over.
PlacedFoot blend_plants(const FootState& foot, double clock, const LegPoints& points, const Leg& leg) noexcept;
/// What takes flat ground to the ground under a foot, or between the places it comes from and goes to.
Quat ground_tilt(const FootState& foot, double clock) noexcept;
Vec3 fade_offset(const FootState& foot, double clock) noexcept;
/// Early or late in a swing: two bumps without slope or curvature at their ends, and flat beyond.
struct SwingBumps {
    float early, late;
    Vec3 shift(Vec3 by_early, Vec3 by_late) const noexcept { return by_early * early + by_late * late; }
};
SwingBumps swing_bumps(float share) noexcept;

/// Plans how a foot that has a swing before it clears the ground: its hump, and its shifts along the way.
void plan_clearance(const FootRig& rig, FootState& foot, std::size_t side, const GroundProbe& probe,
                    const Forecast& forecast) noexcept;

/// Plans both feet and the hips for the coming second.
void plan_feet(const FootRig& rig, FootPlacementState& state, const GroundProbe& probe,
               const LegPreview& preview) noexcept;

inline constexpr double k_never = 1e30;  ///< [s] a foot that does not lift within sight

}  // namespace surefoot
