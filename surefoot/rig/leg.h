#pragma once
// Legs: the chains and soles that foot placement and contact analysis work on.

#include <surefoot/rig/roles.h>

#include <array>

namespace surefoot {

enum class Side : std::uint8_t { left = 0, right = 1 };

/// One leg. The sole is an outline of four points given in the frame of the joint that carries them, so that a bending
/// toe takes its tip along. Without a toe joint, `toes` is k_no_joint and all four are in the foot's frame.
struct Leg {
    int upper = k_no_joint, lower = k_no_joint, foot = k_no_joint, toes = k_no_joint;
    float upper_length = 0, lower_length = 0;  ///< [m] from the rest pose
    Vec3 heel, mid, ball;                      ///< [m] on the sole, foot's frame
    Vec3 toe_tip;                              ///< [m] on the sole, toes' frame if there are toes, else foot's
    Vec3 up, forward;  ///< unit, foot's frame: directions that point up and along the foot when it stands flat

    float length() const noexcept { return upper_length + lower_length; }
};

struct Legs {
    std::array<Leg, 2> side;  ///< indexed by Side
    int hips = k_no_joint;

    const Leg& operator[](Side s) const noexcept { return side[static_cast<std::size_t>(s)]; }
    Leg& operator[](Side s) noexcept { return side[static_cast<std::size_t>(s)]; }
    /// Made from a character, not just declared.
    bool known() const noexcept { return side[0].foot != k_no_joint && side[1].foot != k_no_joint; }
};

/// What is wrong with known legs for that skeleton, as a sentence; empty: nothing.
std::string problem(const Legs& legs, const Skeleton& skeleton);

/// The sole's four points in the space of `foot` and `toes` (toes ignored without a toe joint).
struct SolePoints {
    Vec3 heel, mid, ball, toe_tip;
};
SolePoints sole_points(const Leg& leg, const Transform& foot, const Transform& toes) noexcept;

/// Legs of a character standing flat with its soles at height `floor` in `standing` (model space, +Y up). Needs
/// roles.has_legs(). The heel lies below and a quarter foot length behind the ankle; the ball below the toe joint, or
/// at 70 % of the foot without one; lengths come from the skeleton's rest offsets. Who stands on its toes (the ankle
/// twice as high as it is behind the ball) has a sole under the toes alone: its heel is the rim behind the ball.
Legs make_legs(const Skeleton& skeleton, const RoleMap& roles, std::span<const Transform> standing, float floor);

/// One leg, from a pose in which this foot stands flat (the two feet of a walking clip never do at the same time).
Leg make_leg(const Skeleton& skeleton, const RoleMap& roles, Side side, std::span<const Transform> standing,
             float floor);

}  // namespace surefoot
