#include <surefoot/base/random.h>
#include <surefoot/rig/limits.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

float rad(float degrees) { return degrees * k_radians_per_degree; }

constexpr Vec3 k_x{1, 0, 0}, k_y{0, 1, 0}, k_z{0, 0, 1};

/// Hips, spine joints, neck, head and the two arms of a T-pose whose joints have odd axes.
struct Body {
    Skeleton skeleton;
    RoleMap roles;
    std::vector<Quat> stance;

    int add(std::string name, int parent, Quat model) {
        const Quat above = parent == k_no_joint ? Quat{} : stance[static_cast<std::size_t>(parent)];
        stance.push_back(model);
        return skeleton.add(std::move(name), parent, {normalized(conjugate(above) * model), {0, 0.1f, 0}});
    }
    int add(Role role, int parent, Quat model) {
        const int joint = add(std::string(role_name(role)), parent, model);
        roles.set(role, joint);
        return joint;
    }
};

Body make_body(int spine_joints, Random random) {
    const auto odd = [&] {
        const auto turn = [&] { return random.between(-1.5f, 1.5f); };
        return from_rotation_vector({turn(), turn(), turn()});
    };
    Body body;
    const int hips = body.add(Role::hips, k_no_joint, odd());
    int top = body.add(Role::spine, hips, odd());
    for (int i = 1; i < spine_joints; ++i) top = body.add("spine" + std::to_string(i), top, odd());
    body.add(Role::head, body.add(Role::neck, top, odd()), odd());
    for (const bool left : {true, false}) {
        const auto of = [&](Role role) { return left ? role : mirrored(role); };
        const int arm = body.add(of(Role::left_upper_arm), top, odd());
        body.add(of(Role::left_lower_arm), arm, odd());
        const int leg = body.add(of(Role::left_upper_leg), hips, odd());
        body.add(of(Role::left_lower_leg), leg, odd());
    }
    return body;
}

TEST(JointLimit, turns_are_three_angles_and_back) {
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const Vec3 bone = i % 3 == 0 ? k_x : i % 3 == 1 ? k_y : k_z;
        const auto angle = [&] { return random.between(-1.7f, 1.7f); };
        const Vec3 angles{angle(), angle(), angle()};
        const Vec3 again = turn_angles(turn_from_angles(angles, bone), bone);
        EXPECT_LT(distance(angles, again), 1e-3f);
    }
    // One axis at a time the angles are those that one would name.
    EXPECT_NEAR(turn_angles(axis_angle(k_x, rad(40)), k_y).x, rad(40), 1e-6f);
    EXPECT_NEAR(turn_angles(axis_angle(k_y, rad(-70)), k_y).y, rad(-70), 1e-6f);
    EXPECT_NEAR(turn_angles(axis_angle(k_z, rad(170)), k_y).z, rad(170), 1e-5f);
}

TEST(JointLimit, what_is_within_stays_to_the_bit_and_what_is_not_comes_to_the_rim) {
    const JointLimit knee = human_limits()[Role::left_lower_leg];
    const Quat bent = axis_angle(k_x, rad(120));
    EXPECT_EQ(clamped(knee, bent), bent);
    EXPECT_NEAR(rotation_angle(clamped(knee, axis_angle(k_x, rad(-40)))), rad(5), 1e-5f);
    EXPECT_NEAR(turn_angles(clamped(knee, axis_angle(k_x, rad(175))), k_y).x, rad(150), 1e-5f);
    EXPECT_NEAR(turn_angles(clamped(knee, axis_angle(k_z, rad(30))), k_y).z, rad(5), 1e-5f);
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        const auto angle = [&] { return random.between(-1.7f, 1.7f); };
        const JointLimit& limit = human_limits()[static_cast<Role>(random.below(k_role_count))];
        const Quat once = clamped(limit, from_rotation_vector({angle(), angle(), angle()}));
        const Vec3 angles = turn_angles(once, limit.bone);
        for (const float excess : {angles.x - limit.high.x, angles.y - limit.high.y, angles.z - limit.high.z,
                                   limit.low.x - angles.x, limit.low.y - angles.y, limit.low.z - angles.z})
            EXPECT_LT(excess, 1e-3f);
    }
}

TEST(RoleLimits, the_right_side_is_the_mirror_image_of_the_left) {
    const RoleLimits& human = human_limits();
    EXPECT_TRUE(human[Role::hips].free());
    EXPECT_FALSE(human[Role::left_foot].free());
    // Legs apart: to the left for the left one, to the right for the right one.
    EXPECT_NEAR(human[Role::left_upper_leg].high.z, rad(45), 1e-6f);
    EXPECT_NEAR(human[Role::right_upper_leg].low.z, rad(-45), 1e-6f);
    EXPECT_EQ(human[Role::left_upper_leg].low.x, human[Role::right_upper_leg].low.x);
    EXPECT_NEAR(human[Role::right_foot].high.z, rad(35), 1e-6f);
}

TEST(BodyLimits, hold_whatever_the_axes_of_the_joints) {
    for (std::uint64_t seed = 1; seed < 9; ++seed) {
        const Body body = make_body(2, Random(seed));
        const BodyLimits limits(body.skeleton, body.roles, body.stance);
        const int knee = body.roles[Role::right_lower_leg], arm = body.roles[Role::left_upper_arm];
        // In the T-stance the arms are raised by 90 degrees to the side and nothing else is turned.
        const auto resting = [&](int j) { return body.skeleton.rest[static_cast<std::size_t>(j)].rotation; };
        EXPECT_LT(distance(turn_angles(limits.turn(arm, resting(arm)), k_y), {0, 0, rad(90)}), 1e-5f);
        EXPECT_LT(rotation_angle(limits.turn(knee, resting(knee))), 1e-5f);
        EXPECT_EQ(limits.clamped(knee, resting(knee)), resting(knee));
        const Quat bent = limits.local(knee, axis_angle(k_x, rad(160)));
        EXPECT_NEAR(turn_angles(limits.turn(knee, limits.clamped(knee, bent)), k_y).x, rad(150), 1e-4f);
        // The elbow bends forward of a hanging arm: the hand comes to the front.
        const int elbow = body.roles[Role::left_lower_arm];
        const Quat fore = limits.turn(elbow, limits.clamped(elbow, limits.local(elbow, axis_angle(k_x, rad(-90)))));
        EXPECT_GT(rotate(fore, {0, -1, 0}).z, 0.99f);
        const Quat back = limits.turn(elbow, limits.clamped(elbow, limits.local(elbow, axis_angle(k_x, rad(90)))));
        EXPECT_LT(rotate(back, {0, -1, 0}).y, -0.99f);
    }
}

TEST(BodyLimits, joints_of_the_trunk_share_its_range_however_many_there_are) {
    for (const int joints : {1, 2, 5, 24}) {
        const Body body = make_body(joints, Random(4));
        const BodyLimits limits(body.skeleton, body.roles, body.stance);
        Quat whole;
        for (int j = body.roles[Role::spine]; j != body.roles[Role::neck]; ++j)
            whole = limits.turn(j, limits.clamped(j, limits.local(j, axis_angle(k_x, rad(90))))) * whole;
        EXPECT_NEAR(rotation_angle(whole), rad(80), 1e-3f) << joints;
        EXPECT_NEAR(limits[body.roles[Role::neck]].high.y, rad(30), 1e-5f);
        EXPECT_NEAR(limits[body.roles[Role::head]].high.y, rad(30), 1e-5f);
    }
}

}  // namespace
}  // namespace surefoot
