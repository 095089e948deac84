// Gradient bands and axis distance: what blend_space_test.cpp does not ask of every weighting.

#include <surefoot/base/random.h>
#include <surefoot/math/trig.h>
#include <surefoot/space/triangulate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace surefoot {
namespace {

BlendSpace make_space(std::vector<Axis> axes, std::vector<SpacePoint> samples, Weighting weighting) {
    BlendSpace space;
    space.axes = std::move(axes);
    space.samples = std::move(samples);
    space.weighting = weighting;
    add_wrap_copies(space);
    triangulate(space);
    return space;
}

std::vector<Axis> velocity_axes() { return {{"forward", "m/s", -2, 2, false}, {"lateral", "m/s", -2, 2, false}}; }

/// Idle, and clips in eight directions.
BlendSpace compass(Weighting weighting) {
    std::vector<SpacePoint> samples{{0, 0}};
    for (int n = 0; n < 8; ++n) {
        const float angle = static_cast<float>(n * k_pi / 4);
        samples.push_back({1.5f * cos(angle), 1.5f * sin(angle)});
    }
    return make_space(velocity_axes(), samples, weighting);
}

std::map<int, float> weights_at(const BlendSpace& space, const SpacePoint& p) {
    const BlendWeights w = blend_weights(space, p);
    std::map<int, float> result;
    float sum = 0;
    for (int n = 0; n < w.count; ++n) {
        EXPECT_GT(w.weights[n], 0);
        EXPECT_TRUE(result.emplace(w.samples[n], w.weights[n]).second);
        sum += w.weights[n];
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    return result;
}

constexpr Weighting k_all[] = {Weighting::gradient_band, Weighting::gradient_band_polar, Weighting::axis_distance};

TEST(influence, two_samples_share_the_way_between_them_linearly_in_gradient_bands) {
    const BlendSpace space = make_space({{"speed", "m/s", 0, 4, false}}, {{0}, {1}, {4}}, Weighting::gradient_band);
    const auto w = weights_at(space, {1.75f});
    ASSERT_EQ(w.size(), 2u);
    EXPECT_NEAR(w.at(1), 0.75f, 1e-6);
    EXPECT_NEAR(w.at(2), 0.25f, 1e-6);
}

TEST(influence, gradient_bands_agree_with_the_definition) {
    Random random(3);
    for (int d = 1; d <= 4; ++d) {
        std::vector<Axis> axes;
        for (int k = 0; k < d; ++k) axes.push_back({"axis", "", 0, 1, false});
        std::vector<SpacePoint> samples(7);
        for (SpacePoint& s : samples)
            for (int k = 0; k < d; ++k) s[k] = random.unit();
        const BlendSpace space = make_space(axes, samples, Weighting::gradient_band);
        for (int round = 0; round < 50; ++round) {
            SpacePoint p{};
            for (int k = 0; k < d; ++k) p[k] = random.between(-0.3f, 1.3f);
            std::vector<double> influence;
            double sum = 0;
            for (const SpacePoint& i : samples) {
                double least = 1;
                for (const SpacePoint& j : samples) {
                    double along = 0, square = 0;
                    for (int k = 0; k < d; ++k) {
                        along += (double{p[k]} - i[k]) * (double{j[k]} - i[k]);
                        square += (double{j[k]} - i[k]) * (double{j[k]} - i[k]);
                    }
                    if (square > 0) least = std::min(least, 1 - along / square);
                }
                influence.push_back(std::max(least, 0.0));
                sum += influence.back();
            }
            const auto w = weights_at(space, p);
            for (int i = 0; i < 7; ++i) EXPECT_NEAR(w.count(i) ? w.at(i) : 0, influence[i] / sum, 1e-5) << d;
        }
    }
}

TEST(influence, polar_bands_turn_at_constant_length_from_one_direction_to_the_next) {
    const BlendSpace space = compass(Weighting::gradient_band_polar);
    for (int step = 0; step < 720; ++step) {
        const float angle = static_cast<float>(step * k_pi / 360);
        const auto w = weights_at(space, {1.5f * cos(angle), 1.5f * sin(angle)});
        const int from = step / 90;
        const float share = static_cast<float>(step % 90) / 90;
        EXPECT_NEAR(w.count(1 + from) ? w.at(1 + from) : 0, 1 - share, 1e-4) << step;
        EXPECT_NEAR(w.count(1 + (from + 1) % 8) ? w.at(1 + (from + 1) % 8) : 0, share, 1e-4) << step;
    }
    // Half way out the idle takes half, whatever the direction.
    const auto half = weights_at(space, {0.75f, 0});
    EXPECT_NEAR(half.at(0), 0.5f, 1e-4);
}

TEST(influence, polar_bands_have_no_jump_in_directions_that_no_clip_covers_nor_at_an_empty_origin) {
    const std::vector<std::vector<SpacePoint>> sets{
        {{1, 0}, {0, 1.5f}},                            // a gap of 270 degrees
        {{1.5f, 0.2f}, {1, 1}, {0.3f, 1.2f}},           // one quarter
        {{1, 0}, {-1, 0}},                              // opposite, nothing between
        {{1.5f, 0}, {-1, 0.1f}, {0, 1}, {0.1f, -1.2f}}  // all round, no idle
    };
    for (const auto& samples : sets) {
        const BlendSpace space = make_space(velocity_axes(), samples, Weighting::gradient_band_polar);
        for (const float radius : {1.2f, 0.3f, 0.0f}) {
            std::map<int, float> before;
            for (int step = 0; step <= 7200; ++step) {
                const float angle = static_cast<float>(step * k_pi / 3600);
                // Round the origin or, at radius 0, through it along every direction.
                const float reach = radius > 0 ? radius : 1e-4f;
                const auto now = weights_at(space, {reach * cos(angle), reach * sin(angle)});
                for (int i = 0; i < static_cast<int>(samples.size()) && step > 0; ++i) {
                    const float a = now.count(i) ? now.at(i) : 0, b = before.count(i) ? before.at(i) : 0;
                    ASSERT_NEAR(a, b, 0.02f) << "radius " << radius << " step " << step;
                }
                if (radius == 0 && step > 0) {
                    for (const auto& [i, w] : now) ASSERT_NEAR(w, before.count(i) ? before.at(i) : 0, 1e-3f);
                }
                before = now;
            }
        }
    }
}

TEST(influence, opposite_clips_are_treated_alike_on_both_sides) {
    const BlendSpace space = make_space(velocity_axes(), {{1, 0}, {-1, 0}}, Weighting::gradient_band_polar);
    for (const float side : {0.2f, 0.7f, 1.3f}) {
        const auto left = weights_at(space, {0.4f, side}), right = weights_at(space, {0.4f, -side});
        EXPECT_NEAR(left.at(0), right.at(0), 1e-5);
    }
}

TEST(influence, further_axes_of_polar_bands_are_cartesian) {
    auto axes = velocity_axes();
    axes.push_back({"style", "", 0, 1, false});
    std::vector<SpacePoint> samples;
    for (const float style : {0.0f, 1.0f})
        for (const SpacePoint& p : {SpacePoint{1, 0}, SpacePoint{0, 1}, SpacePoint{-1, 0}, SpacePoint{0, -1}})
            samples.push_back({p[0], p[1], style});
    const BlendSpace space = make_space(axes, samples, Weighting::gradient_band_polar);
    const auto w = weights_at(space, {1, 0, 0.25f});
    EXPECT_NEAR(w.at(0), 0.75f, 1e-4);
    EXPECT_NEAR(w.at(4), 0.25f, 1e-4);
}

TEST(influence, axis_distance_blends_the_corners_of_a_grids_cell_alike_in_its_middle) {
    std::vector<SpacePoint> samples;
    for (int x = 0; x < 2; ++x)
        for (int y = 0; y < 2; ++y) samples.push_back({static_cast<float>(x), static_cast<float>(y)});
    const BlendSpace space = make_space(velocity_axes(), samples, Weighting::axis_distance);
    for (const auto& [sample, weight] : weights_at(space, {0.5f, 0.5f})) EXPECT_NEAR(weight, 0.25f, 1e-5) << sample;
    const auto near = weights_at(space, {0.1f, 0.1f});
    EXPECT_GT(near.at(0), 0.9f);
}

TEST(influence, axis_distance_in_one_dimension_blends_two_neighbours) {
    const BlendSpace space =
        make_space({{"speed", "m/s", 0, 4, false}}, {{0}, {1}, {2}, {4}}, Weighting::axis_distance);
    const auto w = weights_at(space, {1.5f});
    EXPECT_NEAR(w.at(1), 0.5f, 1e-5);
    EXPECT_NEAR(w.at(2), 0.5f, 1e-5);
    EXPECT_EQ(weights_at(space, {9}).size(), 1u);  // outside: the boundary's
}

TEST(influence, more_samples_than_fit_fade_out_one_by_one) {
    Random random(5);
    // A dense cloud in 4-D: many gradient bands overlap.
    int full = 0;
    for (const Weighting weighting : k_all) {
        std::vector<Axis> axes;
        for (int k = 0; k < 4; ++k) axes.push_back({"axis", "", -1, 1, false});
        std::vector<SpacePoint> samples(30);
        for (SpacePoint& s : samples)
            for (float& x : s) x = random.between(-1, 1);
        const BlendSpace space = make_space(axes, samples, weighting);
        std::map<int, float> before;
        constexpr int k_steps = 20000;
        for (int step = 0; step <= k_steps; ++step) {
            const float t = static_cast<float>(step) / k_steps;
            const auto now = weights_at(space, {0.8f * sin(7 * t), 0.8f * cos(5 * t), 0.5f * sin(3 * t), 0.9f * t});
            ASSERT_LE(now.size(), static_cast<std::size_t>(k_max_blend_weights));
            full += now.size() >= 8;
            for (int i = 0; i < 30 && step > 0; ++i) {
                const float a = now.count(i) ? now.at(i) : 0, b = before.count(i) ? before.at(i) : 0;
                ASSERT_NEAR(a, b, 0.03f) << static_cast<int>(weighting) << " step " << step;
            }
            before = now;
        }
    }
    EXPECT_GT(full, 1000);
}

TEST(influence, equal_samples_count_once) {
    for (const Weighting weighting : k_all) {
        const BlendSpace space = make_space(velocity_axes(), {{0, 0}, {1, 0}, {1, 0}, {0, 1}}, weighting);
        const auto w = weights_at(space, {1, 0});
        EXPECT_EQ(w.size(), 1u);
        EXPECT_EQ(w.begin()->first, 1);
    }
}

TEST(influence, odd_requests_and_rings_get_an_answer) {
    const float nan = std::nanf("");
    std::vector<SpacePoint> ring;
    for (int n = 0; n < 24; ++n)
        ring.push_back({cos(static_cast<float>(n * k_pi / 12)), sin(static_cast<float>(n * k_pi / 12))});
    for (const Weighting weighting : k_all)
        for (const SpacePoint& p : {SpacePoint{0, 0}, SpacePoint{nan, nan}, SpacePoint{1e38f, -1e38f}}) {
            EXPECT_GE(weights_at(make_space(velocity_axes(), ring, weighting), p).size(), 1u);
            EXPECT_GE(weights_at(compass(weighting), p).size(), 1u);
            EXPECT_EQ(weights_at(make_space(velocity_axes(), {{1, 1}}, weighting), p).size(), 1u);
        }
}

}  // namespace
}  // namespace surefoot
