#include <surefoot/motion/edit.h>

#include <surefoot/base/error.h>
#include <surefoot/motion/root_motion.h>

#include "walker.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::Walker;
using test::worst_world_distance;

// Half a step of a turning walk with root motion apart: nothing about it is symmetric.
Motion lopsided(const Walker& walker, float turn = 50) {
    Motion clip = walker.walk(1.3f, turn, 1.7f);
    extract_root_motion(clip, walker.roles);
    return clip;
}

float worst_rotation(const Motion& a, const Motion& b) {
    float worst = 0;
    for (std::size_t i = 0; i < a.locals.size(); ++i)
        worst = std::fmax(worst, rotation_angle(conjugate(a.locals[i].rotation) * b.locals[i].rotation));
    return worst;
}

TEST(mirror, twice_is_identity) {
    for (const bool root : {false, true})
        for (const bool symmetric : {true, false}) {
            const Walker walker(root, symmetric);
            const Motion clip = lopsided(walker);
            const Motion twice = mirror(mirror(clip, walker.roles), walker.roles);
            EXPECT_LT(worst_world_distance(clip, twice), 1e-4f);
            EXPECT_LT(worst_rotation(clip, twice), 1e-3f);
            EXPECT_EQ(twice.root, clip.root);
        }
}

TEST(mirror, world_positions_are_reflected_whatever_the_joints_axes) {
    for (const bool root : {false, true}) {
        const Walker walker(root);
        const Motion clip = lopsided(walker);
        const Motion image = mirror(clip, walker.roles);
        const std::vector<int> pairs = mirror_pairs(*clip.skeleton, walker.roles);
        EXPECT_EQ(pairs[static_cast<std::size_t>(clip.skeleton->find("pocket_thing.L"))],
                  clip.skeleton->find("pocket_thing.R"));
        std::vector<Transform> a(static_cast<std::size_t>(clip.joint_count())), b = a;
        for (int f = 0; f < clip.frame_count(); f += 5) {
            world_pose(clip, f, a);
            world_pose(image, f, b);
            for (std::size_t j = 0; j < a.size(); ++j) {
                const Vec3 p = a[static_cast<std::size_t>(pairs[j])].translation;
                EXPECT_LT(distance(b[j].translation, {-p.x, p.y, p.z}), 1e-4f)
                    << clip.skeleton->names[j] << " frame " << f;
            }
        }
        EXPECT_NEAR(image.root.back().yaw, -clip.root.back().yaw, 1e-6f);
    }
}

TEST(mirror, a_rest_pose_from_the_middle_of_a_step_does_not_spoil_it) {
    const Walker walker;
    const Motion clip = lopsided(walker);
    Skeleton stepping = *walker.skeleton;
    for (std::size_t j = 1; j < stepping.rest.size(); ++j) stepping.rest[j].rotation = clip.frame(13)[j].rotation;
    // The same axes on both sides now (the half turn would not be found): reflected frames.
    Motion same = clip;
    same.skeleton = std::make_shared<const Skeleton>(stepping);
    const Motion twice = mirror(mirror(same, walker.roles), walker.roles);
    EXPECT_LT(worst_world_distance(same, twice), 1e-4f);
}

TEST(reverse, twice_is_identity_and_once_runs_back_along_the_path) {
    const Walker walker;
    const Motion clip = lopsided(walker);
    const Motion back = reverse(clip);
    EXPECT_EQ(back.root[0], clip.root[0]);
    const RootFrame there = between(clip.root.front(), clip.root.back());
    const RootFrame here = between(back.root.back(), back.root.front());
    EXPECT_LT(distance(there.position, here.position), 1e-5f);
    EXPECT_NEAR(there.yaw, here.yaw, 1e-6f);
    EXPECT_LT(worst_world_distance(clip, reverse(back)), 1e-4f);
}

TEST(resample, keeps_duration_and_poses) {
    const Walker walker;
    const Motion clip = lopsided(walker);
    for (const float fps : {24.0f, 30.0f, 60.0f, 120.0f, 144.0f}) {
        const Motion other = resample(clip, fps);
        EXPECT_NEAR(other.duration(), clip.duration(), 1e-4f);
        EXPECT_NEAR(other.fps, fps, 0.5f * fps / static_cast<float>(other.frame_count()));
        EXPECT_EQ(other.frame(0)[3], clip.frame(0)[3]);
        EXPECT_EQ(other.root.back(), clip.root.back());
    }
    EXPECT_LT(worst_world_distance(resample(resample(clip, 240), 60), clip), 1e-4f);
    EXPECT_LT(worst_world_distance(resample(clip, clip.fps), clip), 1e-6f);
    EXPECT_THROW(resample(clip, 0), Error);
    EXPECT_THROW(resample(clip, -30), Error);
}

TEST(cut, clamps_to_the_clip_and_keeps_frames) {
    const Walker walker;
    Motion clip = lopsided(walker);
    clip.cyclic = true;
    const Motion part = cut(clip, 10, 30);
    EXPECT_EQ(part.frame_count(), 21);
    EXPECT_FALSE(part.cyclic);
    EXPECT_EQ(part.frame(0)[2], clip.frame(10)[2]);
    EXPECT_EQ(part.root[20], clip.root[30]);
    EXPECT_EQ(cut(clip, -5, 1000).frame_count(), clip.frame_count());
    EXPECT_TRUE(cut(clip, -5, 1000).cyclic);
    EXPECT_EQ(cut(clip, 50, 20).frame_count(), 1);
}

TEST(sample, of_a_cyclic_clip_goes_on_with_its_travel) {
    const Walker walker;
    Motion clip = walker.walk(1.4f, 30, 1.0f);
    clip.cyclic = true;
    extract_root_motion(clip, walker.roles);
    std::vector<Transform> locals(static_cast<std::size_t>(clip.joint_count()));
    RootFrame later, earlier;
    sample(clip, 2.25f, later, locals);
    EXPECT_NEAR(later.yaw - clip.root[0].yaw, 67.5f * k_radians_per_degree, 0.02f);
    sample(clip, -0.75f, earlier, locals);
    EXPECT_NEAR(later.yaw - earlier.yaw, 90.0f * k_radians_per_degree, 1e-4f);
    EXPECT_EQ(locals[1], clip.frame(15)[1]);
    sample(clip, 1e9f, later, locals);  // eleven days on: still finite, and at once
    EXPECT_TRUE(is_finite(later.position));
}

TEST(close_loop, makes_first_and_last_pose_equal_and_adds_little_more_than_half_the_seam) {
    const Walker walker;
    Motion clip = walker.walk(1.4f, 40, 1.05f);  // a twentieth of a cycle too long
    extract_root_motion(clip, walker.roles);
    const Motion before = clip;
    const LoopClosing measured = measure_seam(clip);
    const LoopClosing closed = close_loop(clip);
    EXPECT_TRUE(clip.cyclic);
    EXPECT_FLOAT_EQ(measured.seam, closed.seam);
    EXPECT_FLOAT_EQ(measured.seam_speed, closed.seam_speed);
    EXPECT_GT(closed.seam, 0.05f);
    EXPECT_LT(closed.added, 0.6f * closed.seam + 0.02f * closed.seam_speed);
    EXPECT_GT(closed.added, 0.3f * closed.seam);
    for (std::size_t j = 0; j < clip.frame(0).size(); ++j) {
        EXPECT_EQ(clip.frame(0)[j].translation, clip.frame(clip.frame_count() - 1)[j].translation);
        EXPECT_EQ(clip.frame(0)[j].rotation, clip.frame(clip.frame_count() - 1)[j].rotation);
    }
    EXPECT_LT(measure_seam(clip).seam, 1e-5f);
    EXPECT_LT(measure_seam(clip).seam_speed, 0.1f * closed.seam_speed);
    // The middle of the clip is where it was in the world (frame 31 of 0 to 63 is half a frame off it).
    std::vector<Transform> a(static_cast<std::size_t>(clip.joint_count())), b = a;
    world_pose(before, 31, a);
    world_pose(clip, 31, b);
    for (std::size_t j = 0; j < a.size(); ++j) EXPECT_LT(distance(a[j].translation, b[j].translation), 0.01f);
}

TEST(close_loop, leaves_a_closed_cycle_as_it_is) {
    const Walker walker;
    Motion clip = walker.walk(1.4f, 40, 1.0f);
    clip.cyclic = true;
    extract_root_motion(clip, walker.roles);
    const Motion before = clip;
    const LoopClosing closed = close_loop(clip);
    EXPECT_LT(closed.seam, 1e-4f);
    EXPECT_LT(closed.added, 1e-4f);
    EXPECT_LT(worst_world_distance(before, clip), 1e-4f);
}

TEST(concatenate, starts_each_part_where_the_one_before_ended) {
    const Walker walker;
    const Motion clip = lopsided(walker);
    const std::vector<Motion> parts = {cut(clip, 0, 40), cut(clip, 40, 80), cut(clip, 80, clip.frame_count() - 1)};
    const Motion whole = concatenate(parts);
    ASSERT_EQ(whole.frame_count(), clip.frame_count());
    EXPECT_LT(worst_world_distance(whole, clip), 1e-4f);
    EXPECT_THROW(concatenate({}), Error);
}

TEST(start_at_origin, moves_the_clip_without_changing_it) {
    const Walker walker;
    Motion clip = cut(lopsided(walker), 40, 90);
    const RootFrame travel = between(clip.root.front(), clip.root.back());
    start_at_origin(clip);
    EXPECT_LT(length(clip.root[0].position), 1e-6f);
    EXPECT_NEAR(clip.root[0].yaw, 0, 1e-6f);
    EXPECT_LT(distance(between(clip.root.front(), clip.root.back()).position, travel.position), 1e-5f);
}

TEST(rotate_cycle, enters_the_same_loop_later_and_keeps_its_travel) {
    const Walker walker;
    Motion loop = walker.walk(1.4f, 40, 1.05f);
    extract_root_motion(loop, walker.roles);
    close_loop(loop);
    const int last = loop.frame_count() - 1, entry = last / 3;
    const Motion turned = rotate_cycle(loop, entry);
    ASSERT_EQ(turned.frame_count(), loop.frame_count());
    EXPECT_TRUE(turned.cyclic);
    for (int f = 0; f <= last; ++f) {
        const int source = entry + f <= last ? entry + f : entry + f - last;
        for (int j = 0; j < loop.joint_count(); ++j)
            EXPECT_EQ(turned.frame(f)[static_cast<std::size_t>(j)], loop.frame(source)[static_cast<std::size_t>(j)]);
    }
    // In the world the old end and what follows it are one path: a cycle later everything is moved by the same step.
    const RootFrame later = turned.root.front() * between(loop.root.front(), loop.root.back());
    EXPECT_NEAR(turned.root.back().yaw, later.yaw, 1e-4f);
    EXPECT_LT(distance(turned.root.back().position, later.position), 0.03f);
    EXPECT_EQ(rotate_cycle(loop, 0).locals, loop.locals);
}

}  // namespace
}  // namespace surefoot
