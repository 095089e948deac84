#include <surefoot/analysis/leg_track.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/base/error.h>
#include <surefoot/base/random.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/io/load.h>
#include <surefoot/motion/edit.h>
#include <surefoot/synthetic/synthetic_set.h>
#include <tests/support/motion_data.h>

#include "tests/fit/baked_clip.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

AnalyzedClip default_clip(const std::string& name) {
    const ClipSet set = make_synthetic_set();
    for (const Motion& motion : set.clips)
        if (motion.name == name) return analyze_clip(motion, name);
    ADD_FAILURE() << "no clip " << name;
    return {};
}

TEST(FitClip, every_harmonic_brings_the_gait_nearer_to_the_clip) {
    const AnalyzedClip walk = default_clip("walk");
    const std::vector<FitError> errors = errors_by_harmonics(walk);
    ASSERT_EQ(errors.size(), 8u);
    for (std::size_t i = 1; i < errors.size(); ++i) {
        EXPECT_EQ(errors[i].harmonics, static_cast<int>(i) + 1);
        EXPECT_LT(errors[i].joint_deg, errors[i - 1].joint_deg);
    }
    EXPECT_GT(errors.front().joint_deg, 0.5f);  // one wave is no walk
    EXPECT_LT(errors.back().joint_deg, 0.5f);
}

TEST(FitClip, a_baked_gait_goes_as_its_clip_does) {
    for (const char* name : {"walk", "run", "back", "walk_left"}) {
        const AnalyzedClip clip = default_clip(name);
        const HarmonicGait gait = fit_clip(clip);
        EXPECT_EQ(problem(gait), "");
        const AnalyzedClip baked = bake_gait(gait, 0, 0);
        EXPECT_NEAR(baked.facts.speed, clip.facts.speed, 0.005f) << name;
        EXPECT_NEAR(baked.facts.turn, clip.facts.turn, 0.2f) << name;
        EXPECT_NEAR(baked.facts.cadence, clip.facts.cadence, 2) << name;
        EXPECT_EQ(baked.facts.events.front().foot, Side::left);
        EXPECT_EQ(baked.facts.events.front().time, 0);
        const AnalyzedClip again = analyze_clip(baked.motion, name);  // as author would see it
        EXPECT_TRUE(again.facts.cyclic);
        EXPECT_LT(again.facts.root_disagreement_speed, 0.05f * std::fabs(clip.facts.speed)) << name;
    }
}

TEST(FitClip, a_gait_survives_its_file_to_the_last_bit) {
    const HarmonicGait gait = fit_clip(default_clip("walk"));
    const std::string text = gait_to_json(gait);
    const HarmonicGait again = gait_from_json(text, "walk.json");
    EXPECT_EQ(again.coefficients, gait.coefficients);
    EXPECT_EQ(again.mean, gait.mean);
    EXPECT_EQ(gait_to_json(again), text);
    const AnalyzedClip a = bake_gait(gait, 0, 0), b = bake_gait(again, 0, 0);
    EXPECT_EQ(a.motion.locals, b.motion.locals);
}

TEST(FitClip, bad_files_are_refused_by_name_and_place) {
    const std::string text = gait_to_json(fit_clip(default_clip("walk")));
    const auto message = [](const std::string& bad) -> std::string {
        try {
            gait_from_json(bad, "bad.json");
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string bad = text;
        bad.replace(bad.find(from), from.size(), to);
        return message(bad);
    };
    EXPECT_NE(message("{").find("bad.json: it is no JSON"), std::string::npos);
    EXPECT_NE(message("{}").find("no fitted gait"), std::string::npos);
    EXPECT_NE(with("\"harmonics\": 5", "\"harmonics\": 500").find("not between 1 and 24"), std::string::npos);
    EXPECT_NE(with("\"harmonics\": 5", "\"harmonics\": 4").find("expected 9 numbers"), std::string::npos);
    EXPECT_NE(with("\"parent\":0", "\"parent\":99").find("bad.json"), std::string::npos);
    EXPECT_NE(with("\"degree\":0", "\"degree\":7").find("not between 0 and 3"), std::string::npos);
    for (std::size_t cut = 1; cut < text.size(); cut += text.size() / 40)
        EXPECT_NE(message(text.substr(0, cut)), "") << cut;
}

TEST(FitClip, a_damaged_file_is_refused_or_still_moves) {
    const std::string text = gait_to_json(fit_clip(default_clip("walk")));
    Random random(11);
    int read = 0;
    for (int i = 0; i < 1000; ++i) {
        std::string bad = text;
        for (int k = 0; k < 3; ++k)
            bad[random.below(static_cast<std::uint32_t>(bad.size()))] = "0123456789-e.,"[random.below(14)];
        try {
            const HarmonicGait gait = gait_from_json(bad, "bad.json");
            ++read;
            std::vector<float> values(static_cast<std::size_t>(value_count(gait)));
            std::vector<Transform> locals(gait.mean.size());
            values_at(gait, 1, 30, values);
            for (const float phase : {0.0f, 0.3f, 0.8f}) {
                pose(gait, values, phase, locals);
                for (const Transform& local : locals) ASSERT_TRUE(is_finite(local.rotation)) << i;
            }
        } catch (const Error&) {
        }
    }
    EXPECT_GT(read, 20);
}

TEST(FitClip, who_stands_keeps_both_feet_where_they_are) {
    const AnalyzedClip idle = default_clip("idle");
    const HarmonicGait gait = fit_clip(idle);
    EXPECT_EQ(problem(gait), "");
    const AnalyzedClip baked = bake_gait(gait, 0, 0);
    EXPECT_NEAR(baked.motion.duration(), idle.motion.duration(), 0.02f);
    EXPECT_EQ(baked.motion.root.back().position, (Vec3{0, 0, 0}));
    EXPECT_LT(measure_fit(idle, gait, gait.coefficients).joint_deg, 0.3f);
    const WalkTrack track = make_track(baked.motion, baked.legs);
    for (std::size_t side = 0; side < 2; ++side)
        for (const TrackFrame& frame : track.frames)
            EXPECT_LT(distance(frame.legs[side].sole[0], track.frames[0].legs[side].sole[0]), 0.002f);
}

TEST(FitClip, what_neither_steps_nor_stands_is_refused) {
    AnalyzedClip walk = default_clip("walk");
    walk.facts.events.clear();
    EXPECT_THROW(fit_clip(walk), Error);
}

// 0.8 degrees is what the issue asks for, as a mean over all joints and the walks. Hands and toes, full of what no five
// harmonics follow, keep the fastest above it; so does each walk if joints that never move are not counted.
TEST(FitClip, five_harmonics_and_the_feets_own_keep_the_walks_of_the_cmu) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    int walks = 0;
    double all_joints = 0;
    for (const char* name :
         {"02_01", "02_02", "07_01", "07_02", "07_03", "07_06", "07_07", "07_08", "07_09", "07_10", "07_11"}) {
        const std::string path = (folder / "cmu_bvh" / (std::string(name) + ".bvh")).string();
        LoadResult loaded = load_clips({{path}});
        ASSERT_EQ(loaded.clips.size(), 1u);
        AnalyzedClip take = analyze_clip(std::move(loaded.clips[0].motion), name);
        take.facts.cyclic = take.motion.cyclic = false;  // the ends of 07_06 happen to meet
        for (const AnalyzedClip& walk : find_cycles(take)) {
            const HarmonicGait gait = fit_clip(walk);
            const FitError error = measure_fit(walk, gait, gait.coefficients);
            EXPECT_LT(error.joint_deg, 1.15f) << name;
            EXPECT_LT(error.all_joints_deg, 0.92f) << name;
            all_joints += static_cast<double>(error.all_joints_deg);
            EXPECT_LT(error.ankle_cm, 0.6f) << name;
            EXPECT_LT(error.ankle_max_cm, 1.7f) << name;
            EXPECT_LT(skate_of(bake_gait(gait, 0, 0, walk.motion.fps)), 1.2 * skate_of(walk)) << name;
            ++walks;
        }
    }
    EXPECT_GE(walks, 10);
    EXPECT_LT(all_joints / walks, 0.8);
}

}  // namespace
}  // namespace surefoot
