#include <surefoot/math/trig.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

TEST(Trig, sin_cos_gives_the_bits_of_sin_and_cos) {
    for (int i = -4000; i <= 4000; ++i) {
        const double x = i * 0.0317;
        EXPECT_EQ(surefoot::sin_cos(x).sin, surefoot::sin(x)) << x;
        EXPECT_EQ(surefoot::sin_cos(x).cos, surefoot::cos(x)) << x;
    }
}

TEST(Trig, tiny_angles_are_their_sine) {
    constexpr double k_edge = 0x1p-27;  // below it nothing is computed
    for (const double x : {0.0, 1e-300, 1e-9, 0.999 * k_edge, k_edge, 1.001 * k_edge})
        for (const double signed_x : {x, -x}) {
            EXPECT_EQ(surefoot::sin(signed_x), signed_x) << x;
            EXPECT_EQ(surefoot::cos(signed_x), 1.0) << x;
            EXPECT_EQ(surefoot::sin_cos(signed_x).sin, signed_x) << x;
            EXPECT_EQ(surefoot::sin_cos(signed_x).cos, 1.0) << x;
        }
    EXPECT_FALSE(std::signbit(surefoot::sin(-0.0)));
    // What the oscillators count on: a small float is its sine, to the last bit.
    for (float x = 1e-7f; x < 3e-4f; x *= 1.01f) EXPECT_EQ(surefoot::sin(x), x);
}

TEST(Trig, sine_and_cosine_match_the_library_to_a_few_ulp) {
    for (double x = -50; x < 50; x += 0.00731) {
        EXPECT_NEAR(surefoot::sin(x), std::sin(x), 4e-16) << x;
        EXPECT_NEAR(surefoot::cos(x), std::cos(x), 4e-16) << x;
    }
    EXPECT_NEAR(surefoot::sin(12345.678), std::sin(12345.678), 1e-12);
}

TEST(Trig, arcs_match_the_library_in_every_quadrant) {
    for (double y = -2; y <= 2; y += 0.0173)
        for (double x = -2; x <= 2; x += 0.0191)
            EXPECT_NEAR(surefoot::atan2(y, x), std::atan2(y, x), 1e-15) << y << " " << x;
    for (double x = -1; x <= 1; x += 0.001) {
        EXPECT_NEAR(surefoot::asin(x), std::asin(x), 1e-15) << x;
        EXPECT_NEAR(surefoot::acos(x), std::acos(x), 1e-15) << x;
    }
    EXPECT_EQ(surefoot::atan2(0.0, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(surefoot::atan2(0.0, -1.0), surefoot::k_pi);
    EXPECT_DOUBLE_EQ(surefoot::atan2(-0.0, -1.0), -surefoot::k_pi);
}

TEST(Trig, arcs_of_arguments_beyond_one_are_clamped) {
    EXPECT_DOUBLE_EQ(surefoot::acos(1.0000001), 0.0);
    EXPECT_DOUBLE_EQ(surefoot::asin(-1.5), -surefoot::k_pi / 2);
}

TEST(Trig, exponential_and_logarithm_match_the_library) {
    for (double x = -30; x < 30; x += 0.0173) EXPECT_NEAR(surefoot::exp(x) / std::exp(x), 1.0, 1e-15) << x;
    for (double x = 1e-6; x < 1e6; x *= 1.013) EXPECT_NEAR(surefoot::log(x), std::log(x), 4e-15) << x;
    EXPECT_EQ(surefoot::exp(-1000.0), 0.0);
}

TEST(Trig, wrapped_angles_lie_in_one_turn) {
    EXPECT_NEAR(surefoot::wrap_angle(3 * surefoot::k_pi), surefoot::k_pi, 1e-12);
    EXPECT_NEAR(surefoot::wrap_angle(-0.5), -0.5, 1e-15);
    EXPECT_NEAR(surefoot::wrap_angle(6.5), 6.5 - 2 * surefoot::k_pi, 1e-12);
}

}  // namespace
