#include <surefoot/base/random.h>
#include <surefoot/gait/oscillators.h>
#include <tests/support/allocations.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace surefoot {
namespace {

const FootfallPattern& pattern(const char* name) { return *find_footfall_pattern(name); }

TEST(Oscillators, every_pattern_has_offsets_and_duties_of_a_cycle_and_a_name_of_its_own) {
    for (const FootfallPattern& p : footfall_patterns()) {
        EXPECT_EQ(find_footfall_pattern(p.name), &p);
        for (const float offset : p.offset) EXPECT_TRUE(offset >= 0 && offset < 1) << p.name;
        for (const float duty : p.duty) EXPECT_TRUE(duty > 0.1f && duty < 0.9f) << p.name;
    }
    EXPECT_EQ(find_footfall_pattern("moonwalk"), nullptr);
    EXPECT_GT(pattern("walk").duty[0], 0.5f) << "one foot always stands";
    EXPECT_LT(pattern("run").duty[0], 0.5f) << "there is a flight";
}

TEST(Oscillators, in_step_they_keep_the_gaits_rate_and_do_not_drift_in_an_hour) {
    for (const FootfallPattern& p : footfall_patterns()) {
        Oscillators limbs = in_step(p.offset, 0.37f);
        for (int i = 0; i < 60 * 3600; ++i) advance(limbs, p.offset, 0.9f, 1.0f / 60);
        EXPECT_LT(disorder(limbs, p.offset), 1e-6f) << p.name;
    }
    Oscillators limbs = in_step(pattern("walk").offset, 0);
    for (int i = 0; i < 600; ++i) advance(limbs, pattern("walk").offset, 0.9f, 1.0f / 60);
    EXPECT_NEAR(phase_difference(limbs.phase[0], 0), 0, 2e-5f) << "ten seconds are nine cycles";
}

TEST(Oscillators, from_any_disorder_they_fall_into_step_at_every_frame_rate) {
    Random random(3);
    for (const float dt : {1.0f / 240, 1.0f / 60, 1.0f / 30, 1.0f / 15})
        for (int trial = 0; trial < 50; ++trial) {
            Oscillators limbs;
            for (float& phase : limbs.phase) phase = random.between(0, 1);
            for (float t = 0; t < 6; t += dt) advance(limbs, pattern("walk").offset, 1, dt);
            EXPECT_LT(disorder(limbs, pattern("walk").offset), 2e-3f) << dt << ", trial " << trial;
        }
}

TEST(Oscillators, the_frame_rate_hardly_matters) {
    Oscillators fine = in_step(pattern("walk").offset, 0.2f), coarse = fine;
    fine.phase[3] = coarse.phase[3] = 0.6f;
    for (int i = 0; i < 240; ++i) advance(fine, pattern("walk").offset, 1.1f, 1.0f / 240);
    for (int i = 0; i < 15; ++i) advance(coarse, pattern("walk").offset, 1.1f, 1.0f / 15);
    for (std::size_t i = 0; i < k_limbs; ++i) EXPECT_NEAR(phase_difference(fine.phase[i], coarse.phase[i]), 0, 0.01f);
}

TEST(Oscillators, opposite_limbs_come_together_though_nothing_says_which_way) {
    const std::array<float, k_limbs>& hop = pattern("hop").offset;
    Oscillators limbs = in_step(pattern("walk").offset, 0.1f);  // legs half a cycle apart: a saddle
    for (int i = 0; i < 240; ++i) advance(limbs, hop, 1, 1.0f / 60);
    EXPECT_LT(disorder(limbs, hop), 1e-3f);
}

TEST(Oscillators, no_limb_ever_goes_backwards) {
    Random random(8);
    for (int trial = 0; trial < 200; ++trial) {
        Oscillators limbs;
        for (float& phase : limbs.phase) phase = random.between(0, 1);
        for (int i = 0; i < 60; ++i) {
            const Oscillators before = limbs;
            advance(limbs, pattern("skip").offset, 0.7f, 1.0f / 60);
            for (std::size_t l = 0; l < k_limbs; ++l)
                EXPECT_GE(phase_difference(limbs.phase[l], before.phase[l]), -1e-6f);
        }
    }
}

TEST(Oscillators, patterns_mix_the_shorter_way_round) {
    FootfallPattern a, b;
    a.offset[1] = 0.9f, b.offset[1] = 0.1f;
    EXPECT_NEAR(phase_difference(mix(a, b, 0.5f).offset[1], 0), 0, 1e-6f);
    EXPECT_EQ(mix(a, b, 0).offset, a.offset);
    EXPECT_EQ(mix(a, b, 1).offset, b.offset);
    b.duty = {0.4f, 0.4f};
    EXPECT_FLOAT_EQ(mix(a, b, 0.3f).duty[0], 0.4f) << "a leaves it to the gait";
}

TEST(Oscillators, saving_is_copying_and_a_step_allocates_nothing) {
    Oscillators limbs = in_step(pattern("run").offset, 0.3f);
    limbs.phase[2] = 0.9f;
    Oscillators saved;
    std::memcpy(&saved, &limbs, sizeof saved);
    const long before = test::allocation_count();
    for (int i = 0; i < 100; ++i) advance(limbs, pattern("run").offset, 1.4f, 1.0f / 60);
    EXPECT_EQ(test::allocation_count(), before);
    for (int i = 0; i < 100; ++i) advance(saved, pattern("run").offset, 1.4f, 1.0f / 60);
    EXPECT_EQ(limbs, saved);
}

}  // namespace
}  // namespace surefoot
