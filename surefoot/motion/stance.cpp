#include <surefoot/motion/root_motion.h>
#include <surefoot/motion/stance.h>

#include <algorithm>
#include <array>

namespace surefoot {
namespace {

// [rad] A rest pose that leans less than this is how its maker sees a body upright; one that leans more was taken from
// the middle of a movement.
constexpr float k_upright = 12 * k_radians_per_degree;

// [rad] Likewise a collar bone that points farther from sideways: someone has an arm up.
constexpr float k_level = 45 * k_radians_per_degree;

// Shoulder joints of a standing body lie a little behind its hip joints: 3 to 8 degrees in rigs that rest in a T.
constexpr Vec3 k_standing_trunk{0, 0.9962f, -0.0872f};

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A bone: from the joint of one role to that of another, and where it points in a T-stance.
struct Bone {
    Role from, to;
    Vec3 direction;
};
constexpr Vec3 k_down{0, -1, 0}, k_left{1, 0, 0};
constexpr std::array<Bone, 10> k_bones = {{
    {Role::left_upper_leg, Role::left_lower_leg, k_down},
    {Role::left_lower_leg, Role::left_foot, k_down},
    {Role::right_upper_leg, Role::right_lower_leg, k_down},
    {Role::right_lower_leg, Role::right_foot, k_down},
    {Role::left_upper_arm, Role::left_lower_arm, k_left},
    {Role::left_lower_arm, Role::left_hand, k_left},
    {Role::left_hand, Role::left_middle_proximal, k_left},
    {Role::right_upper_arm, Role::right_lower_arm, -k_left},
    {Role::right_lower_arm, Role::right_hand, -k_left},
    {Role::right_hand, Role::right_middle_proximal, -k_left},
}};

constexpr std::array<Bone, 2> k_collars = {{
    {Role::left_shoulder, Role::left_upper_arm, k_left},
    {Role::right_shoulder, Role::right_upper_arm, -k_left},
}};

/// Rotation in which a foot stands flat and points straight ahead.
Quat flat_foot(const Leg& leg) {
    const Quat upright = rotation_between(leg.up, k_up);
    return normalized(from_yaw(-yaw_of(upright * rotation_between({0, 0, 1}, leg.forward))) * upright);
}

struct Stance {
    const Skeleton& skeleton;
    const RoleMap& roles;
    const Legs& legs;
    std::vector<Transform> shape;  // facing +Z
    std::vector<Quat> turn;        // of each joint against the shape, in model space

    Vec3 place(Role role) const { return shape[at(roles[role])].translation; }

    Quat upright() const {
        const Vec3 hips = (place(Role::left_upper_leg) + place(Role::right_upper_leg)) / 2;
        Vec3 top = hips + k_up;
        if (roles.has(Role::left_upper_arm) && roles.has(Role::right_upper_arm))
            top = (place(Role::left_upper_arm) + place(Role::right_upper_arm)) / 2;
        else if (roles.has(Role::head))
            top = place(Role::head);
        if (rotation_angle(rotation_between(top - hips, k_up)) <= k_upright) return {};
        return rotation_between(top - hips, k_standing_trunk);
    }

    /// The least rotation of a bone that `before` has turned already.
    Quat straighten(Quat before, const Bone& bone) const {
        const Vec3 now = rotate(before, place(bone.to) - place(bone.from));
        return length(now) > 1e-5f ? normalized(rotation_between(now, bone.direction) * before) : before;
    }

    /// Collar bones are as they rest, unless they rest as no collar bone does.
    Quat level(Quat before, const Bone& bone) const {
        const Vec3 now = rotate(before, place(bone.to) - place(bone.from));
        const bool off = length(now) > 1e-5f && rotation_angle(rotation_between(now, bone.direction)) > k_level;
        return off ? straighten(before, bone) : before;
    }

    /// Toes lie on the ground with the foot: their tip at the sole's height.
    Quat flat_toes(const Leg& leg, Quat before) const {
        const Quat foot = flat_foot(leg);
        const Transform joint = inverse(shape[at(leg.foot)]) * shape[at(leg.toes)];
        const float ground = rotate(foot, leg.ball).y - rotate(foot, joint.translation).y;
        const Vec3 tip = rotate(before * shape[at(leg.toes)].rotation, leg.toe_tip);
        const float size = length(tip);
        const Vec3 ahead = normalized(Vec3{tip.x, 0, tip.z});
        if (!(size > 1e-5f) || std::fabs(ground) >= size || tip.z <= 0) return before;
        const Vec3 flat = ahead * std::sqrt(size * size - ground * ground) + k_up * ground;
        return normalized(rotation_between(tip, flat) * before);
    }

    Quat turn_of(int joint, Quat before) const {
        if (joint == roles[Role::hips]) return upright();
        for (const Leg& leg : legs.side) {
            if (joint == leg.foot) return normalized(flat_foot(leg) * conjugate(shape[at(joint)].rotation));
            if (joint == leg.toes) return flat_toes(leg, before);
        }
        for (const Bone& bone : k_bones)
            if (joint == roles[bone.from] && roles.has(bone.to)) return straighten(before, bone);
        for (const Bone& collar : k_collars)
            if (joint == roles[collar.from] && roles.has(collar.to)) return level(before, collar);
        return before;
    }
};

}  // namespace

std::vector<Quat> t_stance(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs,
                           std::span<const Transform> shape) {
    Stance stance{skeleton, roles, legs, {shape.begin(), shape.end()}, {}};
    const Transform ahead{from_yaw(-torso_yaw(roles, shape)), {}};
    for (Transform& joint : stance.shape) joint = ahead * joint;
    std::vector<Quat> rotations;
    for (int j = 0; j < skeleton.joint_count(); ++j) {
        const int parent = skeleton.parents[at(j)];
        stance.turn.push_back(stance.turn_of(j, parent == k_no_joint ? Quat{} : stance.turn[at(parent)]));
        rotations.push_back(normalized(stance.turn.back() * stance.shape[at(j)].rotation));
    }
    return rotations;
}

std::vector<Transform> standing_pose(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs,
                                     std::span<const Transform> shape) {
    const std::vector<Quat> turned = t_stance(skeleton, roles, legs, shape);
    std::vector<Transform> pose(skeleton.rest.size());
    for (int j = 0; j < skeleton.joint_count(); ++j) {
        const int parent = skeleton.parents[at(j)];
        const Vec3 offset = skeleton.rest[at(j)].translation;
        pose[at(j)].rotation = turned[at(j)];
        pose[at(j)].translation =
            parent == k_no_joint ? offset : pose[at(parent)].translation + rotate(turned[at(parent)], offset);
    }
    float floor = 1e30f;
    for (const Leg& leg : legs.side) floor = std::min(floor, transform_point(pose[at(leg.foot)], leg.heel).y);
    const Vec3 hips = lerp(pose[at(legs.side[0].upper)].translation, pose[at(legs.side[1].upper)].translation, 0.5f);
    for (Transform& joint : pose) joint.translation -= Vec3{hips.x, floor, hips.z};
    return pose;
}

}  // namespace surefoot
