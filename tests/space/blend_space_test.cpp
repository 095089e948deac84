#include <surefoot/space/blend_space.h>
#include <surefoot/space/triangulate.h>

#include <surefoot/base/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

BlendSpace make_space(int d, std::vector<SpacePoint> samples) {
    BlendSpace space;
    for (int k = 0; k < d; ++k) space.axes.push_back({"axis " + std::to_string(k), "", -1.0f - k, 1.0f + k, false});
    space.samples = std::move(samples);
    triangulate(space);
    return space;
}

BlendSpace random_space(Random& random, int d, int count) {
    std::vector<SpacePoint> samples(count);
    for (SpacePoint& p : samples)
        for (int k = 0; k < d; ++k) p[k] = random.between(-1.0f - k, 1.0f + k);
    return make_space(d, samples);
}

SpacePoint blend_of(const BlendSpace& space, const BlendWeights& w) {
    SpacePoint sum{};
    for (int n = 0; n < w.count; ++n)
        for (int k = 0; k < space.dimensions(); ++k) sum[k] += w.weights[n] * space.samples[w.samples[n]][k];
    return sum;
}

double scaled_distance(const BlendSpace& space, const SpacePoint& a, const SpacePoint& b) {
    double square = 0;
    for (int k = 0; k < space.dimensions(); ++k) {
        const double delta = (double{a[k]} - b[k]) / (double{space.axes[k].high} - space.axes[k].low);
        square += delta * delta;
    }
    return std::sqrt(square);
}

void expect_sound(const BlendSpace& space, const BlendWeights& w) {
    ASSERT_GE(w.count, 1);
    ASSERT_LE(w.count, space.dimensions() + 1);
    float sum = 0;
    for (int n = 0; n < w.count; ++n) {
        ASSERT_GT(w.weights[n], 0);
        ASSERT_GE(w.samples[n], 0);
        ASSERT_LT(w.samples[n], static_cast<int>(space.samples.size()));
        sum += w.weights[n];
    }
    ASSERT_NEAR(sum, 1, 1e-5);
}

/// Distance to the hull without any triangulation: Frank-Wolfe steps with exact line search towards it.
double slow_distance_to_hull(const BlendSpace& space, const SpacePoint& p) {
    const int d = space.dimensions();
    std::vector<double> x(d);
    for (int k = 0; k < d; ++k) x[k] = space.samples[0][k];
    const auto scale = [&](int k) { return 1.0 / (double{space.axes[k].high} - space.axes[k].low); };
    for (int step = 0; step < 20000; ++step) {
        double best = 1e300;
        const SpacePoint* towards = nullptr;
        for (const SpacePoint& s : space.samples) {
            double slope = 0;
            for (int k = 0; k < d; ++k) slope += (x[k] - p[k]) * (s[k] - x[k]) * scale(k) * scale(k);
            if (slope < best) best = slope, towards = &s;
        }
        double length = 0;
        for (int k = 0; k < d; ++k) length += std::pow(((*towards)[k] - x[k]) * scale(k), 2);
        if (best > -1e-13 || length == 0) break;
        const double t = std::min(1.0, -best / length);
        for (int k = 0; k < d; ++k) x[k] += t * ((*towards)[k] - x[k]);
    }
    double square = 0;
    for (int k = 0; k < d; ++k) square += std::pow((x[k] - p[k]) * scale(k), 2);
    return std::sqrt(square);
}

TEST(blend_space, weights_inside_add_up_to_one_and_reproduce_the_point) {
    for (int d = 1; d <= 4; ++d) {
        Random random(d);
        for (int round = 0; round < 30; ++round) {
            const BlendSpace space = random_space(random, d, d + 2 + static_cast<int>(random.below(20)));
            ASSERT_EQ(problem(space), "");
            std::int32_t hint = 0;
            for (int n = 0; n < 50; ++n) {
                SpacePoint p{};
                for (int k = 0; k < d; ++k) p[k] = random.between(-1.3f - k, 1.3f + k);
                const BlendWeights w = blend_weights(space, p, hint);
                expect_sound(space, w);
                hint = w.simplex;
                EXPECT_LT(scaled_distance(space, blend_of(space, w), w.point), 1e-5);
                if (!w.clamped) {
                    EXPECT_LT(scaled_distance(space, w.point, p), 1e-6);
                }
            }
        }
    }
}

TEST(blend_space, outside_the_hull_it_clamps_to_the_nearest_boundary_point) {
    for (int d = 1; d <= 4; ++d) {
        Random random(50 + d);
        int outside = 0;
        for (int round = 0; round < 10; ++round) {
            const BlendSpace space = random_space(random, d, d + 2 + static_cast<int>(random.below(12)));
            for (int n = 0; n < 20; ++n) {
                SpacePoint p{};
                for (int k = 0; k < d; ++k) p[k] = random.between(-3.0f - k, 3.0f + k);
                const BlendWeights w = blend_weights(space, p);
                if (!w.clamped) continue;
                ++outside;
                EXPECT_NEAR(scaled_distance(space, w.point, p), slow_distance_to_hull(space, p), 2e-3) << d;
            }
        }
        EXPECT_GT(outside, 50) << d;
    }
}

TEST(blend_space, the_answer_does_not_depend_on_the_hint) {
    Random random(9);
    for (int d = 1; d <= 4; ++d) {
        const BlendSpace space = random_space(random, d, 18);
        for (int n = 0; n < 100; ++n) {
            SpacePoint p{};
            for (int k = 0; k < d; ++k) p[k] = random.between(-1.5f - k, 1.5f + k);
            const BlendWeights one = blend_weights(space, p, 0);
            const auto last = static_cast<std::int32_t>(space.simplices.size()) - 1;
            for (const std::int32_t hint : {last, last / 2, -7, 1 << 30}) {
                const BlendWeights other = blend_weights(space, p, hint);
                EXPECT_LT(scaled_distance(space, one.point, other.point), 1e-5);
                EXPECT_EQ(one.clamped, other.clamped);
            }
        }
    }
}

TEST(blend_space, weights_are_continuous_along_a_path_that_leaves_the_hull_and_comes_back) {
    Random random(11);
    for (int d = 1; d <= 4; ++d) {
        const BlendSpace space = random_space(random, d, 16);
        std::vector<float> before;
        std::int32_t hint = 0;
        constexpr int k_steps = 20000;
        float worst = 0;
        for (int step = 0; step <= k_steps; ++step) {
            const float t = static_cast<float>(step) / k_steps;
            SpacePoint p{};
            for (int k = 0; k < d; ++k) p[k] = (1.5f + k) * std::sin(6.28f * t * (1 + k) + k);
            const BlendWeights w = blend_weights(space, p, hint);
            hint = w.simplex;
            std::vector<float> now(space.samples.size(), 0.0f);
            for (int n = 0; n < w.count; ++n) now[w.samples[n]] += w.weights[n];
            for (std::size_t i = 0; i < now.size() && step > 0; ++i)
                worst = std::max(worst, std::fabs(now[i] - before[i]));
            before = now;
        }
        // Weights change by at most (speed of the point) / (thinnest simplex): far below a jump from 0 to 1.
        EXPECT_LT(worst, 0.2f) << d;
    }
}

TEST(blend_space, a_sample_asked_for_gets_all_the_weight) {
    Random random(12);
    for (int d = 1; d <= 4; ++d) {
        const BlendSpace space = random_space(random, d, 15);
        for (std::size_t i = 0; i < space.samples.size(); ++i) {
            const BlendWeights w = blend_weights(space, space.samples[i]);
            float own = 0;
            for (int n = 0; n < w.count; ++n)
                if (w.samples[n] == static_cast<std::int32_t>(i)) own = w.weights[n];
            EXPECT_NEAR(own, 1, 1e-4) << d;
        }
    }
}

TEST(blend_space, samples_on_a_slanted_line_blend_along_it) {
    const BlendSpace space = make_space(2, {{-1, -1}, {0, 0}, {1, 1}});
    ASSERT_EQ(space.simplices.size(), 2u);
    const BlendWeights on = blend_weights(space, {0.5f, 0.5f});
    EXPECT_FALSE(on.clamped && scaled_distance(space, on.point, {0.5f, 0.5f}) > 1e-6);
    ASSERT_EQ(on.count, 2);
    EXPECT_NEAR(on.weights[0], 0.5f, 1e-6);
    const BlendWeights beyond = blend_weights(space, {5, 5});
    ASSERT_EQ(beyond.count, 1);
    EXPECT_EQ(beyond.samples[0], 2);
}

TEST(blend_space, one_sample_answers_everything) {
    const BlendSpace space = make_space(2, {{0.5f, 0.25f}});
    const BlendWeights w = blend_weights(space, {-9, 9});
    ASSERT_EQ(w.count, 1);
    EXPECT_EQ(w.samples[0], 0);
    EXPECT_EQ(w.point[0], 0.5f);
}

TEST(blend_space, numbers_that_are_not_finite_still_get_an_answer) {
    Random random(13);
    const float nan = std::nanf(""), infinity = INFINITY;
    for (int d = 1; d <= 4; ++d) {
        const BlendSpace space = random_space(random, d, 12);
        for (const float bad : {nan, infinity, -infinity, 1e38f, -1e38f}) {
            const BlendWeights w = blend_weights(space, {bad, bad, bad, bad});
            expect_sound(space, w);
            EXPECT_TRUE(std::isfinite(w.point[0]));
        }
    }
}

TEST(blend_space, a_wrapping_axis_has_no_seam) {
    BlendSpace space;
    space.axes = {{"heading", "deg", -180, 180, true}, {"speed", "m/s", 0, 2, false}};
    for (const float heading : {-120.0f, 0.0f, 120.0f})
        for (const float speed : {0.0f, 2.0f}) space.samples.push_back({heading, speed});
    const auto original = add_wrap_copies(space);
    triangulate(space);
    ASSERT_EQ(problem(space), "");
    const auto weights_of = [&](float heading) {
        const BlendWeights w = blend_weights(space, {heading, 1.0f});
        EXPECT_FALSE(w.clamped) << heading;
        std::vector<float> sum(6, 0.0f);
        for (int n = 0; n < w.count; ++n) sum[original[w.samples[n]]] += w.weights[n];
        return sum;
    };
    const auto left = weights_of(179.99f), right = weights_of(-179.99f), again = weights_of(180.01f);
    for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(left[i], right[i], 1e-3) << i;
        EXPECT_NEAR(right[i], again[i], 1e-3) << i;
    }
    EXPECT_NEAR(left[0] + left[1], 0.5f, 1e-3);  // between -120 and +120 the short way round
    EXPECT_NEAR(left[2] + left[3], 0, 1e-3);
}

TEST(blend_space, problems_are_named) {
    BlendSpace space = make_space(2, {{0, 0}, {1, 0}, {0, 1}, {1, 1}});
    EXPECT_EQ(problem(space), "");
    BlendSpace bad = space;
    bad.samples[1][0] = std::nanf("");
    EXPECT_NE(problem(bad).find("sample 1"), std::string::npos);
    bad = space;
    bad.axes[0].high = bad.axes[0].low;
    EXPECT_NE(problem(bad).find("axis 0"), std::string::npos);
    bad = space;
    bad.simplices[1][0] = 17;
    EXPECT_NE(problem(bad).find("does not exist"), std::string::npos);
    bad = space;
    bad.neighbours[0] = {-1, -1, -1, -1, -1};
    EXPECT_NE(problem(bad).find("other way round"), std::string::npos);
    bad = space;
    bad.axes.clear();
    EXPECT_NE(problem(bad).find("1 to 4 axes"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
