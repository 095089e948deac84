#include <surefoot/base/random.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/harmonic/gait_style.h>
#include <tests/support/allocations.h>

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

/// Hips with two legs of a metre, standing on two feet without toes.
HarmonicGait legged_gait(int modes = 1) {
    Skeleton s;
    s.add("hips", k_no_joint, {{}, {0, 0.95f, 0}});
    Legs legs;
    legs.hips = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const std::string name = side == 0 ? "left_" : "right_";
        Leg& leg = legs.side[side];
        leg.upper = s.add(name + "upper", 0, {{}, {side == 0 ? 0.1f : -0.1f, 0, 0}});
        leg.lower = s.add(name + "lower", leg.upper, {{}, {0, -0.5f, 0}});
        leg.foot = s.add(name + "foot", leg.lower, {{}, {0, -0.5f, 0}});
        leg.upper_length = leg.lower_length = 0.5f;
        leg.heel = {0, -0.05f, -0.05f};
        leg.mid = {0, -0.05f, 0.02f};
        leg.ball = {0, -0.05f, 0.12f};
        leg.toe_tip = {0, -0.05f, 0.18f};
        leg.up = {0, 1, 0}, leg.forward = {0, 0, 1};
    }
    HarmonicGait gait;
    gait.name = "test";
    gait.skeleton = std::make_shared<const Skeleton>(s);
    gait.soles = legs;
    std::vector<Transform> models(s.rest.size());
    local_to_model(s, s.rest, models);
    gait.legs = make_leg_paths(s, legs, models);
    gait.harmonics = 3, gait.foot_harmonics = 4;
    gait.mean.assign(s.rest.size(), Quat{});
    gait.moving = {0};
    gait.basis.modes = modes;
    gait.basis.degree = modes - 1;
    const std::size_t count = static_cast<std::size_t>(value_count(gait));
    gait.coefficients.assign(count * static_cast<std::size_t>(gait.basis.terms()), 0.0f);
    for (int m = 0; m < modes; ++m) {
        float* v = gait.coefficients.data() + static_cast<std::size_t>(m * gait.basis.terms_of_mode()) * count;
        const std::size_t series = 7, foot = 9;
        v[gait.mean.size() * 3 * series + series] = 0.9f;  // the hips' height
        v[2] = 0.1f;                                       // and a nod
        for (std::size_t side = 0; side < 2; ++side) {
            float* f = v + (gait.mean.size() + 1) * 3 * series + side * k_foot_series * foot;
            const float x = side == 0 ? 0.1f : -0.1f;
            f[3 * foot] = x, f[5 * foot] = -0.05f;  // heel
            f[6 * foot] = x, f[8 * foot] = 0.12f;   // ball
        }
        float* rhythm = v + count - k_rhythm_values;
        rhythm[2] = 1, rhythm[4] = 1 + 0.3f * static_cast<float>(m), rhythm[5] = 0.47f, rhythm[6] = rhythm[7] = 0.5f;
    }
    return gait;
}

std::vector<float> values_of(const HarmonicGait& gait, float speed = 1, float turn = 0) {
    std::vector<float> values(static_cast<std::size_t>(value_count(gait)));
    values_at(gait, speed, turn, values);
    return values;
}

TEST(HarmonicGait, a_sound_gait_has_no_problem_and_broken_ones_are_named) {
    EXPECT_EQ(problem(legged_gait()), "");
    EXPECT_EQ(problem(legged_gait(2)), "");
    HarmonicGait short_one = legged_gait();
    short_one.coefficients.pop_back();
    EXPECT_NE(problem(short_one).find("number of coefficients"), std::string::npos);
    HarmonicGait wild = legged_gait();
    wild.coefficients[3] = std::nanf("");
    EXPECT_NE(problem(wild).find("no usable number"), std::string::npos);
    HarmonicGait loud = legged_gait();
    loud.harmonics = k_most_harmonics + 1;
    EXPECT_NE(problem(loud).find("harmonics"), std::string::npos);
    HarmonicGait endless = legged_gait(2);
    endless.basis.speed_unit[1] = 1e-30f;
    EXPECT_NE(problem(endless).find("fitted strides"), std::string::npos);
    HarmonicGait strange = legged_gait();
    strange.soles.hips = 77;
    EXPECT_NE(problem(strange).find("another skeleton"), std::string::npos);
    HarmonicGait flat = legged_gait();
    flat.mean[1] = {0, 0, 0, 0};
    EXPECT_NE(problem(flat).find("unit quaternion"), std::string::npos);
}

TEST(HarmonicGait, phase_and_time_undo_each_other_and_meet_at_the_strikes) {
    GaitRhythm rhythm;
    rhythm.right_strike = 0.43f;
    EXPECT_FLOAT_EQ(time_share(rhythm, 0.5f), 0.43f);
    EXPECT_FLOAT_EQ(phase_of(rhythm, 0.43f), 0.5f);
    for (float phase = -1.3f; phase < 2.5f; phase += 0.07f)
        EXPECT_NEAR(phase_of(rhythm, time_share(rhythm, phase)), phase, 1e-5f);
}

TEST(HarmonicGait, a_foots_series_maps_stance_to_stance) {
    EXPECT_FLOAT_EQ(foot_series_phase(0, 0.3f, 0.6f), 0);
    EXPECT_FLOAT_EQ(foot_series_phase(0.3f, 0.3f, 0.6f), 0.6f);
    EXPECT_FLOAT_EQ(foot_series_phase(0.65f, 0.3f, 0.6f), 0.8f);
}

TEST(HarmonicGait, a_series_is_the_sum_of_its_waves) {
    HarmonicGait gait = legged_gait();
    const std::size_t at = gait.mean.size() * 3 * 7;  // the hips' x
    for (std::size_t i = 0; i < 7; ++i) gait.coefficients[at + i] = 0.01f * static_cast<float>(i + 1);
    std::vector<Transform> locals(gait.mean.size());
    for (const double phase : {0.0, 0.13, 0.5, 0.77}) {
        pose(gait, gait.coefficients, static_cast<float>(phase), locals, {.feet = false});
        double sum = 0.01;
        for (int k = 1; k <= 3; ++k)
            sum += 0.01 * (2 * k) * cos(2 * k_pi * k * phase) + 0.01 * (2 * k + 1) * sin(2 * k_pi * k * phase);
        EXPECT_NEAR(locals[0].translation.x, sum, 1e-5) << phase;
    }
}

TEST(HarmonicGait, a_planted_foot_stands_still_while_the_root_travels_and_turns) {
    const HarmonicGait gait = legged_gait(2);
    std::vector<Transform> locals(gait.mean.size()), models(gait.mean.size());
    for (const float turn : {0.0f, 60.0f, -110.0f}) {
        const std::vector<float> values = values_of(gait, 0.6f, turn);
        const GaitRhythm rhythm = rhythm_of(gait, values);
        EXPECT_FLOAT_EQ(rhythm.velocity.z, 0.6f);
        Vec3 first;
        for (int i = 1; i < 20; ++i) {
            const float phase = 0.5f * rhythm.lift[0] * static_cast<float>(i) / 10;
            const float seconds = time_share(rhythm, phase) / rhythm.frequency;
            pose(gait, values, phase, locals);
            local_to_model(*gait.skeleton, locals, models);
            const Transform world = to_transform(integrate(rhythm.velocity, rhythm.turn_rate, seconds));
            const Vec3 ankle = transform_point(world, models[3].translation);
            if (i == 1) first = ankle;
            EXPECT_LT(distance(ankle, first), 1e-4f) << "turn " << turn << ", phase " << phase;
        }
    }
}

TEST(HarmonicGait, running_takes_over_without_a_step) {
    const HarmonicGait gait = legged_gait(2);
    EXPECT_EQ(share_of_running(gait.basis, 1.0f), 0);
    EXPECT_EQ(share_of_running(gait.basis, 3.0f), 1);
    float before = rhythm_of(gait, values_of(gait, 1.0f)).frequency;
    for (float speed = 1; speed < 3; speed += 0.01f) {
        const GaitRhythm rhythm = rhythm_of(gait, values_of(gait, speed));
        EXPECT_LT(std::fabs(rhythm.frequency - before), 0.01f) << speed;
        before = rhythm.frequency;
    }
    EXPECT_NEAR(before, 1.3f, 1e-3f);
}

TEST(HarmonicGait, evaluating_allocates_nothing) {
    const HarmonicGait gait = legged_gait(2);
    std::vector<float> values(static_cast<std::size_t>(value_count(gait)));
    std::vector<Transform> locals(gait.mean.size());
    const StyleBody body = make_style_body(gait);
    GaitStyle style;
    style.crouch = 0.1f;
    style[BodyPart::spine].lag = 0.1f;
    const long before = test::allocation_count();
    for (int i = 0; i < 100; ++i) {
        values_at(gait, 0.02f * static_cast<float>(i), 3 * static_cast<float>(i) - 150, values);
        apply_style(gait, body, style, values);
        apply_slope(gait, body, static_cast<float>(i) - 50, values);
        pose(gait, values, 0.01f * static_cast<float>(i), locals);
    }
    EXPECT_EQ(test::allocation_count(), before);
}

TEST(HarmonicGait, no_number_that_is_not_finite_comes_out_of_wild_coefficients) {
    Random random(5);
    HarmonicGait gait = legged_gait(2);
    for (float& value : gait.coefficients) value = random.between(-50, 50);
    ASSERT_EQ(problem(gait), "");
    std::vector<Transform> locals(gait.mean.size());
    for (int i = 0; i < 200; ++i) {
        const std::vector<float> values = values_of(gait, random.between(-2, 9), random.between(-400, 400));
        pose(gait, values, random.between(-3, 3), locals);
        for (const Transform& local : locals) {
            ASSERT_TRUE(is_finite(local.rotation));
            ASSERT_TRUE(is_finite(local.translation));
        }
    }
}

}  // namespace
}  // namespace surefoot
