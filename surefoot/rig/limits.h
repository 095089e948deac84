#pragma once
// How far joints turn: limits by role in the body's own axes, the same for every rig whatever its joints' axes and rest
// pose.
//
//     const BodyLimits limits(skeleton, roles, t_stance(skeleton, roles, legs, shape));   // motion/stance.h
//     pose[j].rotation = limits.clamped(j, pose[j].rotation);                              // local in, local out
//
// Angles are counted from the zero pose of the "neutral zero method" (American Academy of Orthopaedic Surgeons, "Joint
// Motion: Method of Measuring and Recording", 1965): standing upright, legs straight, feet flat and pointing ahead,
// arms hanging with the palms to the thighs. That is the T-stance with both arms lowered by 90 degrees.
//
// The *turn* of a joint is how it has rotated against its parent from the zero pose, in the body's axes there: X to the
// left, Y up, Z forward. It is split into a swing and a twist about the bone (turn = swing * twist) and read as three
// angles, those of the two rotation vectors added. On the left side:
//
//     hip     x < 0 flexes (thigh forward)   y > 0 turns outward   z > 0 abducts (away from the middle)
//     knee    x > 0 flexes (heel backward)   foot  x > 0 points the toes down, z > 0 lifts the outer edge
//     toes    x < 0 bends up                 trunk, neck  x > 0 bends forward, y > 0 turns left, z > 0 leans right
//     girdle  y < 0 forward, z > 0 lifts     upper arm  x < 0 forward, z > 0 to the side, y > 0 turns outward
//     elbow   x < 0 flexes, y > 0 turns the palm forward (supinates)

#include <surefoot/rig/roles.h>

namespace surefoot {

/// Ranges of the three angles of a joint's turn.
struct JointLimit {
    Vec3 low{-4, -4, -4}, high{4, 4, 4};  ///< [rad] about X, Y, Z; low <= high; beyond pi: free
    Vec3 bone{0, 1, 0};                   ///< unit: the axis of the twist

    bool free() const noexcept;
    friend bool operator==(const JointLimit&, const JointLimit&) = default;
};

/// The three angles of a turn [rad], and back. The twist about `bone` is in (-pi, pi].
Vec3 turn_angles(Quat turn, Vec3 bone) noexcept;
Quat turn_from_angles(Vec3 angles, Vec3 bone) noexcept;
/// The turn whose angles are the nearest within the limit; `turn` itself, to the bit, where it is within.
Quat clamped(const JointLimit& limit, Quat turn) noexcept;

/// Limits by role. Those of `spine` and `neck` are of the whole trunk and the whole neck, head included: their joints,
/// however many there are, share them equally, and entries of chest, upper chest and head are not looked at.
struct RoleLimits {
    std::array<JointLimit, k_role_count> of;

    const JointLimit& operator[](Role role) const noexcept { return of[static_cast<std::size_t>(role)]; }
    JointLimit& operator[](Role role) noexcept { return of[static_cast<std::size_t>(role)]; }
    /// Sets the limit of a role of the left side or the middle, and that of its mirror image.
    void set_both(Role role, const JointLimit& limit) noexcept;
    friend bool operator==(const RoleLimits&, const RoleLimits&) = default;
};

/// An adult's: hips, knees, ankles, shoulders, elbows, wrists, spine and neck after the Academy; shoulder girdle after
/// I. Kapandji, "The Physiology of the Joints"; fingers and toes rounded. Hips, jaw and eyes are free.
const RoleLimits& human_limits() noexcept;

/// The limits of a rig's joints. Immutable once made.
class BodyLimits {
  public:
    BodyLimits() = default;
    /// `stance`: model rotations of all joints in the T-stance (motion/stance.h). Joints without a role are free, but
    /// those of trunk and neck.
    BodyLimits(const Skeleton& skeleton, const RoleMap& roles, std::span<const Quat> stance,
               const RoleLimits& limits = human_limits());

    const JointLimit& operator[](int joint) const noexcept { return limits_[static_cast<std::size_t>(joint)]; }
    /// A joint's turn for its local rotation, and back.
    Quat turn(int joint, Quat local) const noexcept;
    Quat local(int joint, Quat turn) const noexcept;
    /// The nearest local rotation within the limit; `local` itself, to the bit, where it is within.
    Quat clamped(int joint, Quat local) const noexcept;

  private:
    std::vector<JointLimit> limits_;
    std::vector<Quat> parent_zero_, zero_;  // model rotations in the zero pose
};

}  // namespace surefoot
