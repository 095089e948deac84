#include <surefoot/space/blend_space.h>
#include <surefoot/space/triangulate.h>

#include <surefoot/base/random.h>

#include "tests/support/allocations.h"

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

/// Weight of every original sample.
std::vector<float> weight_by_sample(const BlendSpace& space, const BlendWeights& w) {
    std::vector<float> result(space.samples.size(), 0.0f);
    for (int n = 0; n < w.count; ++n) {
        EXPECT_EQ(space.original(w.samples[n]), w.samples[n]) << "a copy was named";
        EXPECT_EQ(result[w.samples[n]], 0) << "a sample was named twice";
        result[w.samples[n]] += w.weights[n];
    }
    return result;
}

float largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
    float worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
    return worst;
}

/// The jump that is left of the worst step along a path through the hull and outside it, when that step is halved
/// again and again on its worse side: nothing where weights are continuous, however fast slivers make them change.
float largest_jump(const BlendSpace& space) {
    std::int32_t hint = 0;
    const auto weights_at = [&](double t) {
        SpacePoint p{};
        for (int k = 0; k < space.dimensions(); ++k)
            p[k] = static_cast<float>((1.5 + k) * std::sin(6.28 * t * (1 + k) + k));
        const BlendWeights w = blend_weights(space, p, hint);
        hint = w.simplex;
        return weight_by_sample(space, w);
    };
    constexpr int k_steps = 5000;
    std::vector<float> before = weights_at(0);
    double from = 0, to = 0;
    float worst = 0;
    for (int step = 1; step <= k_steps; ++step) {
        const auto now = weights_at(static_cast<double>(step) / k_steps);
        if (const float jump = largest_difference(before, now); jump > worst) {
            worst = jump;
            from = static_cast<double>(step - 1) / k_steps;
            to = static_cast<double>(step) / k_steps;
        }
        before = now;
    }
    for (int n = 0; n < 12; ++n) {
        const double middle = 0.5 * (from + to);
        const auto a = weights_at(from), b = weights_at(middle), c = weights_at(to);
        const bool first = largest_difference(a, b) > largest_difference(b, c);
        worst = first ? largest_difference(a, b) : largest_difference(b, c);
        (first ? to : from) = middle;
    }
    return worst;
}

TEST(blend_space, weights_are_continuous_along_a_path_that_leaves_the_hull_and_comes_back) {
    for (int d = 1; d <= 4; ++d)
        for (std::uint64_t seed = 11; seed < 15; ++seed)
            for (const Weighting weighting : {Weighting::barycentric, Weighting::gradient_band,
                                              Weighting::gradient_band_polar, Weighting::axis_distance}) {
                Random random(seed);
                BlendSpace space = random_space(random, d, 16);
                space.weighting = weighting;
                EXPECT_LT(largest_jump(space), 2e-3f) << d << " " << static_cast<int>(weighting);
                if (weighting != Weighting::barycentric) continue;
                space.outside = Outside::extrapolate;
                EXPECT_LT(largest_jump(space), 2e-3f) << d << " extrapolated";
            }
}

TEST(blend_space, a_sample_asked_for_gets_all_the_weight) {
    Random random(12);
    for (int d = 1; d <= 4; ++d) {
        BlendSpace space = random_space(random, d, 15);
        for (const Weighting weighting : {Weighting::barycentric, Weighting::gradient_band,
                                          Weighting::gradient_band_polar, Weighting::axis_distance})
            for (std::size_t i = 0; i < space.samples.size(); ++i) {
                space.weighting = weighting;
                const BlendWeights w = blend_weights(space, space.samples[i]);
                float own = 0;
                for (int n = 0; n < w.count; ++n)
                    if (w.samples[n] == static_cast<std::int32_t>(i)) own = w.weights[n];
                EXPECT_NEAR(own, 1, 1e-4) << d << " " << static_cast<int>(weighting);
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

TEST(blend_space, a_wrapping_axis_blends_the_short_way_round) {
    BlendSpace space;
    space.axes = {{"heading", "deg", -180, 180, true}, {"speed", "m/s", 0, 2, false}};
    for (const float heading : {-120.0f, 0.0f, 120.0f})
        for (const float speed : {0.0f, 2.0f}) space.samples.push_back({heading, speed});
    add_wrap_copies(space);
    triangulate(space);
    ASSERT_EQ(problem(space), "");
    for (const float heading : {179.99f, -179.99f, 180.01f, 540.0f, -180.0f}) {
        const BlendWeights w = blend_weights(space, {heading, 1.0f});
        EXPECT_FALSE(w.clamped) << heading;
        const auto weight = weight_by_sample(space, w);
        EXPECT_NEAR(weight[0] + weight[1], 0.5f, 1e-3) << heading;  // between -120 and +120
        EXPECT_NEAR(weight[2] + weight[3], 0, 1e-3) << heading;
    }
}

TEST(blend_space, clips_on_one_side_of_a_circle_blend_round_the_other_side_too) {
    BlendSpace space;
    space.axes = {{"heading", "deg", -180, 180, true}};
    space.samples = {{-120}, {-60}};
    add_wrap_copies(space);
    triangulate(space);
    EXPECT_NEAR(weight_by_sample(space, blend_weights(space, {90}))[0], 0.5f, 1e-4);
    EXPECT_NEAR(weight_by_sample(space, blend_weights(space, {-180}))[0], 0.8f, 1e-4);
    EXPECT_NEAR(weight_by_sample(space, blend_weights(space, {179.999f}))[0], 0.8f, 1e-4);
    // A sample at the upper limit is the same place as one at the lower.
    BlendSpace ends = space;
    ends.samples = {{180}, {0}};
    add_wrap_copies(ends);
    triangulate(ends);
    EXPECT_EQ(blend_weights(ends, {-180}).samples[0], 0);
    EXPECT_EQ(blend_weights(ends, {-180}).count, 1);
}

/// Random samples of a space whose first axis, or first two, wrap.
BlendSpace random_ring(Random& random, int d, int wrapping, int count) {
    BlendSpace space;
    for (int k = 0; k < d; ++k) space.axes.push_back({"axis " + std::to_string(k), "", -180, 180, k < wrapping});
    for (int i = 0; i < count; ++i) {
        SpacePoint& p = space.samples.emplace_back();
        for (int k = 0; k < d; ++k) p[k] = random.between(-180, 180);
    }
    add_wrap_copies(space);
    triangulate(space);
    return space;
}

TEST(blend_space, weights_are_the_same_on_both_sides_of_the_seam_in_every_dimension_and_weighting) {
    for (int d = 1; d <= 4; ++d)
        for (const int wrapping : {1, 2}) {
            if (wrapping > d || (d == 4 && wrapping == 2)) continue;
            Random random(60 + d);
            for (int round = 0; round < (d < 4 ? 8 : 2); ++round) {
                BlendSpace space = random_ring(random, d, wrapping, 2 + d + static_cast<int>(random.below(6)));
                ASSERT_EQ(problem(space), "");
                for (const Weighting weighting : {Weighting::barycentric, Weighting::gradient_band,
                                                  Weighting::gradient_band_polar, Weighting::axis_distance}) {
                    space.weighting = weighting;
                    for (int n = 0; n < 40; ++n) {
                        SpacePoint p{};
                        for (int k = 0; k < d; ++k) p[k] = random.between(-150, 150);
                        const int axis = static_cast<int>(random.below(static_cast<std::uint32_t>(wrapping)));
                        p[axis] = 179.9999f;
                        const auto below = weight_by_sample(space, blend_weights(space, p));
                        p[axis] = -179.9999f;
                        const auto above = weight_by_sample(space, blend_weights(space, p));
                        EXPECT_LT(largest_difference(below, above), 2e-3f) << d << " " << static_cast<int>(weighting);
                    }
                }
            }
        }
}

TEST(blend_space, going_round_a_wrapping_axis_changes_weights_smoothly_and_comes_home) {
    Random random(77);
    for (int d = 1; d <= 3; ++d) {
        const BlendSpace space = random_ring(random, d, 1, 8);
        std::vector<float> first, before;
        std::int32_t hint = 0;
        constexpr int k_steps = 36000;
        for (int step = 0; step <= k_steps; ++step) {
            const BlendWeights w = blend_weights(space, {-360 + 0.02f * static_cast<float>(step), 20, -30}, hint);
            hint = w.simplex;
            const auto now = weight_by_sample(space, w);
            if (step == 0) first = now;
            if (step > 0) {
                ASSERT_LT(largest_difference(now, before), 0.05f) << d << " at " << step;
            }
            before = now;
        }
        EXPECT_LT(largest_difference(first, before), 1e-3f);
    }
}

BlendSpace extrapolating(BlendSpace space, float bound) {
    space.outside = Outside::extrapolate;
    space.extrapolation_bound = bound;
    return space;
}

TEST(blend_space, extrapolation_continues_the_last_segment_up_to_the_bound) {
    const BlendSpace space = extrapolating(make_space(1, {{-1}, {0}, {0.5f}}), 0.25f);
    const BlendWeights beyond = blend_weights(space, {0.6f});
    ASSERT_EQ(beyond.count, 2);
    EXPECT_FALSE(beyond.clamped);
    const auto weight = weight_by_sample(space, beyond);
    EXPECT_NEAR(weight[2], 1.2f, 1e-5);
    EXPECT_NEAR(weight[1], -0.2f, 1e-5);
    for (const float far : {0.7f, 0.9f, 40.0f}) {
        const BlendWeights bounded = blend_weights(space, {far});
        EXPECT_TRUE(bounded.clamped);
        EXPECT_NEAR(bounded.point[0], 0.625f, 1e-5);
        EXPECT_NEAR(weight_by_sample(space, bounded)[2], 1.25f, 1e-5);
    }
    EXPECT_FALSE(blend_weights(space, {0.3f}).clamped);
    EXPECT_NEAR(blend_weights(space, {0.3f}).weights[0], 0.4f, 1e-5);  // inside nothing changes
}

TEST(blend_space, extrapolated_weights_add_up_to_one_reproduce_their_point_and_keep_the_bound) {
    for (int d = 1; d <= 4; ++d) {
        Random random(80 + d);
        int reached = 0, bounded = 0;
        for (int round = 0; round < 30; ++round) {
            const float bound = random.between(0, 1);
            const BlendSpace space =
                extrapolating(random_space(random, d, d + 2 + static_cast<int>(random.below(20))), bound);
            ASSERT_EQ(problem(space), "");
            for (int n = 0; n < 50; ++n) {
                SpacePoint p{};
                for (int k = 0; k < d; ++k) p[k] = random.between(-2.0f - k, 2.0f + k);
                const BlendWeights w = blend_weights(space, p), inside = [&] {
                    BlendSpace clamping = space;
                    clamping.outside = Outside::clamp;
                    return blend_weights(clamping, p);
                }();
                float sum = 0;
                ASSERT_LE(w.count, k_max_blend_weights);
                for (int i = 0; i < w.count; ++i) {
                    sum += w.weights[i];
                    ASSERT_GE(w.weights[i], -bound - 1e-5f);
                    ASSERT_LE(w.weights[i], 1 + bound + 1e-5f);
                }
                ASSERT_NEAR(sum, 1, 1e-5);
                EXPECT_LT(scaled_distance(space, blend_of(space, w), w.point), 1e-4);
                if (!w.clamped) {
                    EXPECT_LT(scaled_distance(space, w.point, p), 2e-6);
                }
                if (inside.clamped) {
                    EXPECT_LE(scaled_distance(space, w.point, p), scaled_distance(space, inside.point, p) + 1e-5);
                    (w.clamped ? bounded : reached) += 1;
                }
            }
        }
        EXPECT_GT(bounded, 20) << d;
        EXPECT_GT(reached, 20) << d;
    }
}

TEST(blend_space, no_weighting_allocates) {
    Random random(14);
    BlendSpace space = extrapolating(random_space(random, 4, 30), 0.5f);
    const long before = test::allocation_count();
    float sum = 0;
    for (const Weighting weighting :
         {Weighting::barycentric, Weighting::gradient_band, Weighting::gradient_band_polar, Weighting::axis_distance}) {
        space.weighting = weighting;
        for (const float x : {0.1f, 5.0f}) sum += blend_weights(space, {x, -x, x, x}).weights[0];
    }
    EXPECT_EQ(test::allocation_count(), before);
    EXPECT_NE(sum, 0);
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
    bad.extrapolation_bound = std::nanf("");
    EXPECT_NE(problem(bad).find("bound"), std::string::npos);
    bad = space;
    bad.copy_of = {0, 1, 2, 17};
    EXPECT_NE(problem(bad).find("sample 3 is a copy"), std::string::npos);
    bad = space;
    bad.axes.clear();
    EXPECT_NE(problem(bad).find("1 to 4 axes"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
