// The templates that the program carries.

#include <surefoot/base/error.h>
#include <surefoot/rig_text/rig_template.h>

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

std::vector<std::string> bundled() {
    std::vector<std::string> names;
    const std::string_view all = bundled_rig_names();
    for (std::size_t at = 0; at < all.size(); at = all.find('\n', at) + 1)
        names.emplace_back(all.substr(at, all.find('\n', at) - at));
    return names;
}

std::vector<Transform> models(const Rig& rig) {
    std::vector<Transform> models(rig.skeleton->rest.size());
    local_to_model(*rig.skeleton, rig.skeleton->rest, models);
    return models;
}

Vec3 place(const Rig& rig, Role role) { return models(rig)[static_cast<std::size_t>(rig.roles[role])].translation; }

std::vector<std::string> set(std::initializer_list<const char*> values) { return {values.begin(), values.end()}; }

TEST(BundledRigs, are_there) {
    const std::vector<std::string> names = bundled();
    for (const char* wanted : {"adult", "child", "giant", "long_arms", "toe_walker"})
        EXPECT_NE(std::find(names.begin(), names.end(), wanted), names.end()) << wanted;
}

TEST(BundledRigs, stand_on_the_floor_with_all_locomotion_roles_and_warn_of_nothing) {
    for (const std::string& name : bundled()) {
        SCOPED_TRACE(name);
        EXPECT_TRUE(read_rig_template(bundled_rig(name), name).warnings.empty());
        const Rig rig = make_rig(name);
        EXPECT_EQ(problem(*rig.skeleton), "");
        EXPECT_EQ(rig.skeleton->joint_count(), 22);
        for (Role role : {Role::hips, Role::spine, Role::chest, Role::upper_chest, Role::neck, Role::head,
                          Role::left_shoulder, Role::right_hand, Role::left_toes, Role::right_foot})
            EXPECT_TRUE(rig.roles.has(role)) << role_name(role);
        const std::vector<Transform> pose = models(rig);
        const Leg& leg = rig.legs[Side::left];
        const SolePoints sole =
            sole_points(leg, pose[static_cast<std::size_t>(leg.foot)], pose[static_cast<std::size_t>(leg.toes)]);
        for (const Vec3 point : {sole.heel, sole.mid, sole.ball, sole.toe_tip}) EXPECT_NEAR(point.y, 0, 1e-5f);
        EXPECT_GT(sole.toe_tip.z, sole.ball.z);
        EXPECT_GT(sole.ball.z, sole.heel.z);
    }
}

TEST(BundledRigs, come_with_any_spine_with_fingers_and_without_toes) {
    for (const std::string& name : bundled())
        for (int spine = 1; spine <= k_max_chain_joints; ++spine) {
            const Rig rig = make_rig(
                name, std::vector{"spine=" + std::to_string(spine), std::string("fingers=1"), std::string("toes=0")});
            EXPECT_EQ(rig.skeleton->joint_count(), 22 - 3 + spine + 30 - 2);
            EXPECT_TRUE(rig.roles.has(Role::right_little_distal));
            EXPECT_FALSE(rig.roles.has(Role::left_toes));
            // Reading its names back gives the same roles.
            const RoleReport found = find_roles(*rig.skeleton, models(rig));
            EXPECT_EQ(found.roles, rig.roles) << name << " " << spine;
        }
}

TEST(BundledRigs, are_as_tall_as_asked_whatever_their_proportions) {
    for (const std::string& name : bundled())
        for (const char* proportion : {"leg=1.7", "trunk=0.6", "head=2", "neck=3", "arm=2", "foot=2", "heel=40"}) {
            const Rig rig = make_rig(name, set({"stature=2.5", proportion}));
            EXPECT_NEAR(rig.stature, 2.5f, 1e-5f) << name << " " << proportion;
        }
}

TEST(BundledRigs, have_the_proportions_that_their_names_promise) {
    const Rig adult = make_rig("adult"), child = make_rig("child"), giant = make_rig("giant");
    const auto head_share = [](const Rig& rig) { return (rig.stature - place(rig, Role::head).y) / rig.stature; };
    const auto leg_share = [](const Rig& rig) { return rig.legs[Side::left].length() / rig.stature; };
    EXPECT_NEAR(head_share(adult), 0.12f, 1e-5f);
    EXPECT_GT(head_share(child), 0.16f);
    EXPECT_LT(head_share(giant), 0.1f);
    EXPECT_LT(leg_share(child), leg_share(adult) - 0.04f);
    EXPECT_NEAR(giant.stature, 4, 1e-5f);
    // Fingertips of hanging arms reach the knees.
    const Rig apes = make_rig("long_arms");
    const auto reach = [](const Rig& rig) {
        const float arm = place(rig, Role::left_hand).x - place(rig, Role::left_upper_arm).x;
        const float hand = rig.skeleton->tips[static_cast<std::size_t>(rig.roles[Role::left_hand])].x;
        return place(rig, Role::left_upper_arm).y - arm - hand;
    };
    EXPECT_LT(reach(apes), place(apes, Role::left_lower_leg).y);
    EXPECT_GT(reach(adult), place(adult, Role::left_lower_leg).y + 0.1f);
}

TEST(BundledRigs, the_toe_walker_has_high_heels_bent_knees_and_its_weight_over_its_toes) {
    const Rig rig = make_rig("toe_walker");
    EXPECT_GT(place(rig, Role::left_foot).y, 0.12f * rig.stature);
    EXPECT_GT(place(rig, Role::left_lower_leg).z, place(rig, Role::left_foot).z + 0.1f);
    const Leg& leg = rig.legs[Side::left];
    const std::vector<Transform> pose = models(rig);
    const SolePoints sole =
        sole_points(leg, pose[static_cast<std::size_t>(leg.foot)], pose[static_cast<std::size_t>(leg.toes)]);
    const float hips = place(rig, Role::left_upper_leg).z;
    EXPECT_LT(sole.heel.z, hips);
    EXPECT_GT(sole.toe_tip.z, hips);
    EXPECT_LT(sole.toe_tip.z - sole.heel.z, 0.12f * rig.stature);
    EXPECT_GT(rig.limits[Role::right_foot].high.x, human_limits()[Role::right_foot].high.x);
}

TEST(BundledRigs, refuse_what_is_out_of_range) {
    EXPECT_THROW(make_rig("nobody"), Error);
    EXPECT_THROW(make_rig("adult", set({"stature=0"})), Error);
    EXPECT_THROW(make_rig("adult", set({"wings=2"})), Error);
    EXPECT_THROW(make_rig("adult", set({"spine=3.5"})), Error);
    EXPECT_THROW(make_rig("adult", set({"spine=25"})), Error);
}

}  // namespace
}  // namespace surefoot
