#include "glb_bytes.h"
#include "random_motion.h"

#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>

#include <tests/support/motion_data.h>

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

class Load : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("surefoot_load_" + std::to_string(getpid()));
        fs::remove_all(folder_);
        Random random(9);
        GltfScene scene;
        for (const char* name : {"Idle", "walk", "mixamo.com", "Walk", "a/b"}) {
            scene.motions.push_back(scene.motions.empty() ? test::random_motion(random, 5, 4) : scene.motions[0]);
            scene.motions.back().name = name;
        }
        write_file(folder_ / "many.glb", write_glb(scene));
        write_file(folder_ / "sub" / "turn.BVH", write_bvh(scene.motions[0]));
        write_file(folder_ / "B.bvh", write_bvh(scene.motions[0]));
        write_file(folder_ / "a.bvh", write_bvh(scene.motions[0]));
        write_file(folder_ / "readme.txt", "no clip");
    }
    void TearDown() override { fs::remove_all(folder_); }
    LoadResult load(const std::string& name) const {
        const std::string paths[] = {(folder_ / name).string()};
        return load_clips(paths);
    }
    fs::path folder_;
};

TEST_F(Load, a_folder_gives_its_clips_sorted_with_unique_names) {
    const LoadResult result = load("");
    EXPECT_TRUE(result.failed.empty());
    std::vector<std::string> names;
    for (const LoadedClip& clip : result.clips) names.push_back(clip.motion.name);
    EXPECT_EQ(names, (std::vector<std::string>{"B", "a", "Idle", "walk", "many", "Walk_2", "a_b", "turn"}));
    EXPECT_TRUE(result.clips[2].file.ends_with("many.glb#Idle"));
    EXPECT_TRUE(result.clips[0].file.ends_with("B.bvh"));
}

TEST_F(Load, one_clip_of_a_file_is_picked_by_name_or_number) {
    for (const char* pick : {"many.glb#walk", "many.glb#1", "many.glb#Armature|walk"}) {
        const LoadResult result = load(pick);
        ASSERT_EQ(result.clips.size(), 1u) << pick;
        EXPECT_EQ(result.clips[0].motion.name, "walk");
        EXPECT_TRUE(result.clips[0].file.ends_with("many.glb#walk"));
    }
    const LoadResult none = load("many.glb#jump");
    ASSERT_EQ(none.failed.size(), 1u);
    EXPECT_NE(none.failed[0].error.find("the file has no clip 'jump'; it has 5: Idle, walk, many, Walk_2, a_b"),
              std::string::npos)
        << none.failed[0].error;
    EXPECT_EQ(load("many.glb#7").failed.size(), 1u);
}

TEST_F(Load, clips_of_equal_skeletons_share_one) {
    const LoadResult result = load("");
    EXPECT_EQ(result.clips[0].motion.skeleton, result.clips[1].motion.skeleton);
    EXPECT_EQ(result.clips[2].motion.skeleton, result.clips[3].motion.skeleton);
}

TEST_F(Load, the_unit_can_be_given) {
    const std::string paths[] = {(folder_ / "a.bvh").string()};
    const LoadResult inches = load_clips(paths, {.unit_scale = 0.0254});
    EXPECT_FLOAT_EQ(inches.clips.at(0).unit_scale, 0.0254f);
}

TEST(LoadReal, a_character_without_animation_is_one_frame_in_its_rest_pose_where_that_is_asked_for) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    const std::string paths[] = {(folder / "characters_glb/m2m_human_male.glb").string()};
    LoadOptions options;
    options.still = true;
    const LoadResult result = load_clips(paths, options);
    ASSERT_EQ(result.clips.size(), 1u);
    const Motion& motion = result.clips[0].motion;
    EXPECT_EQ(motion.name, "m2m_human_male");
    EXPECT_EQ(motion.frame_count(), 1);
    EXPECT_GT(motion.joint_count(), 20);
    EXPECT_EQ(motion.locals, motion.skeleton->rest);
    EXPECT_TRUE(result.clips[0].warnings.empty()) << result.clips[0].warnings[0];
}

TEST(LoadReal, every_real_file_is_read_or_says_why_not_whatever_the_threads) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    std::vector<std::string> paths;
    for (const char* name : {"cmu_bvh", "ual1_locomotion_glb", "characters_glb", "o3de_mocap_bvh/Run1.bvh"})
        paths.push_back((folder / name).string());
    set_thread_count(1);
    const LoadResult one = load_clips(paths);
    set_thread_count(8);
    const LoadResult eight = load_clips(paths);
    set_thread_count(0);
    EXPECT_EQ(one.clips.size(), 24u + 50 + 6 + 10 + 1 + 1);
    ASSERT_EQ(one.failed.size(), 1u);
    EXPECT_NE(one.failed[0].error.find("m2m_human_male.glb: the file has no animation"), std::string::npos);
    ASSERT_EQ(eight.clips.size(), one.clips.size());
    for (std::size_t i = 0; i < one.clips.size(); ++i) {
        EXPECT_EQ(one.clips[i].motion.name, eight.clips[i].motion.name);
        EXPECT_EQ(one.clips[i].motion.locals, eight.clips[i].motion.locals);
        EXPECT_EQ(problem(one.clips[i].motion), "");
    }
}

}  // namespace
}  // namespace surefoot
