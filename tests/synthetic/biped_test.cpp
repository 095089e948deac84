#include <surefoot/synthetic/biped.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

class Biped175 : public ::testing::Test {
  protected:
    Biped175() : models(static_cast<std::size_t>(biped.skeleton->joint_count())) {
        local_to_model(*biped.skeleton, biped.skeleton->rest, models);
    }
    Vec3 at(Role role) const { return models[static_cast<std::size_t>(biped.roles[role])].translation; }
    Vec3 tip(Role role) const {
        const auto j = static_cast<std::size_t>(biped.roles[role]);
        return transform_point(models[j], biped.skeleton->tips[j]);
    }

    Rig biped = make_biped();
    std::vector<Transform> models;
};

TEST_F(Biped175, is_a_sound_skeleton_with_every_locomotion_role) {
    EXPECT_EQ(problem(*biped.skeleton), "");
    EXPECT_EQ(biped.skeleton->joint_count(), 22);
    for (Role role :
         {Role::hips, Role::spine, Role::chest, Role::upper_chest, Role::neck, Role::head, Role::left_shoulder,
          Role::right_hand, Role::left_toes, Role::right_toes, Role::left_foot, Role::right_lower_leg})
        EXPECT_TRUE(biped.roles.has(role));
    EXPECT_EQ(biped.skeleton->names[static_cast<std::size_t>(biped.roles[Role::right_upper_leg])], "RightUpperLeg");
}

TEST_F(Biped175, has_the_segment_lengths_of_drillis_and_contini) {
    EXPECT_NEAR(distance(at(Role::left_upper_leg), at(Role::left_lower_leg)), 0.245f * 1.75f, 1e-5f);
    EXPECT_NEAR(distance(at(Role::left_lower_leg), at(Role::left_foot)), 0.246f * 1.75f, 1e-5f);
    EXPECT_NEAR(at(Role::left_foot).y, 0.039f * 1.75f, 1e-5f);
    EXPECT_NEAR(distance(at(Role::right_upper_arm), at(Role::right_lower_arm)), 0.186f * 1.75f, 1e-5f);
    EXPECT_NEAR(distance(at(Role::right_lower_arm), at(Role::right_hand)), 0.146f * 1.75f, 1e-5f);
    EXPECT_NEAR(tip(Role::head).y, 1.75f, 1e-5f);
}

TEST_F(Biped175, stands_on_the_floor_facing_z_with_its_left_on_x) {
    EXPECT_NEAR(tip(Role::left_toes).y, 0, 1e-6f);
    EXPECT_GT(tip(Role::left_toes).z, at(Role::left_foot).z);
    EXPECT_GT(at(Role::left_hand).x, 0.5f);
}

TEST_F(Biped175, is_symmetric) {
    const std::pair<Role, Role> pairs[] = {{Role::left_hand, Role::right_hand},
                                           {Role::left_toes, Role::right_toes},
                                           {Role::left_upper_leg, Role::right_upper_leg}};
    for (const auto& [left, right] : pairs) {
        const Vec3 mirror{-at(left).x, at(left).y, at(left).z};
        EXPECT_LT(distance(mirror, at(right)), 1e-6f);
    }
}

TEST(LegSize, agrees_with_the_skeleton) {
    const Rig biped = make_biped(1.6f);
    const LegSize size = leg_size(biped);
    const auto rest = [&](Role role) {
        return biped.skeleton->rest[static_cast<std::size_t>(biped.roles[role])].translation;
    };
    EXPECT_NEAR(-rest(Role::left_lower_leg).y, size.thigh, 1e-6f);
    EXPECT_NEAR(-rest(Role::left_foot).y, size.shank, 1e-6f);
    EXPECT_NEAR(rest(Role::left_upper_leg).x, size.hip_half_width, 1e-6f);
    EXPECT_NEAR(-rest(Role::left_upper_leg).y, size.hip_drop, 1e-6f);
    EXPECT_NEAR(rest(Role::left_toes).z, size.ball_ahead, 1e-6f);
    EXPECT_NEAR(-rest(Role::left_toes).y, size.ankle_height, 1e-6f);
}

}  // namespace
}  // namespace surefoot
