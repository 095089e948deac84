#include <surefoot/body/body.h>

#include "tests/support/allocations.h"
#include "tests/support/rigs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace surefoot {
namespace {

using test::Rig;

Body body_of(const Rig& rig) { return make_body(*rig.skeleton, rig.roles, rig.legs, rig.stance); }

/// Channels of eight lanes, by name.
struct Channels {
    std::vector<float> values = std::vector<float>(8 * k_body_channels);

    float& at(BodyChannel c, int lane = 0) {
        return values[8 * static_cast<std::size_t>(c) + static_cast<std::size_t>(lane)];
    }
    float& at(BodyChannel c, Side side, int lane = 0) {
        return values[8 * static_cast<std::size_t>(of_side(c, side)) + static_cast<std::size_t>(lane)];
    }
};

struct Solved {
    std::vector<Transform> locals, models;
};
Solved solved(const Rig& rig, const Body& body, const Channels& channels, int lane = 0) {
    std::vector<float> pose(body.pose_floats());
    solve(body, channels.values, pose);
    Solved s;
    s.locals.resize(rig.skeleton->rest.size());
    s.models = s.locals;
    write_pose(body, pose, lane, s.locals);
    local_to_model(*rig.skeleton, s.locals, s.models);
    return s;
}
Vec3 place(const Rig& rig, const Solved& s, Role role) {
    return s.models[static_cast<std::size_t>(rig.roles[role])].translation;
}
SolePoints sole(const Rig& rig, const Solved& s, Side side) {
    const Leg& leg = rig.legs[side];
    const Transform& foot = s.models[static_cast<std::size_t>(leg.foot)];
    return sole_points(leg, foot, leg.toes == k_no_joint ? foot : s.models[static_cast<std::size_t>(leg.toes)]);
}
float lowest(const SolePoints& p) { return std::min({p.heel.y, p.mid.y, p.ball.y, p.toe_tip.y}); }
float bend(const Rig& rig, const Solved& s, Role a, Role b, Role c) {
    const Vec3 u = normalized(place(rig, s, b) - place(rig, s, a)), v = normalized(place(rig, s, c) - place(rig, s, b));
    return acos(std::clamp(dot(u, v), -1.0f, 1.0f));
}

/// Anything that a gait might say, within `reach` times what people do.
Channels random_channels(Random& random, float reach) {
    Channels channels;
    for (float& value : channels.values) value = random.between(-0.6f, 0.6f) * reach;
    return channels;
}

TEST(BodySolve, lanes_and_their_scalar_twin_give_the_same_bits_and_unit_rotations) {
    Random random(3);
    for (const Rig& rig : test::many_rigs()) {
        const Body body = body_of(rig);
        std::vector<float> a(body.pose_floats()), b(body.pose_floats());
        for (int i = 0; i < 200; ++i) {
            const Channels channels = random_channels(random, i % 4 == 3 ? 1500 : static_cast<float>(i % 4));
            solve(body, channels.values, a);
            solve_scalar(body, channels.values, b);
            for (std::size_t k = 0; k < a.size(); ++k)
                ASSERT_EQ(std::bit_cast<std::uint32_t>(a[k]), std::bit_cast<std::uint32_t>(b[k])) << rig.name << k;
            for (int j = 0; j < body.joint_count(); ++j)
                for (int lane = 0; lane < 8; ++lane) {
                    const float* q = a.data() + 32 * j + lane;
                    ASSERT_NEAR(q[0] * q[0] + q[8] * q[8] + q[16] * q[16] + q[24] * q[24], 1, 1e-5) << rig.name;
                }
        }
    }
}

TEST(BodySolve, all_channels_at_zero_is_a_body_that_stands) {
    for (const Rig& rig : test::many_rigs()) {
        const Solved s = solved(rig, body_of(rig), {});
        for (const Side side : {Side::left, Side::right}) {
            const SolePoints p = sole(rig, s, side);
            for (const Vec3 point : {p.heel, p.mid, p.ball, p.toe_tip}) EXPECT_NEAR(point.y, 0, 1e-4) << rig.name;
        }
        EXPECT_LT(bend(rig, s, Role::left_upper_leg, Role::left_lower_leg, Role::left_foot),
                  rig.name == "a longer left leg" ? 0.7f : 0.45f)
            << rig.name;
        // Arms hang, elbows behind the line and palms in.
        const float arm = distance(place(rig, s, Role::left_upper_arm), place(rig, s, Role::left_hand));
        EXPECT_GT(place(rig, s, Role::left_upper_arm).y - place(rig, s, Role::left_hand).y, 0.95f * arm) << rig.name;
        EXPECT_LT(place(rig, s, Role::left_lower_arm).z, place(rig, s, Role::left_upper_arm).z) << rig.name;
        EXPECT_GT(place(rig, s, Role::head).y, place(rig, s, Role::neck).y) << rig.name;
    }
}

TEST(BodySolve, no_foot_is_ever_more_than_a_millimetre_under_the_floor) {
    Random random(4);
    for (const Rig& rig : test::many_rigs()) {
        const Body body = body_of(rig);
        float worst = 0;
        for (int i = 0; i < 500; ++i) {
            const Channels channels = random_channels(random, i % 2 == 0 ? 1 : 3);
            Channels level = channels;
            for (const Side side : {Side::left, Side::right})
                for (int lane = 0; lane < 8; ++lane) level.at(BodyChannel::foot_floor, side, lane) = 0;
            for (int lane = 0; lane < 8; ++lane) level.at(BodyChannel::ground_slope, lane) = 0;
            for (int lane = 0; lane < 8; lane += 3) {
                const Solved s = solved(rig, body, level, lane);
                worst = std::min({worst, lowest(sole(rig, s, Side::left)), lowest(sole(rig, s, Side::right))});
            }
        }
        EXPECT_GT(worst, -0.001f) << rig.name;
    }
}

TEST(BodySolve, feet_lie_flat_on_a_slope) {
    for (const Rig& rig : test::many_rigs()) {
        Channels channels;
        channels.at(BodyChannel::ground_slope) = 0.2f;
        channels.at(BodyChannel::foot_z, Side::left) = 0.2f;
        channels.at(BodyChannel::hip_y, Side::left) = channels.at(BodyChannel::hip_y, Side::right) = -0.1f;
        const Solved s = solved(rig, body_of(rig), channels);
        for (const Side side : {Side::left, Side::right}) {
            const SolePoints p = sole(rig, s, side);
            for (const Vec3 point : {p.heel, p.ball, p.toe_tip})
                EXPECT_NEAR(point.y, point.z * tan(0.2f), 1e-3) << rig.name;
        }
    }
}

TEST(BodySolve, a_rolling_foot_stands_on_its_heel_or_its_ball_and_toes_stay_down) {
    for (const Rig& rig : test::many_rigs()) {
        const Body body = body_of(rig);
        Channels channels;
        channels.at(BodyChannel::hip_y, Side::left) = channels.at(BodyChannel::hip_y, Side::right) = -0.15f;
        const SolePoints flat = sole(rig, solved(rig, body, channels), Side::left);
        for (const float pitch : {-0.35f, -0.1f, 0.2f, 0.6f, 0.8f}) {
            channels.at(BodyChannel::foot_rx, Side::left) = pitch;
            const SolePoints rolled = sole(rig, solved(rig, body, channels), Side::left);
            if (pitch < 0) {
                EXPECT_LT(distance(rolled.heel, flat.heel), 1e-3f) << rig.name << pitch;
                EXPECT_GT(rolled.ball.y, 0.005f) << rig.name << pitch;
            } else {
                const bool toes = rig.legs[Side::left].toes != k_no_joint;
                if (toes) {
                    EXPECT_LT(distance(rolled.ball, flat.ball), 1e-3f) << rig.name << pitch;
                }
                EXPECT_LT(distance(rolled.toe_tip, flat.toe_tip), 1e-3f) << rig.name << pitch;
                EXPECT_GT(rolled.heel.y, 0.005f) << rig.name << pitch;
            }
        }
    }
}

TEST(BodySolve, feet_and_hands_come_where_they_are_told) {
    for (const Rig& rig : test::many_rigs()) {
        const Body body = body_of(rig);
        Channels channels;
        channels.at(BodyChannel::hand_hold, Side::left) = 1;
        const Solved standing = solved(rig, body, channels);
        for (const Side side : {Side::left, Side::right}) channels.at(BodyChannel::hip_y, side) = -0.1f;
        const Vec3 step = Vec3{0.05f, 0.12f, 0.2f} * body.scale.leg;
        channels.at(BodyChannel::foot_x, Side::right) = step.x;
        channels.at(BodyChannel::foot_y, Side::right) = step.y;
        channels.at(BodyChannel::foot_z, Side::right) = step.z;
        const Vec3 reach = Vec3{-0.03f, 0.25f, 0.25f} * body.scale.arm;
        channels.at(BodyChannel::hand_x, Side::left) = reach.x;
        channels.at(BodyChannel::hand_y, Side::left) = reach.y;
        channels.at(BodyChannel::hand_z, Side::left) = reach.z;
        const Solved s = solved(rig, body, channels);
        EXPECT_LT(distance(place(rig, s, Role::right_foot), place(rig, standing, Role::right_foot) + step),
                  rig.name == "a longer left leg" ? 0.03f : 1e-3f)
            << rig.name;
        EXPECT_LT(distance(place(rig, s, Role::left_hand), place(rig, standing, Role::left_hand) + reach), 0.02f)
            << rig.name;
    }
}

TEST(BodySolve, hips_sink_where_a_step_is_too_long_and_the_foot_still_arrives) {
    for (const Rig& rig : test::many_rigs()) {
        const Body body = body_of(rig);
        const Solved standing = solved(rig, body, {});
        Channels channels;
        channels.at(BodyChannel::foot_z, Side::left) = 0.5f * body.scale.leg;
        const Solved s = solved(rig, body, channels);
        EXPECT_LT(place(rig, s, Role::hips).y, place(rig, standing, Role::hips).y - 0.02f) << rig.name;
        EXPECT_NEAR(place(rig, s, Role::left_foot).z - place(rig, standing, Role::left_foot).z, 0.5f * body.scale.leg,
                    1e-3f)
            << rig.name;
    }
}

// The step of a joint's angle for equal steps of a target that passes through full stretch: no pop.
TEST(BodySolve, limbs_do_not_pop_at_full_stretch) {
    for (const Rig& rig : test::many_rigs()) {
        const Body body = body_of(rig);
        float before = 0, worst = 0;
        for (int i = 0; i <= 400; ++i) {
            Channels channels;
            channels.at(BodyChannel::hand_hold, Side::left) = 1;
            channels.at(BodyChannel::hand_y, Side::left) = -0.001f * static_cast<float>(i - 200) * body.scale.arm;
            const float angle =
                bend(rig, solved(rig, body, channels), Role::left_upper_arm, Role::left_lower_arm, Role::left_hand);
            if (i > 0) worst = std::max(worst, std::fabs(angle - before));
            EXPECT_GT(angle, 0) << rig.name;
            before = angle;
        }
        EXPECT_LT(worst, 0.03f) << rig.name;  // radians a millimetre
    }
}

TEST(BodySolve, knees_bend_forward_and_elbows_back_and_neither_beyond_its_limit) {
    Random random(6);
    for (const Rig& rig : test::many_rigs()) {
        const Body body = body_of(rig);
        for (int i = 0; i < 200; ++i) {
            const Channels channels = random_channels(random, 1);
            const Solved s = solved(rig, body, channels, i % 8);
            const float knee = bend(rig, s, Role::left_upper_leg, Role::left_lower_leg, Role::left_foot);
            const float elbow = bend(rig, s, Role::right_upper_arm, Role::right_lower_arm, Role::right_hand);
            EXPECT_LE(knee, human_limits()[Role::left_lower_leg].high.x + 0.02f) << rig.name;
            EXPECT_LE(elbow, -human_limits()[Role::left_lower_arm].low.x + 0.02f) << rig.name;
        }
        Channels crouched;
        crouched.at(BodyChannel::hip_y, Side::left) = crouched.at(BodyChannel::hip_y, Side::right) =
            -0.3f * body.scale.leg;
        const Solved s = solved(rig, body, crouched);
        for (const auto& [hip, knee, ankle] : {std::array{Role::left_upper_leg, Role::left_lower_leg, Role::left_foot},
                                               {Role::right_upper_leg, Role::right_lower_leg, Role::right_foot}}) {
            const Vec3 middle = lerp(place(rig, s, hip), place(rig, s, ankle), 0.5f);
            EXPECT_GT(place(rig, s, knee).z - middle.z, 0.1f * body.scale.leg) << rig.name;
        }
    }
}

TEST(BodySolve, the_spine_shares_lean_and_turn_over_any_number_of_joints) {
    const surefoot::Rig adult = make_biped();
    for (const int joints : {1, 2, 5, 9, 30}) {
        // The same trunk in equal parts.
        auto skeleton = std::make_shared<Skeleton>();
        RoleMap roles;
        const Skeleton& from = *adult.skeleton;
        std::vector<int> now(from.parents.size());
        const float span = 0.18f * adult.stature;
        int chest = k_no_joint;
        for (int j = 0; j < from.joint_count(); ++j) {
            const auto at = static_cast<std::size_t>(j);
            const bool trunk =
                j == adult.roles[Role::spine] || j == adult.roles[Role::chest] || j == adult.roles[Role::upper_chest];
            if (j == adult.roles[Role::spine]) {
                int parent = now[static_cast<std::size_t>(from.parents[at])];
                for (int k = 0; k < joints; ++k) {
                    const float up = k == 0 ? 0.04f * adult.stature : span / static_cast<float>(joints);
                    parent = skeleton->add("Spine" + std::to_string(k), parent, {{}, {0, up, 0}});
                }
                chest = parent;
            }
            if (trunk) {
                now[at] = chest;
                continue;
            }
            const int parent =
                from.parents[at] == k_no_joint ? k_no_joint : now[static_cast<std::size_t>(from.parents[at])];
            now[at] = skeleton->add(from.names[at], parent, from.rest[at], from.tips[at]);
        }
        for (int r = 0; r < k_role_count; ++r) {
            const auto role = static_cast<Role>(r);
            if (adult.roles.has(role)) roles.set(role, now[static_cast<std::size_t>(adult.roles[role])]);
        }
        const Rig rig = test::finished(std::to_string(joints), skeleton, roles);
        const Body body = body_of(rig);
        Channels channels;
        channels.at(BodyChannel::chest_ry) = 0.5f;
        channels.at(BodyChannel::chest_rx) = 0.4f;
        const Solved s = solved(rig, body, channels);
        const auto turn = [&](int joint) {
            const auto at = static_cast<std::size_t>(joint);
            return normalized(s.models[at].rotation * conjugate(rig.stance[at].rotation));
        };
        EXPECT_NEAR(yaw_of(turn(chest)), 0.5f, 0.01f) << joints;
        EXPECT_NEAR(asin(-rotate(turn(chest), {0, 0, 1}).y), 0.4f, 0.02f) << joints;
        float most = 0;
        for (int j = chest; j != rig.roles[Role::hips]; j = rig.skeleton->parents[static_cast<std::size_t>(j)])
            most = std::max(most, rotation_angle(normalized(
                                      conjugate(turn(rig.skeleton->parents[static_cast<std::size_t>(j)])) * turn(j))));
        EXPECT_LT(most, 1.2f * 0.65f / static_cast<float>(std::min(joints, 20)) + 0.02f) << joints;
    }
}

TEST(BodySolve, a_frame_allocates_nothing) {
    const Rig rig = test::many_rigs().front();
    const Body body = body_of(rig);
    const ControlName name{"left_foot.tZ", "m"};
    const BodyBinding binding = bind_controls({&name, 1});
    std::vector<float> outputs(8, 0.1f), pose(body.pose_floats());
    std::vector<Transform> locals(rig.skeleton->rest.size());
    Channels channels;
    const long before = test::allocation_count();
    for (int i = 0; i < 10; ++i) {
        apply(binding, body.scale, outputs, channels.values);
        solve(body, channels.values, pose);
        write_pose(body, pose, 3, locals);
    }
    EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace surefoot
