#include <surefoot/ik/hips.h>

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

TEST(FootholdLine, is_a_polyline_held_at_its_ends) {
    FootholdLine line;
    line.add({1.0, 0.2f});
    line.add({2.0, 0.4f});
    line.add({1.5, 0.6f});
    EXPECT_FLOAT_EQ(line.at(0), 0.2f);
    EXPECT_FLOAT_EQ(line.at(1.25), 0.4f);
    EXPECT_FLOAT_EQ(line.at(1.75), 0.5f);
    EXPECT_FLOAT_EQ(line.at(9), 0.4f);
    line.keep_past(1.6);
    EXPECT_EQ(line.count, 2);
    EXPECT_FLOAT_EQ(line.at(9), 0.6f);
}

TEST(FootholdLine, never_overflows) {
    FootholdLine line;
    for (int i = 0; i < 50; ++i) line.add({0.2 * i, static_cast<float>(i)});
    EXPECT_EQ(line.count, FootholdLine::k_capacity);
    EXPECT_FLOAT_EQ(line.at(100), 49);
}

TEST(HeightSpring, settles_without_overshoot_and_alike_at_any_frame_rate) {
    HeightSpring fast, slow;
    for (int i = 0; i < 240; ++i) {
        fast.step(1, 8, 1.0f / 120);
        EXPECT_LE(fast.value, 1.0f + 1e-5f);
    }
    for (int i = 0; i < 60; ++i) slow.step(1, 8, 1.0f / 30);
    EXPECT_NEAR(fast.value, slow.value, 1e-4f);
    EXPECT_NEAR(fast.value, 1, 1e-4f);
}

TEST(HeightRest, goes_on_from_position_velocity_and_acceleration_and_fades_alike_at_any_frame_rate) {
    constexpr float k_moment = 5e-4f;
    const HeightRest jump{0.1f, -0.4f, 3};
    HeightRest soon = jump, fast = jump, slow = jump;
    soon.step(12, k_moment);
    EXPECT_NEAR((soon.value - jump.value) / k_moment, jump.rate, 3e-3f);
    EXPECT_NEAR((soon.rate - jump.rate) / k_moment, jump.acceleration, 0.1f);
    EXPECT_NEAR(soon.acceleration, jump.acceleration, 0.1f);
    for (int i = 0; i < 24; ++i) fast.step(12, 1.0f / 120);
    for (int i = 0; i < 6; ++i) slow.step(12, 1.0f / 30);
    EXPECT_NEAR(fast.value, slow.value, 1e-6f);
    EXPECT_NEAR(fast.rate, slow.rate, 1e-5f);
    EXPECT_NEAR(fast.acceleration, slow.acceleration, 1e-4f);
    for (int i = 0; i < 120; ++i) fast.step(12, 1.0f / 120);
    EXPECT_NEAR(fast.value, 0, 1e-4f);
}

TEST(HipLimiter, stays_below_the_shortfall_and_is_smooth) {
    HipLimiter limiter;
    limiter.fill(0, 0);
    const auto shortfall = [](double t) { return t > 1.1 && t < 1.25 ? -0.08f : t > 1.9 && t < 1.93 ? -0.05f : 0.0f; };
    double last = 0, last_step = 0, worst_bend = 0;
    std::int64_t filled = 0;
    for (int frame = 0; frame < 300; ++frame) {
        const double t = frame / 120.0;
        for (; filled < static_cast<std::int64_t>(t * HipLimiter::k_rate) + 30; ++filled) {
            float least = 0;
            for (int i = -4; i <= 4; ++i)
                least = std::fmin(least, shortfall((static_cast<double>(filled) + i * 0.25) / HipLimiter::k_rate));
            limiter.set(filled, least);
        }
        const double e = static_cast<double>(limiter.at(t));
        EXPECT_LE(e, static_cast<double>(shortfall(t)) + 1e-6) << t;
        const double step = e - last;
        if (frame > 1) worst_bend = std::fmax(worst_bend, std::fabs(step - last_step) * 120 * 120);
        last = e;
        last_step = step;
    }
    EXPECT_LT(worst_bend, 12);  // m/s^2: 8 cm given way over a third of a second
    EXPECT_NEAR(limiter.at(0.5), 0, 1e-7);
}

}  // namespace
}  // namespace surefoot
