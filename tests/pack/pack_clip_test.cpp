#include <surefoot/base/error.h>
#include <surefoot/clip/sample.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/io/load.h>
#include <surefoot/motion/root_motion.h>
#include <surefoot/pack/pack_clip.h>

#include "tests/support/motion_data.h"
#include "tests/support/random_clips.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

using namespace surefoot::test;

constexpr float k_millimetre = 1e-3f;

/// Smooth random motion: each joint swings about rest, the root walks a wobbling curve.
Motion random_motion(Random& random, int joints, int frames) {
    const auto skeleton = std::make_shared<Skeleton>(random_skeleton(random, joints));
    Motion motion = make_motion(skeleton, "random", frames, 30);
    motion.cyclic = true;
    for (int j = 0; j < joints; ++j) {
        const Quat a = random_rotation(random, 0.5f), b = random_rotation(random, 0.5f);
        const float shift = random.between(0, 6);
        for (int f = 0; f < frames; ++f) {
            const float t = static_cast<float>(f) / static_cast<float>(std::max(frames - 1, 1)) * 6.2831853f + shift;
            Transform& local = motion.frame(f)[static_cast<std::size_t>(j)];
            local.rotation = normalized(local.rotation * slerp({}, a, sin(t)) * slerp({}, b, cos(2 * t)));
            if (j == 0) local.translation += Vec3{0.05f * sin(t), 0.03f * cos(2 * t), 0.02f * sin(2 * t)};
        }
    }
    const float turn = random.between(-1.5f, 1.5f), heading = random.between(-3, 3);
    const Vec3 start{random.between(-5, 5), 0, random.between(-5, 5)};
    for (int f = 0; f < frames; ++f) {
        const float t = static_cast<float>(f) / 30,
                    cycle = static_cast<float>(f) / static_cast<float>(std::max(frames - 1, 1)) * 6.2831853f;
        const RootFrame steady = integrate({0.1f, 0, 1.3f}, turn, t);
        const RootFrame wobble{{0.02f * sin(cycle), 0, 0.04f * sin(2 * cycle)}, 0.05f * sin(cycle)};
        motion.root[static_cast<std::size_t>(f)] = RootFrame{start, heading} * steady * wobble;
    }
    return motion;
}

TEST(PackClip, random_motions_stay_within_a_few_tenths_of_a_millimetre) {
    Random random(1);
    for (int round = 0; round < 30; ++round) {
        const Motion motion =
            random_motion(random, 1 + static_cast<int>(random.below(70)), 2 + static_cast<int>(random.below(60)));
        PackReport report;
        const PackedClip clip = pack_clip(motion, {}, {}, &report);
        EXPECT_EQ(problem(clip), "");
        // Chains here are up to some twenty bones of half a metre long; an error of one part in 65,534 adds up.
        EXPECT_LT(report.error, 0.5f * k_millimetre)
            << "joint " << report.error_joint << " of " << motion.joint_count();
        EXPECT_GT(report.error, 0);
    }
}

TEST(PackClip, the_metric_sees_an_error_that_is_there) {
    Random random(2);
    const Motion motion = random_motion(random, 12, 20);
    PackedClip clip = pack_clip(motion, {});
    const Quat bent = get_rotation(clip, 7, 3) * axis_angle({1, 0, 0}, 0.1f);
    set_rotation(clip, 7, 3, bent);
    const PackReport report = measure_packing(motion, clip);
    EXPECT_EQ(report.error_frame, 7);
    EXPECT_GT(report.error, 0.09f * k_virtual_vertex_distance);
}

TEST(PackClip, the_steady_root_is_steady_and_keeps_the_travel) {
    Random random(3);
    const Motion motion = random_motion(random, 9, 40);
    PackReport report;
    const PackedClip clip = pack_clip(motion, {}, {}, &report);
    for (int f = 0; f + 1 < clip.frame_count; ++f) {
        const RootFrame step =
            between(clip.root[static_cast<std::size_t>(f)], clip.root[static_cast<std::size_t>(f) + 1]);
        const RootFrame wanted = integrate(clip.velocity, clip.turn_rate, 1 / clip.fps);
        EXPECT_LT(distance(step.position, wanted.position), 1e-5f);
        EXPECT_NEAR(step.yaw, wanted.yaw, 1e-5);
    }
    // One pass takes the character where the motion took it.
    const RootFrame shift = between(clip.start, RootFrame{});
    const RootFrame end = shift * clip.travel * clip.start, wanted = between(motion.root.front(), motion.root.back());
    EXPECT_LT(distance(end.position, wanted.position), 1e-4f);
    EXPECT_NEAR(end.yaw, wanted.yaw, 1e-4);
    EXPECT_NEAR(clip.velocity.z, 1.3f, 0.05f);
    EXPECT_LT(report.root_deviation, 0.1f);
    EXPECT_GT(report.root_deviation, 0.01f);
}

TEST(PackClip, a_cyclic_clip_stays_closed) {
    Random random(4);
    const Motion motion = random_motion(random, 9, 40);
    const PackedClip clip = pack_clip(motion, {});
    std::vector<Transform> first(9), last(9);
    const Leaf start{0, 0, 1}, end{0, clip.duration(), 1};
    sample_pose(*motion.skeleton, {&clip, 1}, {&start, 1}, first);
    sample_pose(*motion.skeleton, {&clip, 1}, {&end, 1}, last);
    for (std::size_t j = 0; j < 9; ++j) {
        EXPECT_LT(distance(first[j].translation, last[j].translation), 1e-4f);
        EXPECT_LT(rotation_angle(conjugate(first[j].rotation) * last[j].rotation), 1e-3f);
    }
}

TEST(PackClip, along_travel_the_root_heads_straight_and_the_world_stays_as_it_was) {
    Random random(5);
    for (int round = 0; round < 5; ++round) {
        const Motion motion = random_motion(random, 9, 40);
        PackOptions options;
        options.along_travel = true;
        PackReport report;
        const PackedClip clip = pack_clip(motion, {}, options, &report);
        EXPECT_NEAR(clip.velocity.x, 0, 1e-3);
        EXPECT_GT(clip.velocity.z, 1.2f);
        EXPECT_LT(report.error, 0.3f * k_millimetre);
    }
}

TEST(PackClip, without_a_steady_root_the_root_is_the_motions_own) {
    Random random(6);
    const Motion motion = random_motion(random, 5, 20);
    PackOptions options;
    options.steady_root = false;
    PackReport report;
    const PackedClip clip = pack_clip(motion, {}, options, &report);
    for (int f = 0; f < 20; ++f)
        EXPECT_LT(distance(clip.root[static_cast<std::size_t>(f)].position,
                           between(motion.root[0], motion.root[static_cast<std::size_t>(f)]).position),
                  1e-6f);
    EXPECT_LT(report.error, 0.3f * k_millimetre);
}

TEST(PackClip, a_joint_that_spins_is_flagged_and_still_right_between_frames) {
    Random random(7);
    const auto skeleton = std::make_shared<Skeleton>(random_skeleton(random, 20));
    Motion motion = make_motion(skeleton, "spin", 41, 30);
    for (int f = 0; f < 41; ++f) {
        Quat& q = motion.frame(f)[10].rotation;
        q = normalized(q * axis_angle({0, 1, 0}, 9.0f * static_cast<float>(f) * k_radians_per_degree));  // a full turn
        if (f % 3 == 0) q = -q;  // signs as files have them
    }
    const PackedClip clip = pack_clip(motion, {});
    ASSERT_EQ(clip.turning_blocks.size(), 3u);
    EXPECT_EQ(clip.turning_blocks[0], 0);
    EXPECT_EQ(clip.turning_blocks[1], 1);
    std::vector<Transform> locals(20);
    for (float at = 0; at <= 40; at += 0.37f) {
        const Leaf leaf{0, at / 30, 1};
        sample_pose(*skeleton, {&clip, 1}, {&leaf, 1}, locals);
        const Quat wanted = skeleton->rest[10].rotation * axis_angle({0, 1, 0}, 9.0f * at * k_radians_per_degree);
        EXPECT_LT(rotation_angle(conjugate(wanted) * locals[10].rotation), 1e-3f) << "frame " << at;
    }
}

TEST(PackClip, translations_at_rest_are_dropped) {
    Random random(8);
    const Motion motion = random_motion(random, 30, 10);
    PackOptions options;
    options.steady_root = false;
    const PackedClip clip = pack_clip(motion, {}, options);
    ASSERT_EQ(clip.moving.size(), 1u);
    EXPECT_EQ(clip.moving[0], 0);
}

ClipFacts strikes(std::initializer_list<std::pair<Side, float>> list) {
    ClipFacts facts;
    for (const auto& [foot, time] : list) facts.events.push_back({foot, StrideEvent::strike, time});
    facts.events.push_back({Side::left, StrideEvent::toe_off, 0.1f});
    return facts;
}

TEST(PackClip, strikes_become_the_phase_map) {
    Random random(9);
    const Motion motion = random_motion(random, 3, 31);  // one second
    const PackedClip even = pack_clip(motion, strikes({{Side::left, 0}, {Side::right, 0.48f}}));
    EXPECT_EQ(even.cycles, 1);
    EXPECT_NEAR(phase_at(even, 0), 0, 1e-5);
    EXPECT_NEAR(phase_at(even, 0.48f), 0.5, 1e-5);
    // Begins between a left and a right strike.
    const PackedClip later = pack_clip(motion, strikes({{Side::right, 0.2f}, {Side::left, 0.7f}}));
    EXPECT_EQ(problem(later), "");
    EXPECT_NEAR(phase_at(later, 0), 0.3f, 1e-5);
    EXPECT_NEAR(time_at(later, 0), 0.7f, 1e-5);
    EXPECT_NEAR(time_at(later, 0.5f), 0.2f, 1e-5);
    // Begins between a right and a left strike.
    const PackedClip before = pack_clip(motion, strikes({{Side::left, 0.25f}, {Side::right, 0.75f}}));
    EXPECT_NEAR(phase_at(before, 0), 0.75f, 1e-5);
    EXPECT_NEAR(time_at(before, 0), 0.25f, 1e-5);
    // Two cycles, and the seam's strike reported at both ends.
    const PackedClip two = pack_clip(
        motion,
        strikes({{Side::left, 0}, {Side::right, 0.2f}, {Side::left, 0.5f}, {Side::right, 0.8f}, {Side::left, 1.0f}}));
    EXPECT_EQ(problem(two), "");
    EXPECT_EQ(two.cycles, 2);
    EXPECT_NEAR(time_at(two, 1), 0.5f, 1e-5);
    EXPECT_NEAR(time_at(two, 1.5f), 0.8f, 1e-5);
}

TEST(PackClip, strikes_that_do_not_alternate_give_no_phase) {
    Random random(10);
    Motion motion = random_motion(random, 3, 31);
    EXPECT_EQ(pack_clip(motion, strikes({{Side::left, 0}, {Side::left, 0.5f}})).cycles, 0);
    EXPECT_EQ(pack_clip(motion, strikes({{Side::left, 0}, {Side::right, 0.3f}, {Side::left, 0.6f}})).cycles, 0);
    EXPECT_EQ(pack_clip(motion, strikes({{Side::left, 0}})).cycles, 0);
    motion.cyclic = false;
    EXPECT_EQ(pack_clip(motion, strikes({{Side::left, 0}, {Side::right, 0.5f}})).cycles, 0);
}

TEST(PackClip, a_pose_becomes_a_clip_of_two_frames) {
    Random random(11);
    const PackedClip clip = pack_clip(random_motion(random, 6, 1), {});
    EXPECT_EQ(clip.frame_count, 2);
    EXPECT_EQ(problem(clip), "");
}

TEST(PackClip, an_unsound_motion_is_refused_with_the_joints_name) {
    Random random(12);
    Motion motion = random_motion(random, 6, 5);
    motion.frame(3)[4].rotation.x = std::nanf("");
    try {
        pack_clip(motion, {});
        FAIL() << "packed a NaN";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("joint4"), std::string::npos) << error.what();
    }
}

TEST(PackClip, real_walks_and_runs_stay_within_a_tenth_of_a_millimetre) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const char* name : {"07_01.bvh", "07_12.bvh", "02_03.bvh"}) {
        const std::string path = (folder / "cmu_bvh" / name).string();
        LoadResult loaded = load_clips({&path, 1});
        ASSERT_EQ(loaded.clips.size(), 1u) << name;
        Motion motion = std::move(loaded.clips[0].motion);
        std::vector<Transform> models(motion.skeleton->rest.size());
        local_to_model(*motion.skeleton, motion.frame(0), models);
        extract_root_motion(motion, find_roles(*motion.skeleton, models).roles);
        PackReport report;
        const PackedClip clip = pack_clip(motion, {}, {}, &report);
        std::printf(
            "%s: error %.3f mm at joint '%s', %zu of %zu bytes (%.1f : 1), steady root within %.1f cm and %.1f "
            "degrees\n",
            name, report.error * 1e3, motion.skeleton->names[static_cast<std::size_t>(report.error_joint)].c_str(),
            report.bytes, report.raw_bytes, static_cast<double>(report.raw_bytes) / static_cast<double>(report.bytes),
            report.root_deviation * 1e2, report.root_deviation_yaw * k_degrees_per_radian);
        EXPECT_LT(report.error, 0.1f * k_millimetre) << name;
        EXPECT_TRUE(clip.turning_blocks.empty());
    }
}

}  // namespace
}  // namespace surefoot
