#include <surefoot/motion/root_motion.h>

#include <surefoot/motion/edit.h>

#include "walker.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::Walker;
using test::worst_world_distance;

TEST(low_passed_root, extraction_and_baking_keep_world_poses) {
    const Walker walker;
    for (const float turn : {0.0f, 90.0f, -60.0f}) {
        const Motion clip = walker.walk(1.4f, turn, 3.0f);
        Motion moved = clip;
        extract_root_motion(moved, walker.roles);
        EXPECT_GT(planar_length(moved.root.back().position - moved.root.front().position), 1.0f);
        EXPECT_LT(worst_world_distance(clip, moved), 1e-4f);
        bake_root_motion(moved);
        for (const RootFrame& frame : moved.root) EXPECT_EQ(frame, RootFrame{});
        EXPECT_LT(worst_world_distance(clip, moved), 1e-4f);
    }
}

TEST(low_passed_root, speed_and_turn_of_a_steady_walk_are_right_to_the_very_ends) {
    const Walker walker;
    for (const float turn : {0.0f, 45.0f, 90.0f}) {
        Motion clip = walker.walk(1.4f, turn, 2.5f);
        extract_root_motion(clip, walker.roles);
        const int last = clip.frame_count() - 1;
        for (const int f : {0, last / 2, last - 1}) {
            const RootFrame step =
                between(clip.root[static_cast<std::size_t>(f)], clip.root[static_cast<std::size_t>(f) + 1]);
            EXPECT_NEAR(planar_length(step.position) * clip.fps, 1.4f, 0.06f) << "turn " << turn << " frame " << f;
            EXPECT_NEAR(step.yaw * clip.fps * k_degrees_per_radian, turn, 4.0f) << "frame " << f;
        }
        float path = 0;
        for (int f = 0; f < last; ++f)
            path += planar_length(clip.root[static_cast<std::size_t>(f) + 1].position -
                                  clip.root[static_cast<std::size_t>(f)].position);
        EXPECT_NEAR(path / clip.duration(), 1.4f, 0.014f) << "turn " << turn;
    }
}

TEST(low_passed_root, a_cyclic_clip_gets_a_path_that_repeats) {
    const Walker walker;
    Motion clip = walker.walk(1.4f, 90.0f, 1.0f);  // exactly one cycle
    clip.cyclic = true;
    extract_root_motion(clip, walker.roles);
    const LoopClosing seam = measure_seam(clip);
    EXPECT_LT(seam.seam, 1e-4f);
    const std::size_t last = clip.root.size() - 1;
    const RootFrame first = between(clip.root[0], clip.root[1]), end = between(clip.root[last - 1], clip.root[last]);
    EXPECT_NEAR(length(first.position - end.position) * clip.fps, 0.0f, 0.01f);
    EXPECT_NEAR(between(clip.root[0], clip.root[last]).yaw * k_degrees_per_radian, 90.0f, 0.1f);
}

TEST(low_passed_root, the_pose_faces_forward_near_the_origin_and_keeps_its_sway) {
    const Walker walker;
    Motion clip = walker.walk(1.4f, 60.0f, 4.0f);
    extract_root_motion(clip, walker.roles);
    std::vector<Transform> models(static_cast<std::size_t>(clip.joint_count()));
    float sway = 0;
    for (int f = 0; f < clip.frame_count(); ++f) {
        local_to_model(*clip.skeleton, clip.frame(f), models);
        EXPECT_NEAR(torso_yaw(walker.roles, models), 0.0f, 0.1f);
        const Vec3 hips = models[static_cast<std::size_t>(walker.roles[Role::hips])].translation;
        EXPECT_LT(planar_length(hips), 0.06f);
        sway = std::fmax(sway, std::fabs(hips.x));
        EXPECT_EQ(clip.root[static_cast<std::size_t>(f)].position.y, 0.0f);
    }
    EXPECT_GT(sway, 0.015f);
}

TEST(low_passed_root, climbing_is_followed_only_when_asked_for) {
    const Walker walker;
    Motion clip = walker.walk(1.0f, 0, 3.0f);
    for (int f = 0; f < clip.frame_count(); ++f)
        clip.frame(f)[0].translation.y += 0.2f * static_cast<float>(f) / clip.fps;
    Motion flat = clip;
    extract_root_motion(flat, walker.roles);
    EXPECT_EQ(flat.root.back().position.y, 0.0f);
    extract_root_motion(clip, walker.roles, {.follow_climb = true});
    EXPECT_NEAR(clip.root.back().position.y, 0.6f, 0.02f);
}

TEST(low_passed_root, a_dedicated_root_joint_stays_at_the_root_frame) {
    const Walker walker(true);
    const Motion clip = walker.walk(1.4f, 45.0f, 2.0f);
    Motion moved = clip;
    extract_root_motion(moved, walker.roles);
    for (int f = 0; f < moved.frame_count(); ++f) EXPECT_EQ(moved.frame(f)[0], moved.skeleton->rest[0]);
    EXPECT_LT(worst_world_distance(clip, moved, 1), 1e-4f);  // all but the root joint itself
}

TEST(low_passed_root, shifting_the_pose_moves_all_but_the_dedicated_root) {
    const Walker walker(true);
    Motion clip = walker.walk(1.4f, 45.0f, 1.0f);
    extract_root_motion(clip, walker.roles);
    const Motion before = clip;
    shift_pose(clip, walker.roles, {0, 0.25f, 0});
    std::vector<Transform> a(static_cast<std::size_t>(clip.joint_count())), b = a;
    world_pose(before, 7, a);
    world_pose(clip, 7, b);
    EXPECT_EQ(a[0], b[0]);
    for (std::size_t j = 1; j < a.size(); ++j) EXPECT_NEAR(b[j].translation.y - a[j].translation.y, 0.25f, 1e-5f);
}

TEST(low_passed_root, clips_of_one_and_two_frames_are_handled) {
    const Walker walker;
    for (const int frames : {1, 2, 3}) {
        Motion clip = cut(walker.walk(1.4f, 20.0f, 1.0f), 0, frames - 1);
        const Motion before = clip;
        extract_root_motion(clip, walker.roles);
        EXPECT_EQ(problem(clip), "");
        EXPECT_LT(worst_world_distance(before, clip), 1e-4f);
    }
}

TEST(low_passed_root, an_absurd_frame_rate_costs_no_more_than_a_long_window) {
    const Walker walker;
    Motion clip = walker.walk(1.4f, 20.0f, 2.0f);
    clip.fps = 1e9f;
    for (const bool cyclic : {false, true}) {
        Motion fast = clip;
        fast.cyclic = cyclic;
        extract_root_motion(fast, walker.roles);
        EXPECT_EQ(problem(fast), "");
    }
}

}  // namespace
}  // namespace surefoot
