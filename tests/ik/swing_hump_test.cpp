#include <surefoot/ik/swing_hump.h>

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

constexpr float k_nothing = -1e3f;

HumpTask task_without_needs() {
    HumpTask task;
    task.need.fill(k_nothing);
    return task;
}
float share(int i) { return static_cast<float>(i) / (k_hump_samples - 1); }

TEST(SwingHump, nothing_needed_over_a_straight_base_is_no_hump_at_all) {
    const SwingSolver solver;
    const Hump flat = solver.solve(task_without_needs());
    for (int i = 0; i <= 100; ++i) EXPECT_EQ(flat.at(0.01f * static_cast<float>(i)), 0);
    HumpTask met = task_without_needs();
    met.need.fill(0);
    for (const float c : solver.solve(met).coefficients) EXPECT_EQ(c, 0);
}

TEST(SwingHump, it_clears_what_it_must_and_little_more) {
    HumpTask task = task_without_needs();
    for (int i = 10; i <= 14; ++i) task.need[static_cast<std::size_t>(i)] = 0.1f;
    const Hump hump = SwingSolver().solve(task);
    float highest = 0;
    for (int i = 0; i < k_hump_samples; ++i) {
        EXPECT_GT(hump.at(share(i)), task.need[static_cast<std::size_t>(i)] - 0.002f);
        highest = std::fmax(highest, hump.at(share(i)));
    }
    EXPECT_LT(highest, 0.125f);
}

TEST(SwingHump, at_its_samples_it_is_what_it_is_there) {
    HumpTask task = task_without_needs();
    task.start_value = 0.03f;
    task.need[12] = 0.2f;
    const Hump hump = SwingSolver().solve(task);
    const std::array<float, k_hump_samples> samples = hump.at_samples();
    for (int i = 0; i < k_hump_samples; ++i) EXPECT_EQ(samples[static_cast<std::size_t>(i)], hump.at(share(i))) << i;
}

TEST(SwingHump, it_starts_as_told_and_ends_at_zero_without_slope) {
    HumpTask task = task_without_needs();
    task.start_value = 0.03f;
    task.start_slope = -0.1f;
    task.need[20] = 0.05f;
    const Hump hump = SwingSolver().solve(task);
    EXPECT_NEAR(hump.at(0), 0.03f, 1e-6f);
    EXPECT_NEAR(hump.slope(0), -0.1f, 1e-5f);
    EXPECT_NEAR(hump.at(0.99999f), 0, 1e-5f);
    EXPECT_NEAR(hump.slope(0.99999f), 0, 1e-3f);
    // The slope is the derivative.
    for (float s = 0.05f; s < 0.95f; s += 0.1f)
        EXPECT_NEAR((hump.at(s + 1e-3f) - hump.at(s - 1e-3f)) / 2e-3f, hump.slope(s), 2e-3f);
}

TEST(SwingHump, it_smooths_a_bent_base) {
    // A base that climbs within the middle 40 % only: the sum takes the whole swing.
    HumpTask task = task_without_needs();
    for (int i = 0; i < k_hump_samples + 2; ++i) {
        const float x = std::fmin(std::fmax((static_cast<float>(i) / 30 - 0.3f) / 0.4f, 0.0f), 1.0f);
        task.base[static_cast<std::size_t>(i)] = 0.2f * x * x * (3 - 2 * x);
    }
    const Hump hump = SwingSolver().solve(task);
    const auto worst = [&](bool with) {
        float result = 0;
        for (int i = 1; i + 1 < k_hump_samples; ++i) {
            const auto sum = [&](int j) {
                return task.base[static_cast<std::size_t>(j + 1)] + (with ? hump.at(share(j)) : 0.0f);
            };
            result = std::fmax(result, std::fabs(sum(i - 1) - 2 * sum(i) + sum(i + 1)));
        }
        return result;
    };
    EXPECT_LT(worst(true), 0.5f * worst(false));
}

TEST(SwingHump, impossible_needs_at_the_ends_stay_finite_and_bounded) {
    HumpTask task = task_without_needs();
    task.need[1] = task.need[27] = 0.5f;
    const Hump hump = SwingSolver().solve(task);
    for (int i = 0; i < k_hump_samples; ++i) EXPECT_LT(std::fabs(hump.at(share(i))), 30.0f);
}

}  // namespace
}  // namespace surefoot
