#include <surefoot/analysis/leg_track.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/host/files.h>
#include <surefoot/io/load.h>
#include <surefoot/motion/edit.h>
#include <surefoot/synthetic/synthetic_set.h>
#include <tests/fit/largest_change.h>
#include <tests/support/motion_data.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

std::vector<AnalyzedClip> strides_of_takes(const std::filesystem::path& folder) {
    LoadResult loaded = load_clips({{(folder / "o3de_mocap_bvh").string()}});
    std::vector<AnalyzedClip> strides;
    for (LoadedClip& clip : loaded.clips)
        for (AnalyzedClip& stride : find_strides(analyze_clip(std::move(clip.motion), clip.file)))
            strides.push_back(std::move(stride));
    return strides;
}

class FitFamily : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (const std::filesystem::path folder = test::motion_data(); !folder.empty())
            gait_ = new HarmonicGait(fit_family(strides_of_takes(folder), {}, &report_));
    }
    static void TearDownTestSuite() {
        delete gait_;
        gait_ = nullptr;
    }
    static HarmonicGait* gait_;
    static FamilyReport report_;
};
HarmonicGait* FitFamily::gait_ = nullptr;
FamilyReport FitFamily::report_;

TEST_F(FitFamily, walks_and_runs_of_an_actor_become_one_gait) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    EXPECT_EQ(problem(*gait_), "");
    EXPECT_EQ(gait_->basis.modes, 2);
    EXPECT_GT(report_.strides.size(), 150u);
    double joints = 0;
    for (const StrideError& stride : report_.strides) joints += static_cast<double>(stride.error.joint_deg);
    EXPECT_LT(joints / static_cast<double>(report_.strides.size()), 7);
}

TEST_F(FitFamily, root_and_feet_have_the_speed_asked_for_at_twenty_speeds) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (int i = 0; i < 20; ++i) {
        const float speed = 0.3f + 4.7f * static_cast<float>(i) / 19;
        const AnalyzedClip clip = analyze_clip(bake_gait(*gait_, speed, 0).motion, "family");
        EXPECT_NEAR(clip.facts.speed, speed, 0.02f * speed);
        EXPECT_LT(clip.facts.root_disagreement_speed, 0.02f * speed) << speed << " m/s";
    }
}

TEST_F(FitFamily, soles_come_to_the_floor_and_not_far_under_it) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const float speed : {0.3f, 0.8f, 1.4f, 2.0f, 2.6f, 3.4f, 5.0f})
        for (const float turn : {0.0f, 60.0f, -120.0f}) {
            const AnalyzedClip clip = bake_gait(*gait_, speed, turn);
            const WalkTrack track = make_track(clip.motion, clip.legs);
            for (std::size_t side = 0; side < 2; ++side) {
                float lowest = 1;
                for (const TrackFrame& frame : track.frames)
                    for (const Vec3 point : frame.legs[side].sole) lowest = std::min(lowest, point.y);
                EXPECT_GT(lowest, speed > 4 ? -0.04f : -0.03f) << speed << " m/s, " << turn << " deg/s";
                EXPECT_LT(lowest, 0.02f) << speed << " m/s, " << turn << " deg/s";
            }
        }
}

TEST_F(FitFamily, poses_change_smoothly_with_the_speed) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const float turn : {0.0f, 60.0f, -120.0f}) {
        const float whole = largest_change(*gait_, 2, turn), half = largest_change(*gait_, 1, turn);
        EXPECT_LT(whole, 6) << turn;
        EXPECT_LT(half, 0.6f * whole) << turn;
    }
}

TEST_F(FitFamily, turning_right_is_the_mirror_image_of_turning_left) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    std::vector<float> left(static_cast<std::size_t>(value_count(*gait_))), right = left;
    values_at(*gait_, 1.2f, 60, left);
    values_at(*gait_, 1.2f, -60, right);
    const GaitRhythm l = rhythm_of(*gait_, left), r = rhythm_of(*gait_, right);
    EXPECT_NEAR(l.frequency, r.frequency, 1e-3f);
    EXPECT_NEAR(l.lift[0], r.lift[1], 1e-2f);
    EXPECT_NEAR(l.right_strike, 1 - r.right_strike, 1e-2f);
    const AnalyzedClip a = bake_gait(*gait_, 1.2f, 60), b = bake_gait(*gait_, 1.2f, -60);
    const Motion mirrored = rotate_cycle(mirror(b.motion, b.roles.roles), b.motion.frame_count() / 2);
    std::vector<Transform> pose_a(gait_->mean.size()), pose_b = pose_a;
    local_to_model(*gait_->skeleton, a.motion.frame(0), pose_a);
    local_to_model(*gait_->skeleton, mirrored.frame(0), pose_b);
    for (std::size_t j = 0; j < pose_a.size(); ++j)
        EXPECT_LT(distance(pose_a[j].translation, pose_b[j].translation), 0.04f) << gait_->skeleton->names[j];
}

TEST_F(FitFamily, what_lies_beyond_its_range_is_refused) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    EXPECT_THROW(bake_gait(*gait_, 6, 0), Error);
    EXPECT_THROW(bake_gait(*gait_, 1, 150), Error);
    EXPECT_THROW(bake_gait(*gait_, 1, 0, 1000), Error);
}

TEST(BundledFamily, goes_as_fast_as_asked_and_changes_smoothly) {
    const std::string file = SUREFOOT_SOURCE_DIR "/gaits/fitted/human.json";
    const HarmonicGait gait = gait_from_json(read_file(file), file);
    for (int i = 0; i < 20; ++i) {
        const float speed = 0.3f + 4.7f * static_cast<float>(i) / 19;
        const AnalyzedClip clip = analyze_clip(bake_gait(gait, speed, 0).motion, "family");
        EXPECT_NEAR(clip.facts.speed, speed, 0.02f * speed);
        EXPECT_LT(clip.facts.root_disagreement_speed, 0.02f * speed) << speed << " m/s";
    }
    for (const float turn : {0.0f, 60.0f, -90.0f}) {
        const float whole = largest_change(gait, 2, turn), half = largest_change(gait, 1, turn);
        EXPECT_LT(whole, 6) << turn;
        EXPECT_LT(half, 0.6f * whole) << turn;
        RecordProperty("largest_change_deg", std::to_string(whole));
    }
    // Beyond what was captured: 6.1 degrees, in half a step 3.6.
    EXPECT_LT(largest_change(gait, 2, -120), 6.5f);
}

TEST(FitFamilyOfFew, too_few_strides_are_refused) {
    std::vector<AnalyzedClip> clips;
    for (const Motion& motion : make_synthetic_set().clips) clips.push_back(analyze_clip(motion, motion.name));
    EXPECT_THROW(fit_family(clips), Error);
}

}  // namespace
}  // namespace surefoot
