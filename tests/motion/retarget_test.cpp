#include <surefoot/base/error.h>
#include <surefoot/base/random.h>
#include <surefoot/motion/retarget.h>
#include <surefoot/motion/root_motion.h>

#include "tests/motion/walker.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::Walker;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::vector<Transform> rest_models(const Skeleton& skeleton) {
    std::vector<Transform> models(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, models);
    return models;
}

/// A body that stands in `standing`, which is a pose of the skeleton.
RetargetBody body(std::shared_ptr<const Skeleton> skeleton, const RoleMap& roles, std::span<const Transform> standing) {
    return {skeleton, roles, make_legs(*skeleton, roles, standing, 0), {}};
}
RetargetBody body(const Walker& walker) { return body(walker.skeleton, walker.roles, rest_models(*walker.skeleton)); }

/// The same joints resting in another pose.
std::shared_ptr<const Skeleton> resting_in(const Skeleton& skeleton, std::span<const Transform> models) {
    Skeleton other = skeleton;
    model_to_local(skeleton, models, other.rest);
    return std::make_shared<const Skeleton>(std::move(other));
}

/// The same bones with other axes at every joint.
std::shared_ptr<const Skeleton> with_other_axes(const Skeleton& skeleton, std::uint64_t seed) {
    Random random(seed);
    std::vector<Transform> models = rest_models(skeleton);
    const auto number = [&] { return random.between(-1, 1); };
    for (Transform& joint : models)
        joint.rotation = normalized(joint.rotation * normalized(Quat{number(), number(), number(), number()}));
    return resting_in(skeleton, models);
}

std::shared_ptr<const Skeleton> scaled(const Skeleton& skeleton, float scale) {
    Skeleton other = skeleton;
    for (Transform& joint : other.rest) joint.translation *= scale;
    return std::make_shared<const Skeleton>(std::move(other));
}

TEST(retarget, a_clip_put_onto_its_own_skeleton_comes_back) {
    for (const bool dedicated_root : {false, true}) {
        const Walker walker(dedicated_root);
        Motion walk = walker.walk(1.3f, 20, 2);
        extract_root_motion(walk, walker.roles);
        RetargetReport report;
        const Motion again = retarget(walk, body(walker), body(walker), {}, &report);
        EXPECT_FLOAT_EQ(report.scale, 1);
        EXPECT_LT(report.sink, 1e-5f);
        EXPECT_LT(test::worst_world_distance(walk, again), 1e-4f);
        EXPECT_EQ(again.frame_count(), walk.frame_count());
        EXPECT_EQ(again.name, walk.name);
    }
}

TEST(retarget, joints_with_other_axes_move_to_the_same_places) {
    const Walker walker;
    const Motion walk = walker.walk(1.3f, 0, 1);
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto other = with_other_axes(*walker.skeleton, seed);
        const RetargetBody target = body(other, walker.roles, rest_models(*other));
        const Motion there = retarget(walk, body(walker), target);
        // Joints without a role that rest with other axes go with their parents: the walker's pockets, at the hips.
        EXPECT_LT(test::worst_world_distance(walk, there), 1e-4f);
        EXPECT_LT(test::worst_world_distance(walk, retarget(there, target, body(walker))), 1e-4f);
    }
}

TEST(retarget, rest_poses_with_lowered_arms_splayed_legs_and_turned_about_move_to_the_same_places) {
    const Walker walker;
    const Motion walk = walker.walk(1.3f, 0, 1);
    std::vector<Transform> a_pose = rest_models(*walker.skeleton);
    for (const Role left : {Role::left_upper_arm, Role::left_upper_leg}) {
        const float down = left == Role::left_upper_arm ? -0.8f : 0.3f;
        walker.turn_model(a_pose, walker.roles[left], {0, 0, 1}, down);
        walker.turn_model(a_pose, walker.roles[mirrored(left)], {0, 0, 1}, -down);
    }
    const Transform about{from_yaw(2.1f), {0.3f, 0, -0.2f}};
    for (Transform& joint : a_pose) joint = about * joint;
    const auto other = resting_in(*walker.skeleton, a_pose);
    // The soles are those of the standing body: the splayed feet do not lie flat.
    const RetargetBody target{other, walker.roles, body(walker).legs, {}};
    EXPECT_LT(test::worst_world_distance(walk, retarget(walk, body(walker), target)), 2e-4f);
    EXPECT_LT(test::worst_world_distance(walk, retarget(retarget(walk, body(walker), target), target, body(walker))),
              2e-4f);
}

TEST(retarget, a_larger_body_takes_larger_steps_at_the_same_cadence) {
    const Walker walker;
    Motion walk = walker.walk(1.3f, 30, 2);
    extract_root_motion(walk, walker.roles);
    const auto giant = scaled(*walker.skeleton, 1.5f);
    RetargetReport report;
    const Motion there = retarget(walk, body(walker), body(giant, walker.roles, rest_models(*giant)), {}, &report);
    EXPECT_NEAR(report.scale, 1.5f, 1e-5f);
    std::vector<Transform> small(at(walk.joint_count())), large = small;
    for (int f = 0; f < walk.frame_count(); ++f) {
        EXPECT_EQ(there.root[at(f)].position, walk.root[at(f)].position * report.scale);
        EXPECT_EQ(there.root[at(f)].yaw, walk.root[at(f)].yaw);
        world_pose(walk, f, small);
        world_pose(there, f, large);
        for (std::size_t j = 0; j < small.size(); ++j)
            EXPECT_LT(distance(large[j].translation, small[j].translation * 1.5f), 2e-4f) << walk.skeleton->names[j];
    }
}

/// The walker with `count` joints where it has one spine joint, evenly up to the chest.
std::pair<std::shared_ptr<const Skeleton>, RoleMap> with_spine_joints(const Walker& walker, int count) {
    const Skeleton& from = *walker.skeleton;
    const std::vector<Transform> models = rest_models(from);
    const int spine = walker.roles[Role::spine], chest = walker.roles[Role::chest];
    Skeleton s;
    std::vector<Transform> placed;
    std::vector<int> now(from.rest.size());
    const auto add = [&](const std::string& name, int parent, const Transform& model) {
        placed.push_back(model);
        return s.add(name, parent, parent < 0 ? model : inverse(placed[at(parent)]) * model);
    };
    for (int j = 0; j < from.joint_count(); ++j) {
        const int parent = from.parents[at(j)];
        int to = parent < 0 ? k_no_joint : now[at(parent)];
        if (j == spine)
            for (int k = 0; k < count; ++k) {
                const float share = static_cast<float>(k) / static_cast<float>(count);
                now[at(j)] = to = add("spine_" + std::to_string(k), to,
                                      {{}, lerp(models[at(spine)].translation, models[at(chest)].translation, share)});
            }
        else
            now[at(j)] = add(from.names[at(j)], to, models[at(j)]);
    }
    RoleMap roles;
    for (int r = 0; r < k_role_count; ++r)
        if (const Role role = static_cast<Role>(r); walker.roles.has(role) && role != Role::spine)
            roles.set(role, now[at(walker.roles[role])]);
    roles.set(Role::spine, s.find("spine_0"));
    return {std::make_shared<const Skeleton>(std::move(s)), roles};
}

TEST(retarget, spines_of_other_joint_counts_share_the_turn_and_arrive_at_the_same_chest) {
    const Walker walker;
    Motion twist = make_motion(walker.skeleton, "twist", 2, 30);
    std::vector<Transform> models = rest_models(*walker.skeleton);
    walker.turn_model(models, walker.roles[Role::spine], {0, 1, 0}, 0.3f);
    walker.turn_model(models, walker.roles[Role::chest], {0, 1, 0}, 0.3f);
    model_to_local(*walker.skeleton, models, twist.frame(1));
    const auto [skeleton, roles] = with_spine_joints(walker, 4);
    const Motion there = retarget(twist, body(walker), body(skeleton, roles, rest_models(*skeleton)));
    std::vector<Transform> turned(skeleton->rest.size()), rest = rest_models(*skeleton);
    local_to_model(*skeleton, there.frame(1), turned);
    const auto yaw = [&](const std::string& name) {
        const auto j = at(skeleton->find(name));
        return yaw_of(turned[j].rotation * conjugate(rest[j].rotation));
    };
    // From 0 at the hips through 0.3 halfway to 0.6 at the chest, in five equal steps.
    for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(yaw("spine_" + std::to_string(k)), 0.12f * static_cast<float>(k + 1), 1e-3f);
    EXPECT_NEAR(yaw("chest"), 0.6f, 1e-3f);
    EXPECT_NEAR(yaw("head"), 0.6f, 1e-3f);
}

TEST(retarget, feet_without_toe_joints_stay_on_the_ground) {
    const Walker walker;
    RoleMap toeless = walker.roles;
    toeless.set(Role::left_toes, k_no_joint);
    toeless.set(Role::right_toes, k_no_joint);
    Motion stand = make_motion(walker.skeleton, "stand", 3, 30);
    const RetargetBody target = body(walker.skeleton, toeless, rest_models(*walker.skeleton));
    const Motion there = retarget(stand, body(walker), target);
    std::vector<Transform> models(at(there.joint_count()));
    local_to_model(*there.skeleton, there.frame(1), models);
    for (const Leg& leg : target.legs.side) {
        const SolePoints sole = sole_points(leg, models[at(leg.foot)], models[at(leg.foot)]);
        for (const Vec3 point : {sole.heel, sole.ball, sole.toe_tip}) EXPECT_NEAR(point.y, 0, 2e-3f);
    }
}

TEST(retarget, hips_sink_where_legs_are_too_short_for_the_step_and_feet_stay_where_they_belong) {
    const Walker walker;
    Motion lunge = make_motion(walker.skeleton, "lunge", 60, 30);
    for (int f = 20; f < 40; ++f) {  // one foot far ahead, on straight legs
        std::vector<Transform> models = rest_models(*walker.skeleton);
        walker.turn_model(models, walker.roles[Role::left_upper_leg], {1, 0, 0}, -0.5f);
        walker.turn_model(models, walker.roles[Role::right_upper_leg], {1, 0, 0}, 0.5f);
        for (Transform& joint : models) joint.translation.y -= 0.098f;
        model_to_local(*walker.skeleton, models, lunge.frame(f));
    }
    // Feet half as long: rolled onto heel and toes, they carry the ankle less high.
    Skeleton short_feet = *walker.skeleton;
    for (const Role toes : {Role::left_toes, Role::right_toes})
        short_feet.rest[at(walker.roles[toes])].translation *= 0.5f;
    const auto other = std::make_shared<const Skeleton>(short_feet);
    std::vector<Transform> standing = rest_models(*other);
    const RetargetBody target = body(other, walker.roles, standing);
    RetargetReport report;
    const Motion there = retarget(lunge, body(walker), target, {}, &report);
    EXPECT_GT(report.sink, 0.004f);
    EXPECT_LT(report.sink, 0.06f * target.legs[Side::left].length() + 1e-4f);
    const auto lowest = [](const RetargetBody& of, const std::vector<Transform>& models, std::size_t side) {
        const Leg& leg = of.legs.side[side];
        const SolePoints sole = sole_points(leg, models[at(leg.foot)], models[at(leg.toes)]);
        return std::fmin(sole.heel.y, std::fmin(sole.ball.y, sole.toe_tip.y));
    };
    // The hips do not jump where they begin to sink, and feet are as high above the ground as the source's.
    std::vector<Transform> a(at(there.joint_count())), b = a, c = a, d = a;
    for (int f = 1; f < there.frame_count(); ++f) {
        world_pose(there, f - 1, a), world_pose(there, f, b), world_pose(lunge, f - 1, c), world_pose(lunge, f, d);
        const std::size_t hips = at(walker.roles[Role::hips]);
        EXPECT_LT(std::fabs(b[hips].translation.y - a[hips].translation.y),
                  std::fabs(d[hips].translation.y - c[hips].translation.y) + 0.02f);
        for (std::size_t side = 0; side < 2; ++side)
            EXPECT_NEAR(lowest(target, b, side), report.scale * lowest(body(walker), d, side), 0.006f) << f;
    }
}

TEST(retarget, names_the_roles_that_are_missing_and_on_which_side) {
    const Walker walker;
    const Motion walk = walker.walk(1, 0, 0.2f);
    RetargetBody lame = body(walker);
    lame.roles.set(Role::left_foot, k_no_joint);
    lame.roles.set(Role::hips, k_no_joint);
    try {
        retarget(walk, body(walker), lame);
        FAIL() << "no error";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("target"), std::string::npos) << text;
        EXPECT_NE(text.find("hips, left_foot"), std::string::npos) << text;
    }
    EXPECT_THROW(retarget(walk, lame, body(walker)), Error);
}

}  // namespace
}  // namespace surefoot
