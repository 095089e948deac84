#include <surefoot/bake/character.h>
#include <surefoot/synthetic/gait_cycle.h>

#include "tests/bake/synthetic_clips.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_dt = 1.0f / 120;

/// The default set and a deep, stiff-armed prowl, as a style of the whole body and as one of the upper body.
const Character& styled_character() {
    static const Character character = [] {
        std::vector<AnalyzedClip> clips = test::synthetic_clips();
        std::vector<ProjectSpace> spaces = test::spaces_for(clips);
        ProjectSpace prowl;
        prowl.name = "style:prowl";
        prowl.space.axes = {{"speed", "m/s", 0, 2, false}};
        for (const float speed : {0.7f, 1.3f}) {
            const std::vector<GaitParameters> gaits = synthetic_gaits();
            GaitParameters gait =
                *std::find_if(gaits.begin(), gaits.end(), [](const auto& g) { return g.name == "walk"; });
            gait.name = "prowl";
            gait.forward = speed;
            gait.intervals = 76;
            gait.straightest_knee = 38;
            gait.lean = 18;
            gait.arm_swing = 4;
            gait.elbow = 80;
            AnalyzedClip clip = clips[1];
            clip.motion = make_gait_cycle(make_biped(), gait);
            clip.motion.skeleton = clips[0].motion.skeleton;
            clip.facts.name = "prowl";
            clip.facts.speed = clip.facts.forward = speed;
            clip.facts.turn = clip.facts.lateral = clip.facts.travel = 0;
            clip.facts.duty = gait.duty;
            clip.facts.events = {{Side::left, StrideEvent::strike, 0},
                                 {Side::right, StrideEvent::strike, 0.5f * clip.motion.duration()}};
            prowl.space.samples.push_back({speed});
            prowl.clips.push_back(static_cast<int>(clips.size()));
            clips.push_back(std::move(clip));
        }
        triangulate(prowl.space);
        ProjectSpace upper = prowl;
        upper.name = "style:hands up";
        upper.upper_body = true;
        spaces.push_back(prowl);
        spaces.push_back(upper);
        return bake_character(clips, spaces, "styled");
    }();
    return character;
}

struct Walked {
    RootFrame end;
    float slide = 0;  ///< [m/s] of heels and balls that lie on the ground
    float hips = 0;   ///< [m] mean height
    int leaves_most = 0;
};

Walked walk(LocomotionRequest request, std::int32_t style, float weight) {
    const Character& character = styled_character();
    request.style = style;
    request.style_weight = weight;
    const std::size_t joints = character.skeleton->rest.size();
    std::vector<Transform> locals(joints), models(joints);
    LocomotionState state;
    Walked result;
    std::array<Vec3, 4> last{};
    int planted = 0;
    constexpr int k_frames = 480;
    for (int f = 0; f < k_frames; ++f) {
        const LocomotionFrame frame = update(character.graph, state, request, k_dt);
        result.end = result.end * frame.root_delta;
        result.leaves_most = std::max(result.leaves_most, frame.leaf_count);
        pose(character.graph, frame, locals);
        local_to_model(*character.skeleton, locals, models);
        result.hips += models[static_cast<std::size_t>(character.legs.hips)].translation.y / k_frames;
        for (std::size_t i = 0; i < 4; ++i) {
            const Leg& leg = character.legs.side[i / 2];
            const Transform foot = to_transform(result.end) * models[static_cast<std::size_t>(leg.foot)];
            const Vec3 point = transform_point(foot, i % 2 ? leg.ball : leg.heel);
            constexpr float k_down = 0.002f;  // [m]
            if (f > 0 && point.y < k_down && last[i].y < k_down) {
                result.slide += planar_length(point - last[i]) / k_dt;
                ++planted;
            }
            last[i] = point;
        }
    }
    EXPECT_GT(planted, k_frames / 2);
    result.slide /= static_cast<float>(std::max(planted, 1));
    return result;
}

const LocomotionRequest k_ways[] = {{1.2f, 0, 0}, {0.8f, 45, 0}, {1.5f, -30, 0}, {0.5f, 0, 0.4f}};

TEST(Style, the_root_goes_where_it_goes_without_a_style_at_any_weight) {
    for (const LocomotionRequest& way : k_ways) {
        const Walked plain = walk(way, -1, 0);
        for (const float weight : {0.25f, 0.5f, 1.0f}) {
            EXPECT_EQ(walk(way, 0, weight).end, plain.end);
            EXPECT_EQ(walk(way, 1, weight).end, plain.end);
        }
    }
}

TEST(Style, planted_feet_stay_planted_though_the_styles_clips_go_straight) {
    for (const LocomotionRequest& way : k_ways) {
        const float plain = walk(way, -1, 0).slide;
        for (const float weight : {0.5f, 1.0f}) {
            const float styled = walk(way, 0, weight).slide;
            RecordProperty("slide", std::to_string(styled));
            // A tenth of a millimetre a frame is what packing and solving leave.
            EXPECT_LT(styled, std::max(2 * plain, 0.012f))
                << way.speed << " m/s " << way.turn << " deg/s at " << weight;
        }
    }
}

TEST(Style, the_body_takes_it_on_by_its_weight) {
    const float plain = walk(k_ways[0], -1, 0).hips, half = walk(k_ways[0], 0, 0.5f).hips,
                all = walk(k_ways[0], 0, 1).hips;
    EXPECT_LT(all, plain - 0.05f) << "a prowl is lower";
    EXPECT_NEAR(half, 0.5f * (plain + all), 0.02f);
}

TEST(Style, of_the_upper_body_leaves_hips_and_legs_to_the_bit) {
    const Character& character = styled_character();
    const std::size_t joints = character.skeleton->rest.size();
    std::vector<Transform> plain(joints), styled(joints);
    LocomotionState a, b;
    LocomotionRequest request{1.0f, 30, 0};
    float moved = 0;
    for (int f = 0; f < 200; ++f) {
        request.style_weight = 0;
        pose(character.graph, update(character.graph, a, request, k_dt), plain);
        request.style = 1;
        request.style_weight = 0.7f;
        pose(character.graph, update(character.graph, b, request, k_dt), styled);
        for (std::size_t j = 0; j < joints; ++j) {
            const bool above = character.graph.styles[1].mask[j] > 0;
            if (!above) {
                ASSERT_EQ(plain[j], styled[j]) << character.skeleton->names[j];
            }
            moved = std::max(moved, rotation_angle(conjugate(plain[j].rotation) * styled[j].rotation));
        }
    }
    EXPECT_GT(moved, 0.3f);
    EXPECT_EQ(a, b) << "the state does not know of styles";
}

TEST(Style, one_that_is_not_there_or_weighs_nothing_changes_nothing) {
    const Character& character = styled_character();
    const std::size_t joints = character.skeleton->rest.size();
    std::vector<Transform> plain(joints), styled(joints);
    LocomotionState a, b;
    for (const auto& [style, weight] : {std::pair{7, 1.0f}, std::pair{-1, 1.0f}, std::pair{0, 0.0f}}) {
        LocomotionRequest request{1.0f, 30, 0};
        pose(character.graph, update(character.graph, a, request, k_dt), plain);
        request.style = style;
        request.style_weight = weight;
        pose(character.graph, update(character.graph, b, request, k_dt), styled);
        EXPECT_EQ(plain, styled);
    }
}

TEST(Style, one_fades_out_before_another_fades_in) {
    LocomotionRequest now, wanted;
    now.style = 0, now.style_weight = 1;
    wanted.style = 1, wanted.style_weight = 0.5f;
    float last = 1;
    for (int f = 0; f < 200; ++f) {
        now = approach(now, wanted, 0.01f);
        EXPECT_LE(std::fabs(now.style_weight - last), 0.0201f);
        last = now.style_weight;
    }
    EXPECT_EQ(now.style, 1);
    EXPECT_EQ(now.style_weight, 0.5f);
}

TEST(Style, what_cannot_be_is_said) {
    LocomotionGraph graph = styled_character().graph;
    ASSERT_EQ(problem(graph), "");
    graph.styles[1].mask[static_cast<std::size_t>(styled_character().legs.side[0].foot)] = 1;
    EXPECT_NE(problem(graph).find("hips and legs"), std::string::npos) << problem(graph);
    graph.styles[1].mask.pop_back();
    EXPECT_NE(problem(graph).find("does not match the joints"), std::string::npos);
    graph = styled_character().graph;
    graph.styles[0].space.axes[0] = RequestAxis::turn;
    EXPECT_NE(problem(graph).find("speed alone"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
