#include <surefoot/base/random.h>
#include <surefoot/ik/two_bone.h>
#include <surefoot/math/trig.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

TwoBone bent_leg() {
    TwoBone leg;
    leg.hip = {0.1f, 0.9f, 0};
    leg.knee = {0.1f, 0.48f, 0.05f};
    leg.ankle = {0.1f, 0.08f, -0.02f};
    leg.target = leg.ankle;
    return leg;
}

Vec3 random_vec(Random& r, float size) {
    return {r.between(-size, size), r.between(-size, size), r.between(-size, size)};
}

TEST(TwoBone, a_target_at_the_animated_ankle_changes_nothing) {
    const TwoBone leg = bent_leg();
    const TwoBoneResult r = solve_two_bone(leg);
    EXPECT_EQ(r.upper, Quat{});
    EXPECT_EQ(r.lower, Quat{});
    EXPECT_EQ(r.knee, leg.knee);
}

TEST(TwoBone, the_ankle_reaches_targets_within_reach_and_bones_keep_their_lengths) {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        TwoBone leg = bent_leg();
        leg.soft_extension = 1;
        leg.target = leg.hip + Vec3{0, -0.45f, 0} + random_vec(random, 0.2f);
        const TwoBoneResult r = solve_two_bone(leg);
        EXPECT_LT(distance(r.ankle, leg.target), 1e-5f);
        EXPECT_NEAR(distance(leg.hip, r.knee), distance(leg.hip, leg.knee), 1e-5f);
        EXPECT_NEAR(distance(r.knee, r.ankle), distance(leg.knee, leg.ankle), 1e-5f);
        // The rotations say the same as the positions.
        EXPECT_LT(distance(leg.hip + rotate(r.upper, leg.knee - leg.hip), r.knee), 1e-5f);
        EXPECT_LT(distance(r.knee + rotate(r.lower, leg.ankle - leg.knee), r.ankle), 1e-5f);
    }
}

float knee_of(const TwoBone& leg, const TwoBoneResult& r) {
    return acos(dot(normalized(leg.hip - r.knee), normalized(r.ankle - r.knee)));
}

TEST(TwoBone, a_leg_that_resists_folding_keeps_40_degrees_inside_its_knee) {
    TwoBone leg = bent_leg();
    float before = 0;
    for (float away = 0.7f; away > 0.02f; away -= 0.002f) {
        leg.target = leg.hip + normalized(leg.ankle - leg.hip) * away;
        const float asked = knee_of(leg, solve_two_bone(leg));
        leg.target = unfolded_target(leg, 1);
        const float knee = knee_of(leg, solve_two_bone(leg));
        EXPECT_GE(knee, k_least_fold);
        if (asked > k_soft_fold + 0.01f) {
            EXPECT_NEAR(knee, asked, 1e-4f);
        }
        if (before > 0) {
            EXPECT_LE(knee, before + 1e-5f);  // and it never turns back
        }
        before = knee;
    }
    EXPECT_LT(before, k_least_fold + 0.1f);
}

TEST(TwoBone, a_leg_that_the_clip_folds_farther_goes_where_it_is_asked_to) {
    TwoBone leg = bent_leg();
    leg.ankle = leg.hip + Vec3{0, -0.2f, 0};
    leg.knee = leg.hip + Vec3{0, -0.1f, 0.4f};
    for (const float further : {0.0f, -0.02f, 0.02f}) {
        leg.target = leg.ankle + Vec3{0, further, 0};
        EXPECT_LT(distance(unfolded_target(leg, 1), leg.target), 1e-6f);
    }
}

TEST(TwoBone, the_knee_stays_in_front) {
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        TwoBone leg = bent_leg();
        leg.target = leg.ankle + Vec3{0, 0.25f, 0} + random_vec(random, 0.1f);
        const TwoBoneResult r = solve_two_bone(leg);
        const Vec3 middle = (leg.hip + r.ankle) * 0.5f;
        EXPECT_GT((r.knee - middle).z, 0.05f);
    }
}

TEST(TwoBone, a_straight_leg_bends_towards_knee_forward) {
    TwoBone leg;
    leg.hip = {0, 1, 0};
    leg.knee = {0, 0.5f, 0};
    leg.ankle = {0, 0, 0};
    leg.knee_forward = {1, 0, 0};
    leg.target = {0, 0.2f, 0};
    EXPECT_GT(solve_two_bone(leg).knee.x, 0.2f);
}

TEST(TwoBone, the_knee_never_jumps_as_the_target_moves) {
    // Through the straight leg, past full stretch and back, and close by the hip.
    TwoBone leg = bent_leg();
    Vec3 last = solve_two_bone(leg).knee;
    for (int i = 0; i <= 4000; ++i) {
        const float t = static_cast<float>(i) / 4000;
        leg.target = leg.hip + Vec3{0.3f * sin(9 * t), -0.6f - 0.4f * sin(20 * t), 0.3f * sin(13 * t)};
        const Vec3 knee = solve_two_bone(leg).knee;
        if (i) {
            EXPECT_LT(distance(knee, last), 0.02f) << i;
        }
        last = knee;
    }
}

TEST(TwoBone, what_is_out_of_reach_is_pulled_in_softly_and_marked) {
    TwoBone leg = bent_leg();
    const float length = distance(leg.hip, leg.knee) + distance(leg.knee, leg.ankle);
    leg.target = leg.hip + Vec3{0, -3, 0};
    const TwoBoneResult r = solve_two_bone(leg);
    EXPECT_TRUE(r.pulled_in);
    EXPECT_LT(distance(leg.hip, r.ankle), length);
    EXPECT_GT(distance(leg.hip, r.ankle), 0.99f * length);
}

TEST(TwoBone, coincident_and_broken_input_gives_no_nan) {
    TwoBone leg;
    EXPECT_TRUE(is_finite(solve_two_bone(leg).upper));
    leg = bent_leg();
    leg.target = leg.hip;
    EXPECT_TRUE(is_finite(solve_two_bone(leg).knee));
    EXPECT_TRUE(is_finite(solve_two_bone(leg).lower));
    leg.knee = leg.hip;
    leg.target = {0, 0.3f, 0.2f};
    EXPECT_TRUE(is_finite(solve_two_bone(leg).upper));
    leg = bent_leg();
    leg.ankle = leg.hip;
    EXPECT_TRUE(is_finite(solve_two_bone(leg).upper));
    leg = bent_leg();
    leg.target.x = std::nanf("");
    EXPECT_TRUE(is_finite(solve_two_bone(leg).upper));
}

TEST(SoftLimit, is_smooth_and_never_reaches_full_length) {
    float last = soft_limit(0.9f, 1, 0.97f, 0);
    for (int i = 1; i < 1000; ++i) {
        const float d = 0.9f + 0.001f * static_cast<float>(i), limited = soft_limit(d, 1, 0.97f, 0);
        EXPECT_LT(limited, 1.0f);
        EXPECT_GE(limited, last);
        EXPECT_LT(limited - last, 0.00101f);
        last = limited;
    }
    EXPECT_FLOAT_EQ(soft_limit(0.96f, 1, 0.97f, 0), 0.96f);
    EXPECT_FLOAT_EQ(soft_limit(0.99f, 1, 0.97f, 0.995f), 0.99f);  // the clip's own stretch is left alone
}

// --- Colvin & Kajala 2013, §IV.B

TEST(Colvin2013, step2_lowers_the_root_just_enough) {
    const Vec3 hip{0, 1, 0}, target{0.3f, -0.1f, 0.2f};
    const float sink = colvin_step2_lower_root(hip, target, 0.9f);
    EXPECT_LT(sink, 0);
    EXPECT_NEAR(distance(hip + Vec3{0, sink, 0}, target), 0.9f, 1e-5f);
    EXPECT_EQ(colvin_step2_lower_root(hip, {0, 0.2f, 0}, 0.9f), 0);
    EXPECT_TRUE(std::isfinite(colvin_step2_lower_root(hip, {5, 0, 0}, 0.9f)));
}

TEST(Colvin2013, step3_is_the_law_of_cosines) {
    EXPECT_NEAR(colvin_step3_knee_angle(3, 4, 5), 0.5f * static_cast<float>(k_pi), 1e-6f);
    EXPECT_NEAR(colvin_step3_knee_angle(1, 1, 1), static_cast<float>(k_pi) / 3, 1e-6f);
    EXPECT_NEAR(colvin_step3_knee_angle(1, 1, 5), static_cast<float>(k_pi), 1e-3f);
}

TEST(Colvin2013, step3_poses_the_thigh_at_90_degrees_with_the_calf_hanging) {
    const ColvinLeg leg = colvin_step3_preset(0.4f, 0.4f, 0.5f * static_cast<float>(k_pi), {0, 0, 1});
    EXPECT_LT(distance(leg.knee, {0, 0, 0.4f}), 1e-6f);
    EXPECT_LT(distance(leg.ankle, {0, -0.4f, 0.4f}), 1e-6f);
}

TEST(Colvin2013, step4_turns_one_direction_onto_the_other) {
    const Vec3 posed{0, -0.4f, 0.4f}, target{0.2f, -0.6f, -0.1f};
    const Vec3 turned = rotate(colvin_step4_swing(posed, target), posed);
    EXPECT_LT(distance(normalized(turned), normalized(target)), 1e-5f);
}

TEST(Colvin2013, step4_is_unstable_for_opposite_vectors_and_the_preset_keeps_away_from_them) {
    // A leg posed straight up against a target straight below: a hair's difference turns the axis by 90 degrees.
    const Vec3 below{0, -1, 0};
    const Quat one = colvin_step4_swing({1e-4f, 1, 0}, below), other = colvin_step4_swing({0, 1, 1e-4f}, below);
    EXPECT_GT(rotation_angle(conjugate(one) * other), 1.5f);
    // With the thigh at 90 degrees the same hair does nothing.
    const ColvinLeg leg = colvin_step3_preset(0.4f, 0.4f, 2.8f, {0, 0, 1});
    const Quat a = colvin_step4_swing(leg.ankle + Vec3{1e-4f, 0, 0}, below),
               b = colvin_step4_swing(leg.ankle + Vec3{0, 0, 1e-4f}, below);
    EXPECT_LT(rotation_angle(conjugate(a) * b), 1e-3f);
}

TEST(Colvin2013, step5_finds_the_best_twist) {
    Random random(11);
    for (int i = 0; i < 200; ++i) {
        const Vec3 n = normalized(random_vec(random, 1));
        const Vec3 c = normalized(random_vec(random, 1)), a = normalized(random_vec(random, 1));
        const float best = colvin_step5_twist(n, c, a);
        const float reached = dot(rotate(axis_angle(n, best), c), a);
        for (float other = -3; other < 3; other += 0.1f)
            EXPECT_GE(reached, dot(rotate(axis_angle(n, other), c), a) - 1e-5f);
    }
}

TEST(Colvin2013, the_five_steps_reach_the_target_and_restore_the_knees_plane) {
    Random random(13);
    for (int i = 0; i < 500; ++i) {
        ColvinInput leg;
        leg.hip = {0.1f, 0.9f, 0};
        leg.knee = {0.13f, 0.48f, 0.06f};
        leg.ankle = {0.1f, 0.08f, -0.02f};
        leg.target = leg.ankle + Vec3{0, 0.1f, 0} + random_vec(random, 0.08f);
        const Vec3 thigh = normalized(leg.knee - leg.hip), off = leg.knee - leg.ankle;
        leg.upper_forward = normalized(off - thigh * dot(off, thigh));
        const TwoBoneResult r = solve_colvin(leg);
        EXPECT_LT(distance(r.ankle, leg.target), 2e-4f);
        EXPECT_LT(distance(leg.hip + rotate(r.upper, leg.knee - leg.hip), r.knee), 2e-4f);
        EXPECT_LT(distance(r.knee + rotate(r.lower, leg.ankle - leg.knee), r.ankle), 2e-4f);
        // The knee's plane stays within a few degrees of the animated one.
        const Vec3 before = normalized(cross(leg.knee - leg.hip, leg.ankle - leg.knee));
        const Vec3 after = normalized(cross(r.knee - leg.hip, r.ankle - r.knee));
        EXPECT_GT(dot(before, after), 0.9f);
    }
}

}  // namespace
}  // namespace surefoot
