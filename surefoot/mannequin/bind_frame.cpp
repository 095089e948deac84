#include <surefoot/mannequin/mannequin.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot {

namespace {

struct Limb {
    Role upper, lower, end;
    float most_twist;  // degrees about the upper bone that a living joint may show
};
// An arm turned from a T-pose to hanging twists by up to a quarter turn; hips and knees hardly do.
constexpr std::array<Limb, 8> k_limbs = {{{Role::left_upper_leg, Role::left_lower_leg, Role::left_foot, 75},
                                          {Role::right_upper_leg, Role::right_lower_leg, Role::right_foot, 75},
                                          {Role::left_lower_leg, Role::left_foot, Role::count, 60},
                                          {Role::right_lower_leg, Role::right_foot, Role::count, 60},
                                          {Role::left_upper_arm, Role::left_lower_arm, Role::left_hand, 120},
                                          {Role::right_upper_arm, Role::right_lower_arm, Role::right_hand, 120},
                                          {Role::left_lower_arm, Role::left_hand, Role::count, 110},
                                          {Role::right_lower_arm, Role::right_hand, Role::count, 110}}};

// A rest pose that bends knees and elbows by more than this in sum (as `bend` counts) is a moment of a movement: 0.25
// is a relaxed stance, 0.6 four joints bent by 30 degrees.
constexpr float k_bent_rest = 0.6f;

/// How far `q` turns about `axis`, degrees: the twist of its swing-twist decomposition.
float twist(Quat q, Vec3 axis) {
    const float along = q.x * axis.x + q.y * axis.y + q.z * axis.z;
    return std::fabs(wrap_angle(2 * atan2(along, q.w))) * k_degrees_per_radian;
}

Vec3 place(std::span<const Transform> models, const RoleMap& roles, Role role) {
    return models[static_cast<std::size_t>(roles[role])].translation;
}

/// Sum of the bends of knees and elbows, each as 1 - cos.
float bend(std::span<const Transform> models, const RoleMap& roles) {
    float sum = 0;
    for (const Limb& limb : k_limbs) {
        if (limb.end == Role::count || !roles.has(limb.upper) || !roles.has(limb.lower) || !roles.has(limb.end))
            continue;
        const Vec3 a = place(models, roles, limb.upper), b = place(models, roles, limb.lower);
        sum += 1 - dot(normalized(b - a), normalized(place(models, roles, limb.end) - b));
    }
    return sum;
}

}  // namespace

int mannequin_bind_frame(const Motion& motion, const RoleMap& roles) {
    const Skeleton& skeleton = *motion.skeleton;
    std::vector<Transform> models(skeleton.rest.size());
    int straightest = 0;
    float least = 1e9f;
    // A long take need not be searched frame by frame.
    constexpr int k_looks = 200;
    const int step = std::max(1, motion.frame_count() / k_looks);
    for (int f = 0; f < motion.frame_count(); f += step) {
        local_to_model(skeleton, motion.frame(f), models);
        const float bent = bend(models, roles);
        if (bent < least) least = bent, straightest = f;
    }
    local_to_model(skeleton, skeleton.rest, models);
    if (bend(models, roles) > k_bent_rest && least < 0.5f * bend(models, roles)) return straightest;
    const auto pose = motion.frame(straightest);
    for (const Limb& limb : k_limbs) {
        if (!roles.has(limb.upper) || !roles.has(limb.lower)) continue;
        const auto upper = static_cast<std::size_t>(roles[limb.upper]);
        // The bone's direction in its own frame; joints between upper and lower do not change it much.
        Vec3 bone = skeleton.rest[static_cast<std::size_t>(roles[limb.lower])].translation;
        if (skeleton.parents[static_cast<std::size_t>(roles[limb.lower])] != roles[limb.upper]) continue;
        bone = normalized(bone, {0, 1, 0});
        if (twist(conjugate(skeleton.rest[upper].rotation) * pose[upper].rotation, bone) > limb.most_twist)
            return straightest;
    }
    return -1;
}

}  // namespace surefoot
