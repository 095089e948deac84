#include <surefoot/fit/ridge.h>

#include <gtest/gtest.h>

#include <array>

namespace surefoot {
namespace {

TEST(Ridge, gives_a_polynomial_back_through_its_points) {
    RidgeProblem problem(3, 2);
    for (const float x : {-1.0f, -0.3f, 0.4f, 1.2f, 2.0f})
        problem.add_sample(std::array{1.0f, x, x * x}, std::array{2 - x + 0.5f * x * x, 3 * x}, x < 0 ? 1 : 7);
    const std::vector<float> c = problem.solve();
    const std::array<float, 6> wanted{2, 0, -1, 3, 0.5f, 0};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(c[i], wanted[i], 1e-5f) << i;
}

TEST(Ridge, a_penalty_pulls_to_zero_by_the_known_amount) {
    RidgeProblem problem(1, 1);
    for (int i = 0; i < 4; ++i) problem.add_sample(std::array{1.0f}, std::array{10.0f}, 1);
    problem.add_penalty({{0, 1.0}}, 1);
    EXPECT_NEAR(problem.solve()[0], 40.0f / 5, 1e-5f);
}

TEST(Ridge, what_nothing_speaks_of_is_zero) {
    RidgeProblem problem(2, 1);
    problem.add_sample(std::array{1.0f, 0.0f}, std::array{3.0f}, 1);
    EXPECT_NEAR(problem.solve()[0], 3, 1e-6f);
    EXPECT_EQ(problem.solve()[1], 0);
}

}  // namespace
}  // namespace surefoot
