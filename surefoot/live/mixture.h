#pragma once
// What of which manner a character is doing just now, and when its feet are. Private to live/.

#include <surefoot/live/live.h>

#include <algorithm>

namespace surefoot {

inline constexpr float k_least_share = 1e-4f;  ///< a manner of less adds nothing that can be seen

struct Mixture {
    std::array<float, k_most_manners> share{};  ///< of manners; 0 or at least k_least_share, adding up to 1
    float speed = 0, turn = 0;                  ///< [m/s], [deg/s] of the root
    float posture_speed = 0, posture_turn = 0;  ///< of the series
    float standing = 0;
    Vec3 direction;         ///< in which it goes: unit, of one manner
    GaitRhythm rhythm;      ///< velocity and turn rate as it really goes
    FootfallPattern order;  ///< duty is in the rhythm already
};

/// `ahead` seconds from now, if nothing else is asked for.
Mixture mixture_of(const LiveRig& rig, const LiveState& state, float ahead = 0) noexcept;

/// Share of the foot's own cycle, by the gait's phase: 0 at its strike, rhythm.lift at its toe-off.
float own_share(const Mixture& mixture, const Oscillators& limbs, std::size_t side) noexcept;
/// The gait's phase as a limb has it.
float series_phase(const Mixture& mixture, const Oscillators& limbs, Limb limb) noexcept;

/// The place and heading of a foot's print.
RootFrame place_of(Vec3 heel, Vec3 ball) noexcept;
/// Where the foot stands, seen from the root in the middle of its stance.
RootFrame stance_place(const LiveRig& rig, const Mixture& mixture, std::size_t side) noexcept;

/// Stance over stance, swing over swing: where the foot's series are.
float foot_phase(const LiveFoot& foot, const HarmonicGait& gait, float share, float lift) noexcept;
/// Share of its cycle at which a standing foot leaves: that of its strike, or sooner where the gait has become quicker.
/// A foot that has struck in a run cannot wait for as long as a walk would have it: the body has gone on by then.
inline float lift_of(const LiveFoot& foot, float lift) noexcept { return std::min(foot.lift, lift); }
/// [0, 1] of the swing.
float swing_share(const LiveFoot& foot, float share) noexcept;

}  // namespace surefoot
