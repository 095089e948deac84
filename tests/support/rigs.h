#pragma once
// Bipeds of many kinds, made from the generated one: what works on one rig only works by chance.

#include <surefoot/base/random.h>
#include <surefoot/motion/stance.h>
#include <surefoot/synthetic/biped.h>

#include <string>
#include <vector>

namespace surefoot::test {

struct Rig {
    std::string name;
    std::shared_ptr<Skeleton> skeleton;
    RoleMap roles;
    Legs legs;
    std::vector<Transform> stance;
};

inline std::vector<Transform> models_of(const Skeleton& skeleton) {
    std::vector<Transform> models(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, models);
    return models;
}

inline Rig finished(std::string name, std::shared_ptr<Skeleton> skeleton, const RoleMap& roles) {
    Rig rig{std::move(name), std::move(skeleton), roles, {}, {}};
    const std::vector<Transform> rest = models_of(*rig.skeleton);
    for (const Side side : {Side::left, Side::right}) {
        // Soles where this foot's own ankle stands: legs may be unequal.
        const float ankle = leg_size(make_biped()).ankle_height;
        const int foot = roles[side == Side::left ? Role::left_foot : Role::right_foot];
        rig.legs[side] =
            make_leg(*rig.skeleton, roles, side, rest, rest[static_cast<std::size_t>(foot)].translation.y - ankle);
    }
    rig.legs.hips = roles[Role::hips];
    rig.stance = standing_pose(*rig.skeleton, roles, rig.legs, rest);
    return rig;
}

inline std::shared_ptr<Skeleton> copied(const surefoot::Rig& biped) {
    return std::make_shared<Skeleton>(*biped.skeleton);
}
inline Transform& rest_of(Skeleton& skeleton, const RoleMap& roles, Role role) {
    return skeleton.rest[static_cast<std::size_t>(roles[role])];
}

/// Without the joints of some roles (leaves only) and all that is below them.
inline void drop(Skeleton& skeleton, RoleMap& roles, Role role) {
    const int joint = roles[role];
    const auto at = static_cast<std::ptrdiff_t>(joint);
    skeleton.names.erase(skeleton.names.begin() + at);
    skeleton.parents.erase(skeleton.parents.begin() + at);
    skeleton.rest.erase(skeleton.rest.begin() + at);
    skeleton.tips.erase(skeleton.tips.begin() + at);
    for (std::int16_t& parent : skeleton.parents)
        if (parent > joint) --parent;
    for (std::int16_t& mapped : roles.joints) {
        if (mapped == joint) mapped = k_no_joint;
        if (mapped > joint) --mapped;
    }
}

/// The same shape with other axes in every joint, as importers bring them.
inline void twist_axes(Skeleton& skeleton, std::uint64_t seed) {
    Random random(seed);
    const std::vector<Transform> models = models_of(skeleton);
    std::vector<Transform> turned = models;
    for (std::size_t j = 0; j < turned.size(); ++j) {
        const Quat q = normalized(Quat{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), 0.7f});
        turned[j].rotation = models[j].rotation * q;
        skeleton.tips[j] = rotate(conjugate(q), skeleton.tips[j]);
    }
    model_to_local(skeleton, turned, skeleton.rest);
}

inline std::vector<Rig> many_rigs() {
    std::vector<Rig> rigs;
    const surefoot::Rig adult = make_biped();
    rigs.push_back(finished("adult", copied(adult), adult.roles));
    {
        auto skeleton = copied(adult);
        for (Transform& joint : skeleton->rest) joint.translation = joint.translation * 0.55f;
        for (Vec3& tip : skeleton->tips) tip = tip * 0.55f;
        Rig child{"child", skeleton, adult.roles, {}, {}};
        const std::vector<Transform> rest = models_of(*skeleton);
        child.legs = make_legs(*skeleton, adult.roles, rest, 0);
        child.stance = standing_pose(*skeleton, adult.roles, child.legs, rest);
        rigs.push_back(child);
    }
    {
        auto skeleton = copied(adult);
        RoleMap roles = adult.roles;
        drop(*skeleton, roles, Role::right_toes);
        drop(*skeleton, roles, Role::left_toes);
        rigs.push_back(finished("toeless", skeleton, roles));
    }
    {
        auto skeleton = copied(adult);
        rest_of(*skeleton, adult.roles, Role::left_lower_leg).translation.y *= 1.04f;
        rest_of(*skeleton, adult.roles, Role::left_foot).translation.y *= 1.04f;
        rigs.push_back(finished("a longer left leg", skeleton, adult.roles));
    }
    {
        auto skeleton = copied(adult);
        rest_of(*skeleton, adult.roles, Role::left_upper_arm).rotation = axis_angle({0, 0, 1}, -0.8f);
        rest_of(*skeleton, adult.roles, Role::right_upper_arm).rotation = axis_angle({0, 0, 1}, 0.8f);
        rigs.push_back(finished("A-pose", skeleton, adult.roles));
    }
    {
        auto skeleton = copied(adult);
        twist_axes(*skeleton, 5);
        rigs.push_back(finished("other axes", skeleton, adult.roles));
    }
    {
        auto skeleton = copied(adult);
        for (const Role role : {Role::left_lower_arm, Role::left_hand, Role::right_lower_arm, Role::right_hand})
            rest_of(*skeleton, adult.roles, role).translation.x *= 1.4f;
        rigs.push_back(finished("long arms", skeleton, adult.roles));
    }
    return rigs;
}

}  // namespace surefoot::test
