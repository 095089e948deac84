#include <surefoot/pack/small_form.h>

#include <surefoot/analysis/analyze.h>
#include <surefoot/clip/sample.h>
#include <surefoot/pack/fit_curves.h>
#include <surefoot/pack/pack_clip.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/support/motion_data.h"
#include "tests/support/random_clips.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace surefoot {
namespace {

using namespace surefoot::test;

constexpr float k_limit = 1e-4f;

/// A clip of the synthetic set, measured: its strikes, legs and soles are known.
AnalyzedClip measured(const char* name) {
    for (const Motion& motion : make_synthetic_set().clips)
        if (motion.name == name) return analyze_clip(motion, name, 1, {});
    return {};
}
const AnalyzedClip& walk() {
    static const AnalyzedClip clip = measured("walk");
    return clip;
}

PackOptions options_of(const AnalyzedClip& clip, float error) {
    PackOptions options;
    options.legs = &clip.legs;
    options.error = error;
    return options;
}

TEST(CurveFitter, a_sine_needs_few_keys_and_noise_needs_them_all) {
    constexpr int k_frames = 61;
    Random random(1);
    std::vector<double> sine, noise;
    for (int f = 0; f < k_frames; ++f) {
        sine.push_back(0.3 * std::sin(2 * 3.14159265358979 * f / (k_frames - 1)));
        noise.push_back(f + 1 < k_frames ? static_cast<double>(random.between(-1, 1)) : noise.front());
    }
    CurveFitter fitter(k_frames, true, 1e-6f);
    fitter.add(4, sine, 1);
    fitter.add(2, noise, 1);
    const Curves curves = fitter.curves(1e-4f, 5);
    ASSERT_EQ(problem(curves), "");
    ASSERT_EQ(curves.groups.size(), 2u);
    EXPECT_LE(curves.groups[0].intervals, 12);
    EXPECT_EQ(curves.groups[1].intervals, k_frames - 1);
    EXPECT_EQ(curves.numbers, (std::vector<std::uint16_t>{4, 2}));
    std::vector<float> values(5);
    for (int f = 0; f < k_frames; ++f) {
        curve_values(curves, static_cast<float>(f) / (k_frames - 1), values);
        EXPECT_NEAR(static_cast<double>(values[4]), sine[static_cast<std::size_t>(f)], 1.01e-4);
        EXPECT_NEAR(static_cast<double>(values[2]), noise[static_cast<std::size_t>(f)], 1.01e-4);
    }
    EXPECT_TRUE(fitter.curves(2, 5).groups.empty());  // both are smaller than that
}

TEST(SmallForm, a_walk_stays_within_the_limit_at_a_tenth_of_its_raw_size) {
    PackReport report;
    const PackedClip clip = pack_clip(walk().motion, walk().facts, options_of(walk(), k_limit), &report);
    ASSERT_FALSE(clip.small.empty());
    EXPECT_EQ(problem(clip), "");
    EXPECT_LE(report.error, k_limit);
    EXPECT_GT(report.error, 0.5f * k_limit);  // what is allowed is used
    EXPECT_LT(report.bytes * 9, report.raw_bytes);
    EXPECT_TRUE(clip.root.empty());
    EXPECT_TRUE(clip.feet[0].keys.empty());
}

TEST(SmallForm, a_coarser_limit_is_smaller) {
    const auto size = [](float limit) {
        return memory_size(pack_clip(walk().motion, walk().facts, options_of(walk(), limit)));
    };
    EXPECT_LT(size(1e-3f), size(k_limit));
    EXPECT_LT(size(k_limit), size(3e-5f));
}

// The metric that guards the limit has to see what it guards.
TEST(SmallForm, an_error_in_a_curve_is_seen) {
    PackedClip clip = pack_clip(walk().motion, walk().facts, options_of(walk(), k_limit));
    clip.small.curves.steps.front() *= 1.5f;
    EXPECT_GT(measure_packing(walk().motion, clip, &walk().legs).error, 5 * k_limit);
    clip = pack_clip(walk().motion, walk().facts, options_of(walk(), k_limit));
    clip.feet[1].small.middle.print.translation.x += 0.001f;
    EXPECT_NEAR(measure_packing(walk().motion, clip, &walk().legs).error, 0.001f, 2 * k_limit);
}

TEST(SmallForm, footprints_and_ages_are_those_of_every_frame) {
    const PackedClip every = pack_clip(walk().motion, walk().facts, options_of(walk(), 0));
    const PackedClip small = pack_clip(walk().motion, walk().facts, options_of(walk(), k_limit));
    ASSERT_TRUE(every.feet[0].known() && small.feet[0].known());
    for (const Side side : {Side::left, Side::right})
        for (int f = 0; f < every.frame_count; ++f) {
            const float time = static_cast<float>(f) / every.fps;
            const FootKey a = foot_key_at(every, side, time), b = foot_key_at(small, side, time);
            EXPECT_NEAR(a.age, b.age, 1e-5f);
            EXPECT_LT(distance(a.print.translation, b.print.translation), 2 * k_limit);
            EXPECT_LT(rotation_angle(conjugate(a.print.rotation) * b.print.rotation), 2e-3f);
        }
}

TEST(SmallForm, blends_with_clips_that_keep_every_frame) {
    const AnalyzedClip run = measured("run");
    const Skeleton& skeleton = *walk().motion.skeleton;
    const PackedClip clips[] = {pack_clip(walk().motion, walk().facts, options_of(walk(), 0)),
                                pack_clip(walk().motion, walk().facts, options_of(walk(), k_limit)),
                                pack_clip(run.motion, run.facts, options_of(run, 0)),
                                pack_clip(run.motion, run.facts, options_of(run, k_limit))};
    ASSERT_FALSE(clips[1].small.empty() || clips[3].small.empty());
    const std::size_t joints = skeleton.rest.size();
    const auto blended = [&](int a, int b, float weight) {
        // On frames: between them every frame's form goes straight, while curves go on as the motion does.
        const Leaf leaves[] = {{a, 20 / clips[a].fps, 1 - weight}, {b, 28 / clips[b].fps, weight}};
        std::vector<Transform> locals(joints), models(joints), scalar(joints);
        sample_pose(skeleton, clips, leaves, locals);
        sample_pose_scalar(skeleton, clips, leaves, scalar);
        EXPECT_EQ(std::memcmp(locals.data(), scalar.data(), joints * sizeof(Transform)), 0);
        local_to_model(skeleton, locals, models);
        return models;
    };
    for (const float weight : {-0.2f, 0.0f, 0.4f, 1.0f}) {
        const std::vector<Transform> wanted = blended(0, 2, weight);
        for (const auto& [a, b] : {std::pair{1, 2}, std::pair{0, 3}, std::pair{1, 3}}) {
            const std::vector<Transform> got = blended(a, b, weight);
            for (std::size_t j = 0; j < joints; ++j)
                EXPECT_LT(distance(wanted[j].translation, got[j].translation), 4 * k_limit) << j << ", " << weight;
        }
    }
}

TEST(SmallForm, what_turns_far_keeps_every_frame) {
    const auto skeleton = std::make_shared<Skeleton>();
    skeleton->add("wheel", k_no_joint, {});
    Motion motion = make_motion(skeleton, "spins", 40, 30);
    for (int f = 0; f < 40; ++f) motion.frame(f)[0].rotation = axis_angle({1, 0, 0}, 0.2f * static_cast<float>(f));
    PackOptions options;
    options.error = k_limit;
    PackReport report;
    const PackedClip clip = pack_clip(motion, {}, options, &report);
    EXPECT_TRUE(clip.small.empty());
    EXPECT_EQ(clip.rotations.size(), 40u * 32);
    EXPECT_LE(report.error, k_limit);
}

TEST(SmallForm, clips_that_do_not_go_round_keep_their_own_root_and_ends) {
    Motion motion = walk().motion;
    motion.cyclic = false;
    PackOptions options;
    options.steady_root = false;
    options.error = k_limit;
    PackReport report;
    const PackedClip clip = pack_clip(motion, {}, options, &report);
    ASSERT_FALSE(clip.small.empty());
    EXPECT_EQ(problem(clip), "");
    EXPECT_FALSE(clip.small.curves.periodic);
    EXPECT_EQ(clip.root.size(), static_cast<std::size_t>(clip.frame_count));
    EXPECT_LE(report.error, k_limit);
}

}  // namespace
}  // namespace surefoot
