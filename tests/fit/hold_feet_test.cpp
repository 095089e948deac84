#include <surefoot/analysis/leg_track.h>
#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/derive.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/motion/edit.h>

#include "tests/fit/baked_clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

struct Asked {
    float speed, turn_deg;
};

/// As the series have their feet, before and after: at most `share` of the slide, and soles on the floor.
void expect_held(const HarmonicGait& gait, std::initializer_list<Asked> all, double share) {
    const HarmonicGait held = holding_feet(gait);
    EXPECT_EQ(problem(held), "");
    for (const Asked& asked : all) {
        SCOPED_TRACE(testing::Message() << gait.name << " " << asked.speed << " m/s " << asked.turn_deg << " deg/s");
        const AnalyzedClip before = bake_gait(gait, asked.speed, asked.turn_deg);
        const AnalyzedClip after = bake_gait(held, asked.speed, asked.turn_deg);
        EXPECT_LT(skate_of(after), share * skate_of(before));
        EXPECT_GT(lowest_sole(after), -0.008f);
        EXPECT_NEAR(std::fabs(after.facts.speed), asked.speed, 0.02f * std::max(asked.speed, 0.5f));
        EXPECT_EQ(after.motion.root, before.motion.root);
    }
}

TEST(HoldFeet, a_walking_and_running_family_slides_a_fraction_of_what_it_did) {
    const HarmonicGait human = fitted_gait("human");
    expect_held(human, {{0.5f, 0}, {1, 60}, {1.4f, 0}, {1.4f, -110}, {2, 30}}, 0.3);
    expect_held(human, {{2.6f, 0}, {3.4f, 0}, {4.5f, 0}, {3, 60}}, 0.6);
}

TEST(HoldFeet, so_do_walking_backward_turning_and_crouching) {
    expect_held(fitted_gait("back"), {{0.5f, 0}, {1, 30}, {1.5f, -60}}, 0.4);
    expect_held(fitted_gait("turn"), {{0, 60}, {0, -90}}, 0.4);
    expect_held(fitted_gait("crouch"), {{0.4f, 0}, {0.75f, 60}, {1.2f, 0}}, 0.4);
}

TEST(HoldFeet, the_body_and_its_rhythm_stay) {
    const HarmonicGait gait = fitted_gait("human"), held = holding_feet(gait);
    std::vector<float> own(static_cast<std::size_t>(value_count(gait))), values = own;
    values_at(gait, 1.3f, 20, own);
    values_at(held, 1.3f, 20, values);
    const std::size_t body =
        3 * (gait.mean.size() + gait.moving.size()) * (1 + 2 * static_cast<std::size_t>(gait.harmonics));
    for (std::size_t i = 0; i < own.size(); ++i)
        if (i < body || i >= own.size() - k_rhythm_values) {
            EXPECT_NEAR(own[i], values[i], 1e-4f) << i;
        }
}

TEST(HoldFeet, a_file_keeps_how_long_feet_are_held) {
    const HarmonicGait held = holding_feet(fitted_gait("turn"));
    ASSERT_GT(held.foot_hold, 0.5f);
    const HarmonicGait read = gait_from_json(gait_to_json(held), "held");
    EXPECT_EQ(read.foot_hold, held.foot_hold);
    EXPECT_EQ(read.coefficients, held.coefficients);
    EXPECT_EQ(fitted_gait("stairs_up").foot_hold, 0);
}

TEST(HoldFeet, stairs_and_gaits_without_feet_are_refused) {
    EXPECT_THROW(holding_feet(fitted_gait("stairs_up")), Error);
    HarmonicGait footless = fitted_gait("human");
    footless.legs.count = 0;
    EXPECT_THROW(holding_feet(footless), Error);
}

}  // namespace
}  // namespace surefoot
