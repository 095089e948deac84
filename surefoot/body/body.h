#pragma once
// A body that a gait moves: channels (body/channels.h) in, joint rotations out.
//
//     const Body body = make_body(skeleton, roles, legs, stance);             // once a rig
//     apply(binding, body.scale, gait_outputs, channels);                     // each frame, eight lanes
//     solve(body, channels, pose);
//     write_pose(body, pose, lane, locals);                                   // local_to_model and skinning take these
//     root = root * root_step(channels, lane, dt);
//
// Works on any rig with roles for hips and both legs down to the feet; spine, neck, head, girdle, arms and toes are
// moved where there are any, spines and necks of any number of joints. Eight lanes are eight characters of one rig, or
// eight moments of one. What comes out is made of + - * / and square roots only: the same bits on every machine, and
// the scalar twin gives the same bits as the vector build. Nothing fails: channels may be
// any numbers that `apply` leaves.
//
// How. The pelvis stands where the two hip controls say, turned and tilted by what they differ in, and sinks, smoothly,
// where a foot could not be reached. The spine leans from its base to its top and hunches where that is too near, and
// its joints share lean, hunch, turn and tilt. The head keeps level by its own controls. Girdles lift with raised
// arms. Each foot lies on the ground (a plane through the root, tilted by ground.slope), rolls over heel or ball, and
// its toes stay on the ground as long as they can. Arms and legs are two-bone chains, solved exactly by the law of
// cosines; knees point between foot and pelvis, elbows back and down, both carried along with the limb so that nothing
// flips. Near full stretch a limb resists softly instead of popping, and none bends beyond its limits (rig/limits.h).

#include <surefoot/body/channels.h>
#include <surefoot/rig/limits.h>

#include <array>
#include <span>
#include <vector>

namespace surefoot {

inline constexpr int k_most_body_joints = 64;  ///< that a body moves; of a longer spine the rest rides along

/// A joint that the body moves.
struct BodyJoint {
    std::int16_t joint = k_no_joint;  ///< of the skeleton
    std::int16_t base = -1;           ///< index among Body::joints of the nearest one above; -1: none
    Quat to_parent;                   ///< inverse of the parent joint's model rotation in the stance
    Quat stance;                      ///< model rotation in the stance
    Vec3 place;                       ///< [m] model position in the stance
};

/// A bone of a limb: where it points in the stance and which way its front (or, of an arm, its bend) faces.
struct BodyBone {
    Vec3 along, front;  ///< unit, perpendicular
};
/// Two bones with a hinge between them.
struct BodyLimb {
    int upper = -1, lower = -1, end = -1;  ///< among Body::joints; -1: there is no such limb
    BodyBone upper_bone, lower_bone;
    float upper_length = 0, lower_length = 0;  ///< [m]
    float nearest = 0;                         ///< [m] bent as far as the joint goes
    float soft = 0, farthest = 0;              ///< [m] where stretching begins to be resisted, and its end
};
struct BodyFoot {
    int toes = -1;         ///< among Body::joints, or -1
    Vec3 across;           ///< unit: the axis over which the foot rolls, to its left, in the stance
    Vec3 heel, ball, tip;  ///< [m] sole points from the ankle, in the stance; without toes it rolls over the tip
    float height = 0;      ///< [m] ankle over the sole
    float toe_length = 0;  ///< [m] ball to tip
    float toes_up = 0, toes_down = 0;  ///< [rad] how far toes bend against the foot, both >= 0
};

/// Immutable once made; shared by all characters of a rig.
struct Body {
    std::vector<Transform> locals;  ///< of every joint in the stance: of those that are not moved, and all translations
    std::vector<BodyJoint> joints;  ///< the hips first, parents before children
    Transform above_hips;           ///< model transform of the hips' parent
    int first_spine = 0, spine = 0, first_neck = 0, neck = 0;  ///< ranges of `joints`
    int chest = 0;                                             ///< that carries neck and arms: among `joints`
    std::array<int, 2> girdle{-1, -1};
    std::array<BodyLimb, 2> arm, leg;
    std::array<BodyFoot, 2> foot;
    std::array<Quat, 2> hanging;  ///< turn of a forearm from the stance to an arm that hangs
    Vec3 spine_line;              ///< [m] base of the spine to its top, in the stance
    float hip_width = 0, shoulder_width = 0, girdle_length = 0;  ///< [m] between left and right; of one girdle
    float most_hunch = 0, most_nod = 0, girdle_lift = 0;         ///< [rad]
    BodyScale scale;

    int joint_count() const noexcept { return static_cast<int>(joints.size()); }
    /// Floats of a pose: 32 a joint moved and 24 for where the hips are.
    std::size_t pose_floats() const noexcept { return 32 * joints.size() + 24; }
};

/// `stance`: model transforms of a T-stance with flat feet (motion/stance.h): +Z ahead, soles on y = 0, the hip joints
/// above the origin. Needs roles.has_legs() and legs made of this skeleton. Allocates.
Body make_body(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs, std::span<const Transform> stance,
               const RoleLimits& limits = human_limits());

/// channels[channel * 8 + lane] to pose[joint * 32 + component * 8 + lane], local rotations of Body::joints (x, y, z,
/// w), then the hips' local translation, component by component. Costs some 20 ns a joint for eight characters.
void solve(const Body& body, std::span<const float> channels, std::span<float> pose) noexcept;
/// The scalar twin of `solve`: the same bits.
void solve_scalar(const Body& body, std::span<const float> channels, std::span<float> pose) noexcept;

/// One lane as local transforms of all joints.
void write_pose(const Body& body, std::span<const float> pose, int lane, std::span<Transform> locals) noexcept;

/// How the root moves: velocity in its own frame [m/s] and turn rate [rad/s].
struct RootRate {
    Vec3 velocity;
    float turn = 0;
};
RootRate root_rate(std::span<const float> channels, int lane) noexcept;

}  // namespace surefoot
