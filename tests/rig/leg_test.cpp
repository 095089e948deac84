#include <surefoot/rig/leg.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

struct Body {
    Skeleton skeleton;
    RoleMap roles;
    std::vector<Transform> standing;
};

// Legs of 0.42 + 0.40 m, ankles 0.08 m up; feet turned out by `toe_out`, joints with odd axes.
Body make_body(bool toes, Vec3 tip = {}, float toe_out = 0) {
    Body body;
    std::vector<Transform>& models = body.standing;
    const auto add = [&](const char* name, int parent, Vec3 position, Quat axes, Vec3 tip_in_model = {}) {
        const Transform model{normalized(axes), position};
        const Transform local = parent < 0 ? model : inverse(models[static_cast<std::size_t>(parent)]) * model;
        models.push_back(model);
        return body.skeleton.add(name, parent, local, rotate(conjugate(model.rotation), tip_in_model));
    };
    const Quat odd{0.3f, -0.4f, 0.5f, 0.6f};
    const int hips = add("hips", k_no_joint, {0, 0.95f, 0}, odd);
    body.roles.set(Role::hips, hips);
    for (const bool left : {true, false}) {
        const float x = left ? 0.1f : -0.1f;
        const Quat out = from_yaw(left ? toe_out : -toe_out);
        const auto role = [&](Role r) { return left ? r : mirrored(r); };
        const auto name = [&](const char* part) { return std::string(left ? "l_" : "r_") + part; };
        const int upper = add(name("thigh").c_str(), hips, {x, 0.9f, 0}, odd * odd);
        const int lower = add(name("shin").c_str(), upper, {x, 0.48f, 0}, odd);
        const int foot = add(name("foot").c_str(), lower, {x, 0.08f, 0}, odd, toes ? Vec3{} : rotate(out, tip));
        body.roles.set(role(Role::left_upper_leg), upper);
        body.roles.set(role(Role::left_lower_leg), lower);
        body.roles.set(role(Role::left_foot), foot);
        if (!toes) continue;
        const Vec3 ball = Vec3{x, 0.02f, 0} + rotate(out, {0, 0, 0.13f});
        const int toe = add(name("toe").c_str(), foot, ball, odd * odd, rotate(out, tip));
        body.roles.set(role(Role::left_toes), toe);
    }
    return body;
}

SolePoints sole_of(const Body& body, const Legs& legs, Side side) {
    const Leg& leg = legs[side];
    const int toes = leg.toes == k_no_joint ? leg.foot : leg.toes;
    return sole_points(leg, body.standing[static_cast<std::size_t>(leg.foot)],
                       body.standing[static_cast<std::size_t>(toes)]);
}

TEST(legs, a_standing_sole_lies_on_the_floor_in_the_order_heel_mid_ball_toe) {
    for (const bool toes : {true, false})
        for (const Vec3 tip : {Vec3{}, Vec3{0, 0, 0.08f}, Vec3{0, -0.05f, 0.2f}}) {
            const Body body = make_body(toes, tip, 0.2f);
            const Legs legs = make_legs(body.skeleton, body.roles, body.standing, 0.01f);
            for (const Side side : {Side::left, Side::right}) {
                const SolePoints sole = sole_of(body, legs, side);
                for (const Vec3 point : {sole.heel, sole.mid, sole.ball, sole.toe_tip})
                    EXPECT_NEAR(point.y, 0.01f, 1e-5f);
                EXPECT_LT(sole.heel.z, -0.03f);
                EXPECT_GT(sole.mid.z, sole.heel.z);
                EXPECT_GT(sole.ball.z, sole.mid.z);
                EXPECT_GT(sole.toe_tip.z, sole.ball.z + 0.02f);
                const float whole = distance(sole.heel, sole.toe_tip);
                EXPECT_GT(whole, 0.18f) << toes << " tip " << tip.z;
                EXPECT_LT(whole, 0.42f) << toes << " tip " << tip.z;
            }
        }
}

TEST(legs, the_ball_is_under_the_toe_joint_and_the_heel_a_quarter_of_the_foot_behind_the_ankle) {
    const Body body = make_body(true, {}, 0);
    const Legs legs = make_legs(body.skeleton, body.roles, body.standing, 0);
    const SolePoints sole = sole_of(body, legs, Side::left);
    EXPECT_LT(distance(sole.ball, {0.1f, 0, 0.13f}), 1e-5f);
    const float whole = distance(sole.heel, sole.toe_tip);
    EXPECT_NEAR(-sole.heel.z, 0.25f * whole, 1e-4f);
    EXPECT_NEAR(distance(sole.ball, sole.toe_tip), 0.5f * distance(sole.heel, sole.ball), 1e-4f);
}

TEST(legs, a_toe_tip_given_by_the_file_is_used) {
    const Body body = make_body(true, {0, 0, 0.06f}, 0);
    const Legs legs = make_legs(body.skeleton, body.roles, body.standing, 0);
    EXPECT_LT(distance(sole_of(body, legs, Side::right).toe_tip, {-0.1f, 0, 0.19f}), 1e-5f);
}

TEST(legs, feet_turned_out_keep_their_own_direction) {
    const Body body = make_body(true, {}, 0.3f);
    const Legs legs = make_legs(body.skeleton, body.roles, body.standing, 0);
    for (const Side side : {Side::left, Side::right}) {
        const Leg& leg = legs[side];
        const Quat foot = body.standing[static_cast<std::size_t>(leg.foot)].rotation;
        EXPECT_NEAR(yaw_of(rotation_between({0, 0, 1}, rotate(foot, leg.forward))), side == Side::left ? 0.3f : -0.3f,
                    1e-4f);
        EXPECT_LT(distance(rotate(foot, leg.up), k_up), 1e-5f);
    }
}

TEST(legs, a_foot_with_nothing_ahead_of_the_ankle_points_where_the_body_looks) {
    Body body = make_body(false);
    const Quat around = from_yaw(1.2f);
    for (Transform& model : body.standing) model = Transform{around, {3, 0, 1}} * model;
    const Legs legs = make_legs(body.skeleton, body.roles, body.standing, 0);
    EXPECT_EQ(legs[Side::left].toes, k_no_joint);
    const Quat foot = body.standing[static_cast<std::size_t>(legs[Side::left].foot)].rotation;
    EXPECT_LT(distance(rotate(foot, legs[Side::left].forward), rotate(around, {0, 0, 1})), 1e-4f);
}

TEST(legs, lengths_come_from_the_rest_pose_and_joints_from_the_roles) {
    const Body body = make_body(true);
    const Legs legs = make_legs(body.skeleton, body.roles, body.standing, 0);
    EXPECT_EQ(legs.hips, body.roles[Role::hips]);
    for (const Side side : {Side::left, Side::right}) {
        EXPECT_NEAR(legs[side].upper_length, 0.42f, 1e-5f);
        EXPECT_NEAR(legs[side].lower_length, 0.40f, 1e-5f);
    }
    EXPECT_EQ(legs[Side::right].toes, body.skeleton.find("r_toe"));
}

TEST(legs, bending_toes_take_the_tip_along_and_leave_the_ball) {
    const Body body = make_body(true);
    const Legs legs = make_legs(body.skeleton, body.roles, body.standing, 0);
    const Leg& leg = legs[Side::left];
    const Transform& foot = body.standing[static_cast<std::size_t>(leg.foot)];
    Transform toes = body.standing[static_cast<std::size_t>(leg.toes)];
    const SolePoints flat = sole_points(leg, foot, toes);
    toes.rotation = axis_angle({1, 0, 0}, -0.5f) * toes.rotation;
    const SolePoints bent = sole_points(leg, foot, toes);
    EXPECT_EQ(bent.ball, flat.ball);
    EXPECT_GT(bent.toe_tip.y, flat.toe_tip.y + 0.02f);
}

// A leg that stands on its toes: the ankle high above a ball that lies `behind` or ahead of it.
Body make_toe_walker(float ahead, bool toes) {
    Body body;
    const auto add = [&](const char* name, int parent, Vec3 position, Vec3 tip = {}) {
        const Vec3 above = parent < 0 ? Vec3{} : body.standing[static_cast<std::size_t>(parent)].translation;
        body.standing.push_back({{}, position});
        return body.skeleton.add(name, parent, {{}, position - above}, tip);
    };
    body.roles.set(Role::hips, add("hips", k_no_joint, {0, 0.95f, 0}));
    for (const bool left : {true, false}) {
        const float x = left ? 0.1f : -0.1f;
        const auto role = [&](Role r) { return left ? r : mirrored(r); };
        const auto name = [&](const char* part) { return std::string(left ? "l_" : "r_") + part; };
        const int upper = add(name("thigh").c_str(), body.roles[Role::hips], {x, 0.9f, 0});
        const int lower = add(name("shin").c_str(), upper, {x, 0.6f, 0.15f});
        const Vec3 ankle{x, 0.28f, -0.05f}, ball{x, 0.02f, -0.05f + ahead}, tip = ball + Vec3{0, -0.02f, 0.1f};
        const int foot = add(name("foot").c_str(), lower, ankle, toes ? Vec3{} : tip - ankle);
        body.roles.set(role(Role::left_upper_leg), upper);
        body.roles.set(role(Role::left_lower_leg), lower);
        body.roles.set(role(Role::left_foot), foot);
        if (toes) body.roles.set(role(Role::left_toes), add(name("toe").c_str(), foot, ball, tip - ball));
    }
    return body;
}

TEST(legs, who_stands_on_its_toes_has_its_sole_under_them) {
    for (const bool toes : {true, false})
        for (const float ahead : {0.08f, 0.03f, -0.03f}) {
            if (!toes && ahead < 0) continue;  // nothing says where its toes begin
            const Body body = make_toe_walker(ahead, toes);
            const Legs legs = make_legs(body.skeleton, body.roles, body.standing, 0);
            for (const Side side : {Side::left, Side::right}) {
                const SolePoints sole = sole_of(body, legs, side);
                const float ball = -0.05f + ahead, tip = ball + 0.1f;
                EXPECT_NEAR(sole.toe_tip.z, tip, 1e-5f);
                if (toes) {
                    EXPECT_NEAR(sole.ball.z, ball, 1e-5f);
                }
                EXPECT_LT(sole.heel.z, sole.ball.z - 0.02f);
                EXPECT_GT(sole.heel.z, -0.15f);
                EXPECT_NEAR(sole.mid.z, 0.5f * (sole.heel.z + sole.ball.z), 1e-5f);
                for (const Vec3 point : {sole.heel, sole.mid, sole.ball, sole.toe_tip}) {
                    EXPECT_NEAR(point.y, 0, 1e-5f);
                    EXPECT_NEAR(std::fabs(point.x), 0.1f, 1e-5f);
                }
            }
        }
}

}  // namespace
}  // namespace surefoot
