#include <surefoot/clip/sample.h>

#include "tests/support/random_clips.h"

#include <gtest/gtest.h>

#include <bit>

namespace surefoot {
namespace {

using namespace surefoot::test;

std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }
void expect_same_bits(const Transform& a, const Transform& b, const std::string& what) {
    const float x[7] = {a.rotation.x,    a.rotation.y,    a.rotation.z,   a.rotation.w,
                        a.translation.x, a.translation.y, a.translation.z};
    const float y[7] = {b.rotation.x,    b.rotation.y,    b.rotation.z,   b.rotation.w,
                        b.translation.x, b.translation.y, b.translation.z};
    for (int i = 0; i < 7; ++i) ASSERT_EQ(bits_of(x[i]), bits_of(y[i])) << what << ", component " << i;
}

struct Stage {
    Skeleton skeleton;
    std::vector<PackedClip> clips;
};
Stage random_stage(std::uint64_t seed, int joints, int clips) {
    Random random(seed);
    Stage stage{random_skeleton(random, joints), {}};
    for (int c = 0; c < clips; ++c)
        stage.clips.push_back(random_clip(random, stage.skeleton, 5 + static_cast<int>(random.below(20))));
    return stage;
}

TEST(SamplePose, the_vector_kernel_gives_the_scalar_twins_bits) {
    Random random(1);
    for (const int joints : {1, 2, 7, 8, 9, 23, 64, 67, 130}) {
        Stage stage = random_stage(static_cast<std::uint64_t>(joints), joints, 4);
        if (joints % 2 == 1)  // every other skeleton takes the path with sign tests
            stage.clips[1].turning_blocks.assign(static_cast<std::size_t>(stage.clips[1].block_count()), 1);
        std::vector<Transform> a(static_cast<std::size_t>(joints)), b(a.size());
        for (int round = 0; round < 20; ++round) {
            std::vector<Leaf> leaves;
            for (int i = 0; i <= round % 6; ++i)
                leaves.push_back({static_cast<std::int32_t>(random.below(4)), random.between(-0.1f, 1.0f),
                                  random.between(0.01f, 1)});
            sample_pose(stage.skeleton, stage.clips, leaves, a);
            sample_pose_scalar(stage.skeleton, stage.clips, leaves, b);
            for (int j = 0; j < joints; ++j)
                expect_same_bits(a[static_cast<std::size_t>(j)], b[static_cast<std::size_t>(j)],
                                 "joint " + std::to_string(j));
        }
    }
}

TEST(SamplePose, a_lone_clip_on_a_frame_is_that_frame) {
    const Stage stage = random_stage(2, 19, 1);
    const PackedClip& clip = stage.clips[0];
    std::vector<Transform> locals(19);
    for (int f = 0; f < clip.frame_count; ++f) {
        const Leaf leaf{0, static_cast<float>(f) / clip.fps, 0.3f};
        sample_pose(stage.skeleton, stage.clips, {&leaf, 1}, locals);
        for (int j = 0; j < 19; ++j) {
            EXPECT_LT(
                rotation_angle(conjugate(get_rotation(clip, f, j)) * locals[static_cast<std::size_t>(j)].rotation),
                1e-5f);
            EXPECT_NEAR(dot(locals[static_cast<std::size_t>(j)].rotation, locals[static_cast<std::size_t>(j)].rotation),
                        1, 1e-6);
        }
        EXPECT_LT(distance(locals[5].translation, clip.translations[static_cast<std::size_t>(2 * f + 1)]), 1e-6f);
        EXPECT_EQ(locals[6].translation, stage.skeleton.rest[6].translation);
    }
}

void expect_normalised_sum(const Leaf (&leaves)[3]) {
    const Stage stage = random_stage(3, 30, 3);
    std::vector<Transform> locals(30);
    sample_pose(stage.skeleton, stage.clips, leaves, locals);
    const int frames[3] = {2, 1, 3};
    const double shares[3] = {0.25, 0.5, 0.75};
    for (int j = 0; j < 30; ++j) {
        double sum[4] = {};
        for (int l = 0; l < 3; ++l)
            for (int k = 0; k < 2; ++k) {
                const Quat q = get_rotation(stage.clips[static_cast<std::size_t>(l)], frames[l] + k, j);
                const double w = static_cast<double>(leaves[l].weight) * (k == 0 ? 1 - shares[l] : shares[l]);
                sum[0] += w * q.x, sum[1] += w * q.y, sum[2] += w * q.z, sum[3] += w * q.w;
            }
        const Quat wanted = normalized(Quat{static_cast<float>(sum[0]), static_cast<float>(sum[1]),
                                            static_cast<float>(sum[2]), static_cast<float>(sum[3])});
        EXPECT_LT(rotation_angle(conjugate(wanted) * locals[static_cast<std::size_t>(j)].rotation), 1e-4f)
            << "joint " << j;
    }
}

TEST(SamplePose, a_blend_is_the_normalised_weighted_sum) {
    expect_normalised_sum({{0, 2.25f / 30, 0.5f}, {1, 1.5f / 30, 0.3f}, {2, 3.75f / 30, 0.2f}});
}

TEST(SamplePose, so_it_is_where_some_weights_are_negative) {
    expect_normalised_sum({{0, 2.25f / 30, -0.2f}, {1, 1.5f / 30, 1.25f}, {2, 3.75f / 30, -0.05f}});
}

TEST(SamplePose, only_the_ratio_of_weights_counts) {
    const Stage stage = random_stage(4, 12, 2);
    const Leaf one[2] = {{0, 0.1f, 0.25f}, {1, 0.05f, 0.75f}}, four[2] = {{0, 0.1f, 1}, {1, 0.05f, 3}};
    std::vector<Transform> a(12), b(12);
    sample_pose(stage.skeleton, stage.clips, one, a);
    sample_pose(stage.skeleton, stage.clips, four, b);
    for (std::size_t j = 0; j < 12; ++j) expect_same_bits(a[j], b[j], "joint " + std::to_string(j));
}

TEST(SamplePose, times_beyond_the_ends_give_the_ends) {
    const Stage stage = random_stage(5, 9, 1);
    std::vector<Transform> a(9), b(9);
    const Leaf late{0, 1e6f, 1}, last{0, stage.clips[0].duration(), 1};
    sample_pose(stage.skeleton, stage.clips, {&late, 1}, a);
    sample_pose(stage.skeleton, stage.clips, {&last, 1}, b);
    for (std::size_t j = 0; j < 9; ++j) expect_same_bits(a[j], b[j], "after the end");
    const Leaf early{0, -5, 1}, first{0, 0, 1};
    sample_pose(stage.skeleton, stage.clips, {&early, 1}, a);
    sample_pose(stage.skeleton, stage.clips, {&first, 1}, b);
    for (std::size_t j = 0; j < 9; ++j) expect_same_bits(a[j], b[j], "before the start");
}

// One joint at 170 degrees in one clip and 190 in the other: half way is 180, not the 0 that opposite signs give.
TEST(SamplePose, joints_that_turn_far_blend_on_the_near_side) {
    Stage stage = random_stage(6, 3, 2);
    for (Transform& rest : stage.skeleton.rest) rest.rotation = {};
    const auto turn = [](float degrees) { return axis_angle({1, 0, 0}, degrees * k_radians_per_degree); };
    for (int f = 0; f < stage.clips[0].frame_count; ++f) set_rotation(stage.clips[0], f, 1, turn(170));
    for (int f = 0; f < stage.clips[1].frame_count; ++f) set_rotation(stage.clips[1], f, 1, -turn(190));
    const Leaf leaves[2] = {{0, 0.05f, 1}, {1, 0.05f, 1}};
    std::vector<Transform> locals(3);
    stage.clips[1].turning_blocks = {1};
    sample_pose(stage.skeleton, stage.clips, leaves, locals);
    EXPECT_LT(rotation_angle(conjugate(turn(180)) * locals[1].rotation), 1e-3f);
}

TEST(SamplePose, a_joint_that_turns_far_is_extrapolated_on_the_near_side) {
    Stage stage = random_stage(6, 3, 2);
    for (Transform& rest : stage.skeleton.rest) rest.rotation = {};
    const auto turn = [](float degrees) { return axis_angle({1, 0, 0}, degrees * k_radians_per_degree); };
    for (int f = 0; f < stage.clips[0].frame_count; ++f) set_rotation(stage.clips[0], f, 1, turn(170));
    for (int f = 0; f < stage.clips[1].frame_count; ++f) set_rotation(stage.clips[1], f, 1, -turn(190));
    stage.clips[1].turning_blocks = {1};
    std::vector<Transform> locals(3), twin(3);
    for (const auto& [taken, added, wanted] : {std::tuple{0, 1, 195.0f}, std::tuple{1, 0, 165.0f}})
        for (const bool taken_first : {true, false}) {
            const Leaf off{taken, 0.05f, -0.25f}, on{added, 0.05f, 1.25f};
            const Leaf leaves[2] = {taken_first ? off : on, taken_first ? on : off};
            sample_pose(stage.skeleton, stage.clips, leaves, locals);
            EXPECT_LT(rotation_angle(conjugate(turn(wanted)) * locals[1].rotation), 2e-3f) << wanted;
            sample_pose_scalar(stage.skeleton, stage.clips, leaves, twin);
            for (std::size_t j = 0; j < 3; ++j) expect_same_bits(locals[j], twin[j], "the twin");
        }
}

TEST(SamplePose, keys_that_cancel_give_numbers_still) {
    Stage stage = random_stage(7, 8, 1);
    PackedClip& clip = stage.clips[0];
    for (int j = 0; j < 8; ++j) {
        set_rotation(clip, 0, j, {1, 0, 0, 0});
        set_rotation(clip, 1, j, {-1, 0, 0, 0});
    }
    std::vector<Transform> locals(8);
    const Leaf leaf{0, 0.5f / clip.fps, 1};
    sample_pose(stage.skeleton, stage.clips, {&leaf, 1}, locals);
    for (const Transform& t : locals) EXPECT_TRUE(is_finite(t.rotation));
}

TEST(LocalToModel, eight_characters_get_the_bits_that_each_alone_gets) {
    for (const int joints : {1, 8, 23, 67}) {
        const Stage stage = random_stage(8, joints, 3);
        const auto count = static_cast<std::size_t>(joints);
        std::vector<Transform> locals[8];
        std::vector<Matrix34> models[8], scalar[8];
        const Transform* in[8];
        Matrix34 *out[8], *out_scalar[8];
        for (int c = 0; c < 8; ++c) {
            locals[c].resize(count);
            models[c].resize(count);
            scalar[c].resize(count);
            const Leaf leaves[2] = {{c % 3, 0.013f * static_cast<float>(c), 0.7f}, {(c + 1) % 3, 0.02f, 0.3f}};
            sample_pose(stage.skeleton, stage.clips, leaves, locals[c]);
            in[c] = locals[c].data();
            out[c] = models[c].data();
            out_scalar[c] = scalar[c].data();
        }
        std::vector<float> scratch(model_scratch_floats(joints));
        local_to_model_8(stage.skeleton, in, out, scratch.data());
        local_to_model_8_scalar(stage.skeleton, in, out_scalar, scratch.data());
        std::vector<Transform> alone(count);
        for (int c = 0; c < 8; ++c) {
            local_to_model(stage.skeleton, locals[c], alone);
            for (std::size_t j = 0; j < count; ++j) {
                const Matrix34 wanted = to_matrix(alone[j]);
                for (int i = 0; i < 12; ++i) {
                    ASSERT_EQ(bits_of(models[c][j].m[i]), bits_of(wanted.m[i]))
                        << "character " << c << ", joint " << j << ", " << i;
                    ASSERT_EQ(bits_of(scalar[c][j].m[i]), bits_of(wanted.m[i])) << "scalar, joint " << j;
                }
            }
        }
    }
}

TEST(Phase, time_and_phase_are_each_others_inverse) {
    const Stage stage = random_stage(9, 4, 1);
    const PackedClip& clip = stage.clips[0];
    for (float t = 0; t < clip.duration(); t += 0.007f) EXPECT_NEAR(time_at(clip, phase_at(clip, t)), t, 1e-5);
}

TEST(Phase, strikes_lie_where_the_map_says_in_any_cycle) {
    const Stage stage = random_stage(10, 4, 1);
    const PackedClip& clip = stage.clips[0];
    for (const float cycle : {-7.0f, 0.0f, 1.0f, 40.0f}) {
        EXPECT_NEAR(time_at(clip, cycle + 0.5f), 0.3f * clip.duration(), 1e-4);
        EXPECT_NEAR(time_at(clip, cycle), 0.7f * clip.duration(), 1e-4);
    }
    // The slope is the derivative.
    const float step = 1e-3f;
    EXPECT_NEAR(phase_time(clip, 0.6f).slope, (time_at(clip, 0.6f + step) - time_at(clip, 0.6f)) / step, 1e-3);
}

TEST(ClipRoot, passes_add_up) {
    Random random(11);
    const Skeleton skeleton = random_skeleton(random, 3);
    PackedClip clip = random_clip(random, skeleton, 31);
    clip.root.edit([](std::vector<RootFrame>& root) {
        for (int f = 0; f <= 30; ++f)
            root[static_cast<std::size_t>(f)] = {{0, 0, 0.05f * static_cast<float>(f)}, 0.02f * static_cast<float>(f)};
    });
    clip.travel = clip.root.back();
    const RootFrame thrice = clip.travel * clip.travel * clip.travel * clip.root[15];
    const RootFrame got = clip_root(clip, 3.5f);
    EXPECT_LT(distance(got.position, thrice.position), 1e-5f);
    EXPECT_NEAR(got.yaw, thrice.yaw, 1e-5);
    EXPECT_LT(distance((clip_root(clip, 1.0f) * between(clip_root(clip, -1.0f), RootFrame{})).position,
                       (clip.travel * clip.travel).position),
              1e-5f);
}

TEST(PackedClip, each_fault_is_told) {
    const Stage stage = random_stage(12, 9, 1);
    const PackedClip& sound = stage.clips[0];
    EXPECT_EQ(problem(sound), "");
    const auto shorten = [](auto& table) { table.edit([](auto& values) { values.pop_back(); }); };
    const auto fault = [&](auto change) {
        PackedClip clip = sound;
        change(clip);
        return problem(clip);
    };
    EXPECT_NE(fault([](auto& c) { c.frame_count = 1; }).find("fewer than two frames"), std::string::npos);
    EXPECT_NE(fault([&](auto& c) { shorten(c.rotations); }).find("rotations"), std::string::npos);
    EXPECT_NE(fault([](auto& c) { c.moving[1] = 9; }).find("moving joints"), std::string::npos);
    EXPECT_NE(fault([&](auto& c) { shorten(c.translations); }).find("translations"), std::string::npos);
    EXPECT_NE(fault([&](auto& c) { shorten(c.root); }).find("root"), std::string::npos);
    EXPECT_NE(fault([](auto& c) { c.phase_map[1][1] = 0.1f; }).find("ascend"), std::string::npos);
    EXPECT_NE(fault([](auto& c) { c.cycles = 0; }).find("cycle count"), std::string::npos);
    EXPECT_NE(fault([](auto& c) { c.fps = 0; }).find("frame rate"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
