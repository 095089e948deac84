#include <surefoot/analysis/analyze.h>
#include <surefoot/bake/character.h>
#include <surefoot/base/error.h>
#include <surefoot/space/triangulate.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/bake/synthetic_clips.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

using test::spaces_for;
using test::synthetic_clips;

TEST(Character, the_generated_set_bakes_and_walks_as_asked) {
    const auto clips = synthetic_clips();
    const Character character = bake_character(clips, spaces_for(clips), "default");
    EXPECT_EQ(problem(character.graph), "");
    EXPECT_EQ(character.facts.size(), character.graph.clips.size());
    for (std::size_t i = 0; i < character.packing.size(); ++i) {
        EXPECT_LT(character.packing[i].error, 1e-4f) << character.facts[i].name;
        EXPECT_LT(character.packing[i].root_deviation, 0.01f) << "made with a steady root: " << character.facts[i].name;
    }
    std::vector<Transform> locals(character.skeleton->rest.size());
    for (const LocomotionRequest request :
         {LocomotionRequest{1.4f, 0, 0}, {2.2f, 30, 0}, {0.5f, -20, 0}, {0, 60, 0}, {-0.6f, 0, 0}}) {
        LocomotionState state;
        RootFrame root;
        for (int i = 0; i < 600; ++i) {
            const LocomotionFrame frame = update(character.graph, state, request, 1.0f / 60);
            ASSERT_FALSE(frame.clamped) << request.speed << " m/s";
            root = root * frame.root_delta;
            pose(character.graph, frame, locals);
        }
        const RootFrame wanted = integrate({0, 0, request.speed}, request.turn * k_radians_per_degree, 10);
        EXPECT_LT(distance(root.position, wanted.position), 0.02f);
        EXPECT_NEAR(root.yaw, wanted.yaw, 1e-3);
    }
}

TEST(Character, strafes_come_from_the_lateral_space) {
    const auto clips = synthetic_clips();
    const Character character = bake_character(clips, spaces_for(clips));
    LocomotionState state;
    const LocomotionFrame frame = update(character.graph, state, {0, 0, 0.5f}, 1.0f / 60);
    EXPECT_NEAR(frame.velocity.x, 0.5f, 0.01f);
    EXPECT_NEAR(frame.velocity.z, 0, 0.02f);
}

TEST(Character, the_order_of_threads_does_not_show) {
    const auto clips = synthetic_clips();
    const Character a = bake_character(clips, spaces_for(clips)), b = bake_character(clips, spaces_for(clips));
    for (std::size_t i = 0; i < a.graph.clips.size(); ++i) {
        EXPECT_EQ(a.graph.clips[i].name, b.graph.clips[i].name);
        EXPECT_EQ(a.graph.clips[i].rotations, b.graph.clips[i].rotations);
        EXPECT_EQ(a.graph.clips[i].translations, b.graph.clips[i].translations);
    }
}

TEST(Character, what_does_not_fit_is_refused_with_a_reason) {
    auto clips = synthetic_clips();
    const auto spaces = spaces_for(clips);
    const auto refusal = [](auto bake) -> std::string {
        try {
            bake();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    auto broken = spaces;
    broken[0].clips[0] = 99;
    EXPECT_NE(refusal([&] { bake_character(clips, broken); }).find("a sample names a clip that is not there"),
              std::string::npos);
    EXPECT_NE(refusal([&] { bake_character(clips, std::vector<ProjectSpace>{}); }).find("no blend space has any clip"),
              std::string::npos);
    auto other = std::make_shared<Skeleton>(*clips[3].motion.skeleton);
    other->names[2] = "stranger";
    clips[3].motion.skeleton = other;
    EXPECT_NE(refusal([&] { bake_character(clips, spaces); }).find("joints are not those of the other clips"),
              std::string::npos);
}

TEST(Character, heels_are_no_longer_than_its_clips_put_them_down) {
    auto clips = synthetic_clips();
    const Legs made = clips.front().legs;
    for (AnalyzedClip& clip : clips)
        for (Leg& leg : clip.legs.side) leg.heel += leg.forward * dot(leg.heel, leg.forward);  // twice as far back
    const Character character = bake_character(clips, spaces_for(clips));
    for (std::size_t side = 0; side < 2; ++side) {
        const Leg &leg = character.legs.side[side], &was = made.side[side];
        EXPECT_NEAR(dot(leg.heel, leg.forward), dot(was.heel, was.forward), 0.015f);
    }
}

TEST(Character, clips_on_a_skeleton_of_other_proportions_keep_their_own) {
    auto clips = synthetic_clips();
    auto longer = std::make_shared<Skeleton>(*clips[1].motion.skeleton);
    longer->rest[3].translation *= 1.1f;
    clips[1].motion.skeleton = longer;
    const Character character = bake_character(clips, spaces_for(clips));
    EXPECT_LT(character.packing[1].error, 1e-4f);
}

}  // namespace
}  // namespace surefoot
