#include <surefoot/graph/held_feet.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

LegPaths::Side foot() {
    LegPaths::Side leg;
    leg.toes = 3;
    leg.heel = {0, -0.08f, -0.06f};
    leg.ball = {0, -0.08f, 0.12f};
    return leg;
}

/// A leg of 0.8 m that is bent, and a foot that stands flat, turned by `yaw`, `behind` the hip in its own direction.
struct Standing {
    float yaw;
    BlendedLeg pose;
    FootGoal goal;

    explicit Standing(float behind, float yaw_ = 0.4f) : yaw(yaw_) {
        pose.hip = {0.1f, 0.80f, 0.2f};
        pose.knee = pose.hip + Vec3{0, -0.38f, 0.125f};
        pose.ankle = pose.hip + Vec3{0, -0.72f, -0.08f};
        goal.foot = {from_yaw(yaw), pose.hip + rotate(from_yaw(yaw), Vec3{0.03f, -0.72f, -behind})};
        goal.toes = axis_angle({1, 0, 0}, 0.1f);
    }
    float length() const { return distance(pose.hip, pose.knee) + distance(pose.knee, pose.ankle); }
};

TEST(HeldFeet, a_foot_that_its_leg_reaches_stays_flat) {
    Standing near(0.2f);
    const FootGoal before = near.goal;
    rise_on_ball(foot(), near.pose, near.goal);
    EXPECT_EQ(near.goal.foot, before.foot);
    EXPECT_EQ(near.goal.toes, before.toes);
}

TEST(HeldFeet, a_foot_left_behind_rises_on_its_ball_and_keeps_its_toes_down) {
    const LegPaths::Side leg = foot();
    for (const float yaw : {0.0f, 0.4f, -2.0f}) {
        Standing far(0.45f, yaw);
        const FootGoal before = far.goal;
        ASSERT_GT(distance(far.pose.hip, before.foot.translation), far.length()) << "or nothing is asked of it";
        rise_on_ball(leg, far.pose, far.goal);
        const FootGoal& after = far.goal;
        EXPECT_LT(distance(far.pose.hip, after.foot.translation), far.length());
        EXPECT_LT(distance(transform_point(after.foot, leg.ball), transform_point(before.foot, leg.ball)), 1e-5f);
        const Quat toes = after.foot.rotation * after.toes, toes_before = before.foot.rotation * before.toes;
        EXPECT_NEAR(std::fabs(dot(toes, toes_before)), 1, 1e-5f);
        const float heel = transform_point(after.foot, leg.heel).y - transform_point(before.foot, leg.heel).y;
        EXPECT_GT(heel, 0.03f);
        // It neither turns nor leans.
        const Vec3 sole = transform_point(after.foot, leg.ball) - transform_point(after.foot, leg.heel);
        EXPECT_NEAR(atan2(sole.x, sole.z), yaw, 1e-4f);
    }
}

TEST(HeldFeet, the_heel_begins_to_rise_without_a_jump) {
    float last = 0, fastest = 0;
    constexpr float k_step = 0.001f;  // [m]
    for (float behind = 0.2f; behind < 0.5f; behind += k_step) {
        Standing at(behind);
        const float before = transform_point(at.goal.foot, foot().heel).y;
        rise_on_ball(foot(), at.pose, at.goal);
        const float rise = transform_point(at.goal.foot, foot().heel).y - before;
        EXPECT_GE(rise, last - 1e-4f);
        fastest = std::max(fastest, (rise - last) / k_step);
        last = rise;
    }
    EXPECT_GT(last, 0.05f);
    EXPECT_LT(fastest, 3);
}

TEST(HeldFeet, a_foot_without_toes_cannot_stand_on_them) {
    LegPaths::Side leg = foot();
    leg.toes = k_no_joint;
    Standing far(0.45f);
    const FootGoal before = far.goal;
    rise_on_ball(leg, far.pose, far.goal);
    EXPECT_EQ(far.goal.foot, before.foot);
}

TEST(HeldFeet, a_hip_out_of_all_reach_is_no_number_trouble) {
    for (const float behind : {0.9f, 5.0f}) {
        Standing far(behind);
        rise_on_ball(foot(), far.pose, far.goal);
        EXPECT_NEAR(dot(far.goal.foot.rotation, far.goal.foot.rotation), 1, 1e-5f);
        EXPECT_TRUE(std::isfinite(far.goal.foot.translation.y));
    }
}

}  // namespace
}  // namespace surefoot
