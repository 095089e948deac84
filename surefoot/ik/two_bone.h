#pragma once
// Two-bone inverse kinematics of a leg: hip, knee, ankle.
//
// `solve_two_bone` is analytic and exact; it never returns a NaN: what cannot be reached is pulled in. The knee keeps
// the plane it has in the animation, carried along with the swing of hip -> ankle, so nothing flips where a pole vector
// would. A target equal to the animated ankle gives identity rotations.
//
// `colvin_step_*` are the steps (2) to (5) of Colvin & Kajala 2013, §IV.B, as printed, each by itself.

#include <surefoot/math/transform.h>
#include <surefoot/math/trig.h>

namespace surefoot {

struct TwoBone {
    Vec3 hip, knee, ankle;           ///< [m] as animated (hip already where it shall be)
    Vec3 target;                     ///< [m] where the ankle shall be
    Vec3 knee_forward{0, 0, 1};      ///< direction in which the knee bends, for a leg that is straight
    float soft_extension = 0.9975f;  ///< share of full length at which a leg starts to resist stretching; 1: hard
};

struct TwoBoneResult {
    Quat upper, lower;       ///< premultiply the animated world rotations of thigh and calf
    Vec3 knee, ankle;        ///< [m] where they are now
    bool pulled_in = false;  ///< the target was out of reach; `ankle` is the nearest sensible point
};

TwoBoneResult solve_two_bone(const TwoBone& leg) noexcept;

/// A distance limited softly: itself up to share * length, then approaching `length` without reaching it (smooth in
/// value and slope). Distances up to `free` are never shortened: the clip's own stretch is the clip's business.
float soft_limit(float distance, float length, float share, float free) noexcept;

inline constexpr float k_least_fold = 40 * k_radians_per_degree;  ///< inside a knee
inline constexpr float k_soft_fold = 55 * k_radians_per_degree;

/// The same at the other end: itself down to `soft`, then approaching `least` without reaching it. Distances down to
/// `free` are never lengthened.
float soft_floor(float distance, float least, float soft, float free) noexcept;

/// The target of a leg that resists folding: farther from the hip, so that the knee does not fold to k_least_fold where
/// the animated one does not. `share` [0, 1]: of that; 0: the target as it is.
Vec3 unfolded_target(const TwoBone& leg, float share) noexcept;

/// Rotation that carries the knee's plane along: least rotation from hip -> ankle to hip -> target.
Quat carry_swing(Vec3 hip, Vec3 ankle, Vec3 target) noexcept;

// --- Colvin & Kajala 2013, §IV.B

/// Step 2: by how much the root must sink (<= 0) so that a leg of `length` reaches from `hip` straight below or above
/// itself to `target`. Where even the horizontal distance is too long: as far as the leg's height above the target.
float colvin_step2_lower_root(Vec3 hip, Vec3 target, float length) noexcept;
/// Step 3: interior knee angle [rad] by the law of cosines; distances out of reach are clamped.
float colvin_step3_knee_angle(float upper, float lower, float distance) noexcept;
/// Step 3: the leg posed with that angle and the thigh at 90 degrees: along `forward`, calf hanging in the plane of
/// `forward` and down. Gives the positions of knee and ankle relative to the hip.
struct ColvinLeg {
    Vec3 knee, ankle;
};
ColvinLeg colvin_step3_preset(float upper, float lower, float knee_angle, Vec3 forward) noexcept;
/// Step 4: rotation that takes the posed hip -> foot onto hip -> target: axis by cross product, angle by dot product.
Quat colvin_step4_swing(Vec3 posed, Vec3 target) noexcept;
/// Step 5: twist about hip -> foot (unit `axis`) that brings `computed` nearest to `animated`, both perpendicular to
/// the thigh: theta = atan2(n . (c x a), c . a - (n . c)(n . a)).
float colvin_step5_twist(Vec3 axis, Vec3 computed, Vec3 animated) noexcept;

/// All of steps 3 to 5 for one leg; the result is used like that of solve_two_bone.
struct ColvinInput {
    Vec3 hip, knee, ankle;  ///< [m] as animated, after step 2
    Vec3 target;
    Vec3 forward{0, 0, 1};  ///< the character's facing
    Vec3 upper_forward;     ///< unit, perpendicular to the animated thigh, in the direction the knee bends
};
TwoBoneResult solve_colvin(const ColvinInput& leg) noexcept;

}  // namespace surefoot
