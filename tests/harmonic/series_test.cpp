#include <surefoot/harmonic/series.h>
#include <surefoot/math/trig.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

const std::vector<float> k_series{0.3f, 0.5f, -0.2f, 0.1f, 0.4f};

TEST(GaitSeries, a_series_is_a_mean_and_waves) {
    EXPECT_NEAR(series_at(k_series, 0), 0.3f + 0.5f + 0.1f, 1e-6f);
    EXPECT_NEAR(series_at(k_series, 0.25f), 0.3f - 0.2f - 0.1f, 1e-6f);
    EXPECT_NEAR(series_at(k_series, 0.6f), series_at(k_series, 1.6f), 1e-6f);
}

TEST(GaitSeries, a_delayed_series_does_the_same_later) {
    std::vector<float> late = k_series;
    delay(late, 0.1f);
    for (const float phase : {0.0f, 0.3f, 0.77f})
        EXPECT_NEAR(series_at(late, phase + 0.1f), series_at(k_series, phase), 1e-6f);
}

TEST(GaitSeries, scaling_about_a_phase_keeps_what_is_there) {
    std::vector<float> more = k_series;
    scale_about(more, 0.3f, 2);
    const float fixed = series_at(k_series, 0.3f);
    EXPECT_NEAR(series_at(more, 0.3f), fixed, 1e-6f);
    for (const float phase : {0.0f, 0.5f, 0.8f})
        EXPECT_NEAR(series_at(more, phase) - fixed, 2 * (series_at(k_series, phase) - fixed), 1e-5f);
}

TEST(GaitSeries, sharpening_grows_with_the_wave) {
    std::vector<float> sharp = k_series;
    sharpen(sharp, 2);
    EXPECT_EQ(sharp, (std::vector<float>{0.3f, 0.5f, -0.2f, 0.2f, 0.8f}));
}

}  // namespace
}  // namespace surefoot
