#include "random_motion.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/load.h>

#include <tests/support/motion_data.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::worst_world_distance;

// Two joints; 'a' turns by 90 degrees about Y, then 90 about X in its own new axes.
const std::string k_small =
    "HIERARCHY\nROOT a\n{\n OFFSET 0 1 0\n CHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation Zrotation\n"
    " JOINT b\n {\n  OFFSET 0 1 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n"
    "  End Site\n  {\n   OFFSET 0 0.5 0\n  }\n }\n}\nMOTION\nFrames: 2\nFrame Time: 0.0333333\n"
    "0 1 0 0 0 0 0 0 0\n1 2 3 90 90 0 0 0 0\n";

TEST(Bvh, rotations_compose_in_the_order_of_the_channels) {
    const LoadedClip clip = read_bvh(k_small, "small.bvh", {.unit_scale = 1});
    ASSERT_EQ(clip.motion.frame_count(), 2);
    EXPECT_FLOAT_EQ(clip.motion.fps, 30);
    EXPECT_EQ(clip.motion.name, "small");
    EXPECT_EQ(clip.rotation_order, "YXZ");
    Transform world[2];
    world_pose(clip.motion, 1, world);
    // Y(90) X(90) takes +Y to X(90): +Z, then Y(90): +X.
    EXPECT_LT(distance(world[1].translation, Vec3{2, 2, 3}), 1e-6f);
    EXPECT_EQ(clip.motion.skeleton->tips[1], (Vec3{0, 0.5f, 0}));
}

TEST(Bvh, position_channels_replace_the_offset) {
    const LoadedClip clip = read_bvh(k_small, "small.bvh", {.unit_scale = 1});
    EXPECT_EQ(clip.motion.frame(0)[0].translation, (Vec3{0, 1, 0}));
    EXPECT_EQ(clip.motion.frame(1)[0].translation, (Vec3{1, 2, 3}));
    EXPECT_EQ(clip.motion.frame(1)[1].translation, (Vec3{0, 1, 0}));
}

TEST(Bvh, case_blanks_line_ends_and_colons_do_not_matter) {
    std::string odd;
    for (const char c : k_small)
        odd += c == '\n' ? std::string("\r\n") : c == ' ' ? std::string("\t  ") : std::string(1, c);
    for (const auto& [from, to] : {std::pair{"HIERARCHY", "hierarchy"},
                                   {"MOTION", "Motion"},
                                   {"Frames:", "FRAMES :"},
                                   {"ROOT", "Root"},
                                   {"End", "end"},
                                   {"OFFSET", "Offset"}})
        for (std::size_t at = 0; (at = odd.find(from, at)) != std::string::npos; at += std::string(to).size())
            odd.replace(at, std::string(from).size(), to);
    const LoadedClip clip = read_bvh("\xef\xbb\xbf\n" + odd + "\n\n", "odd.bvh", {.unit_scale = 1});
    const LoadedClip plain = read_bvh(k_small, "small.bvh", {.unit_scale = 1});
    EXPECT_EQ(*clip.motion.skeleton, *plain.motion.skeleton);
    EXPECT_EQ(clip.motion.locals, plain.motion.locals);
    EXPECT_TRUE(clip.warnings.empty());
}

TEST(Bvh, frame_times_with_few_digits_become_the_rate_they_stand_for) {
    const auto rate = [](const std::string& time) {
        std::string text = k_small;
        text.replace(text.find("0.0333333"), 9, time);
        return read_bvh(text, "x.bvh", {.unit_scale = 1}).motion.fps;
    };
    EXPECT_FLOAT_EQ(rate("0.0083333"), 120);
    EXPECT_FLOAT_EQ(rate("0.016667"), 60);
    EXPECT_FLOAT_EQ(rate("0.033"), 30);
    EXPECT_FLOAT_EQ(rate("0.01"), 100);
    EXPECT_NEAR(rate("0.033367"), 29.97, 0.001);
    EXPECT_NEAR(rate("0.0345"), 28.986, 0.001);
}

TEST(Bvh, joints_without_a_name_of_their_own_get_one_and_a_warning) {
    std::string text = k_small;
    text.replace(text.find("JOINT b"), 7, "JOINT a");
    const LoadedClip twice = read_bvh(text, "x.bvh", {.unit_scale = 1});
    EXPECT_EQ(twice.motion.skeleton->names[1], "a_2");
    ASSERT_EQ(twice.warnings.size(), 1u);
    EXPECT_EQ(twice.warnings[0], "two joints are named 'a': the second is called 'a_2'");
    text.replace(text.find("JOINT a"), 7, "JOINT");
    const LoadedClip missing = read_bvh(text, "x.bvh", {.unit_scale = 1});
    EXPECT_EQ(missing.motion.skeleton->names[1], "joint_1");
    ASSERT_EQ(missing.warnings.size(), 1u);
    EXPECT_EQ(missing.warnings[0], "joint 1 has no name: called 'joint_1'");
}

TEST(Bvh, written_and_read_again_keeps_every_joint_in_place) {
    Random random(1);
    for (const char* order : {"ZXY", "XYZ", "ZYX", "YXZ", "XZY", "YZX"})
        for (int i = 0; i < 5; ++i) {
            const Motion motion = test::random_motion(random, 1 + static_cast<int>(random.below(40)), 12);
            const LoadedClip back =
                read_bvh(write_bvh(motion, {.rotation_order = order}), "x.bvh", {.unit_scale = 0.01});
            ASSERT_EQ(back.motion.joint_count(), motion.joint_count());
            EXPECT_LT(worst_world_distance(motion, back.motion), 1e-5f) << order;
            EXPECT_FLOAT_EQ(back.motion.fps, motion.fps);
        }
}

TEST(Bvh, gimbal_lock_costs_no_accuracy) {
    auto skeleton = std::make_shared<Skeleton>();
    skeleton->add("a", k_no_joint, {});
    skeleton->add("b", 0, {{}, {0.3f, 1, 0.2f}}, {1, 1, 1});
    skeleton->add("c", 1, {{}, {1, 0.5f, 0.2f}});
    Motion motion = make_motion(skeleton, "lock", 400, 30);
    Random random(2);
    for (int f = 0; f < 400; ++f)
        for (int j = 0; j < 2; ++j) {
            const float middle =
                1.57079632f + (f % 4 == 0 ? 0.0f : random.between(-1e-3f, 1e-3f) / static_cast<float>(f));
            motion.frame(f)[static_cast<std::size_t>(j)].rotation =
                axis_angle({0, 0, 1}, random.between(-3, 3)) * axis_angle({1, 0, 0}, f % 2 == 0 ? middle : -middle) *
                axis_angle({0, 1, 0}, random.between(-3, 3));
        }
    const LoadedClip back = read_bvh(write_bvh(motion), "x.bvh", {.unit_scale = 0.01});
    EXPECT_LT(worst_world_distance(motion, back.motion), 1e-5f);
}

TEST(Bvh, two_joints_of_six_channels_keep_the_hips_above_the_root) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    const std::string path = (folder / "o3de_mocap_bvh/Walk1.bvh").string();
    const LoadedClip clip = read_bvh(read_file(path), path);
    EXPECT_FLOAT_EQ(clip.unit_scale, 0.01f);
    EXPECT_FLOAT_EQ(clip.motion.fps, 60);
    std::vector<Transform> world(static_cast<std::size_t>(clip.motion.joint_count()));
    for (const int f : {0, 1000, 3000, 5000}) {
        world_pose(clip.motion, f, world);
        EXPECT_NEAR(world[0].translation.y, 0, 0.01);
        EXPECT_GT(world[1].translation.y, 0.8f);
        EXPECT_LT(world[1].translation.y, 1.1f);
        EXPECT_LT(planar_length(world[1].translation - world[0].translation), 0.5f);
    }
}

}  // namespace
}  // namespace surefoot
