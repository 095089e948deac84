// The generated default set, whose every number is known: what analysis says of it against what made it.

#include <surefoot/base/error.h>
#include <surefoot/motion/edit.h>
#include <surefoot/motion/root_motion.h>
#include <surefoot/synthetic/gait_cycle.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <algorithm>

#include "tests/analysis/support.h"

namespace surefoot {
namespace {

const ClipSet& synthetic_set() {
    static const ClipSet set = make_synthetic_set();
    return set;
}

AnalyzedClip facts_of(const Motion& motion) { return analyze_clip(motion, "made"); }

/// One clip of the set beside the parameters that made it.
class Generated : public ::testing::TestWithParam<std::size_t> {
  protected:
    const Motion& motion() const { return synthetic_set().clips[GetParam()]; }
    GaitParameters gait() const { return synthetic_gaits()[GetParam()]; }
    bool steps() const { return gait().duty < 1; }
    bool on_the_spot() const { return steps() && gait().forward == 0 && gait().lateral == 0; }
    float speed() const { return std::sqrt(gait().forward * gait().forward + gait().lateral * gait().lateral); }
};

std::string name_of(const ::testing::TestParamInfo<std::size_t>& info) { return synthetic_gaits()[info.param].name; }
INSTANTIATE_TEST_SUITE_P(SyntheticSet, Generated, ::testing::Range<std::size_t>(0, synthetic_gaits().size()), name_of);

TEST_P(Generated, has_the_figures_that_made_it) {
    const ClipFacts facts = facts_of(motion()).facts;
    EXPECT_EQ(facts.name, gait().name);
    EXPECT_EQ(facts.frames, motion().frame_count());
    EXPECT_EQ(facts.joints, motion().joint_count());
    EXPECT_FLOAT_EQ(facts.duration, motion().duration());
    EXPECT_NEAR(facts.forward, gait().forward, 1e-3f);
    EXPECT_NEAR(facts.lateral, gait().lateral, 1e-3f);
    EXPECT_NEAR(std::fabs(facts.speed), speed(), 1e-3f);
    EXPECT_EQ(facts.speed < 0, gait().forward < 0);
    EXPECT_NEAR(facts.turn, gait().turn, 0.01f);
    EXPECT_NEAR(facts.slope, 0, 0.01f);
    EXPECT_NEAR(facts.cadence, steps() ? 120 / motion().duration() : 0, 0.01f);
    EXPECT_NEAR(facts.stride, steps() ? speed() * motion().duration() : 0, 2e-3f);
    if (speed() > 0) {
        const float travel = atan2(gait().lateral, gait().forward) * k_degrees_per_radian;
        EXPECT_NEAR(std::fabs(facts.travel), std::fabs(travel), 0.1f);  // ±180 are the same direction
    }
    EXPECT_TRUE(facts.cyclic);
    EXPECT_FALSE(facts.in_place);
    EXPECT_TRUE(facts.locomotion) << facts.not_locomotion;
    EXPECT_TRUE(facts.warnings.empty()) << facts.warnings.front();
    EXPECT_LT(facts.seam, 1e-4f);
    EXPECT_LT(facts.loop_error, 1e-4f);
    EXPECT_LT(facts.skate, 0.04f);  // soles are measured, not known: a rounded corner of the shoe is a little off
    EXPECT_LT(facts.root_disagreement_speed, 0.03f);
    EXPECT_LT(facts.root_disagreement_turn, 0.5f);
    EXPECT_NEAR(facts.height, 1.75f, 0.1f);  // as it walks: knees and trunk are bent
}

TEST_P(Generated, strikes_when_its_feet_do) {
    const ClipFacts facts = facts_of(motion()).facts;
    EXPECT_EQ(facts.contacts[0].size(), motion().root.size());
    EXPECT_EQ(facts.contacts[1].size(), motion().root.size());
    std::vector<float> strikes[2], offs[2];
    float before = 0;
    for (const PhaseEvent& event : facts.events) {
        EXPECT_GE(event.time, before);
        EXPECT_LT(event.time, facts.duration);
        before = event.time;
        (event.kind == StrideEvent::strike ? strikes : offs)[static_cast<std::size_t>(event.foot)].push_back(
            event.time / facts.duration);
    }
    for (std::size_t side = 0; side < 2; ++side) {
        ASSERT_EQ(strikes[side].size(), steps() ? 1u : 0u);
        ASSERT_EQ(offs[side].size(), steps() ? 1u : 0u);
        if (!steps()) continue;
        // Within two frames; on the spot the foot sinks to the ground so slowly that it counts as down well before.
        const float share = 1 / static_cast<float>(motion().frame_count() - 1);
        const float tolerance = on_the_spot() ? 0.14f : 2.1f * share;
        float late = strikes[side][0] - 0.5f * static_cast<float>(side);
        late -= std::floor(late + 0.5f);
        EXPECT_NEAR(late, 0, tolerance) << (side ? "right" : "left");
        // The toes peel off last: the foot is called down up to a twelfth of the cycle longer than the duty asks.
        float stance = offs[side][0] - strikes[side][0];
        stance -= std::floor(stance);
        EXPECT_GT(stance, gait().duty - 0.02f);
        EXPECT_LT(stance, gait().duty + (on_the_spot() ? 0.3f : 0.085f));
    }
}

TEST_P(Generated, reads_the_same_with_its_travel_in_the_pose) {
    Motion baked = motion();
    bake_root_motion(baked);
    baked.cyclic = false;
    const ClipFacts facts = facts_of(baked).facts, own = facts_of(motion()).facts;
    EXPECT_TRUE(facts.cyclic);
    EXPECT_FALSE(facts.in_place);
    EXPECT_NEAR(facts.forward, own.forward, 3e-3f);
    EXPECT_NEAR(facts.lateral, own.lateral, 3e-3f);
    EXPECT_NEAR(facts.turn, own.turn, 0.02f);
    EXPECT_NEAR(facts.cadence, own.cadence, 0.01f);
    EXPECT_EQ(facts.events.size(), own.events.size());
}

TEST_P(Generated, made_in_place_travels_as_its_feet_say) {
    Motion still = motion();
    std::fill(still.root.begin(), still.root.end(), RootFrame{});
    for (const bool marked : {true, false}) {  // a file does not say whether it loops
        still.cyclic = marked;
        const AnalyzedClip clip = facts_of(still);
        const ClipFacts& facts = clip.facts;
        EXPECT_EQ(facts.in_place, steps());
        EXPECT_TRUE(facts.cyclic);
        EXPECT_TRUE(facts.locomotion) << facts.not_locomotion;
        const float tolerance = 0.003f + 0.01f * speed();
        EXPECT_NEAR(facts.forward, gait().forward, tolerance);
        EXPECT_NEAR(facts.lateral, gait().lateral, tolerance);
        EXPECT_NEAR(facts.turn, gait().turn, 1.2f);
        EXPECT_NEAR(facts.cadence, steps() ? 120 / motion().duration() : 0, 0.01f);
        EXPECT_NEAR(planar_length(clip.motion.root.back().position - clip.motion.root.front().position),
                    facts.chord * facts.duration, 0.01f);
    }
}

TEST_P(Generated, mirrored_has_mirrored_facts) {
    const ClipFacts own = facts_of(motion()).facts;
    const ClipFacts other = facts_of(mirror(motion(), synthetic_set().roles)).facts;
    EXPECT_NEAR(other.forward, own.forward, 1e-4f);
    EXPECT_NEAR(other.lateral, -own.lateral, 1e-4f);
    EXPECT_NEAR(other.turn, -own.turn, 1e-2f);
    EXPECT_NEAR(other.cadence, own.cadence, 1e-3f);
    EXPECT_NEAR(other.stride, own.stride, 1e-4f);
    EXPECT_NEAR(other.duty, own.duty, 1e-4f);
    EXPECT_NEAR(other.skate, own.skate, 1e-4f);
    EXPECT_NEAR(other.hip_height, own.hip_height, 1e-3f);
    EXPECT_EQ(other.locomotion, own.locomotion);
    ASSERT_EQ(other.events.size(), own.events.size());
    for (std::size_t i = 0; i < own.events.size(); ++i) {
        EXPECT_NE(other.events[i].foot, own.events[i].foot);
        EXPECT_EQ(other.events[i].kind, own.events[i].kind);
        EXPECT_NEAR(other.events[i].time, own.events[i].time, 1e-4f);
    }
}

TEST_P(Generated, reversed_travels_the_other_way) {
    const ClipFacts own = facts_of(motion()).facts, other = facts_of(reverse(motion())).facts;
    EXPECT_NEAR(other.forward, -own.forward, 1e-3f);
    EXPECT_NEAR(other.lateral, -own.lateral, 1e-3f);
    EXPECT_NEAR(other.turn, -own.turn, 1e-2f);
    EXPECT_NEAR(other.cadence, own.cadence, 1e-3f);
    EXPECT_NEAR(other.duty, own.duty, 0.02f);
    EXPECT_EQ(other.events.size(), own.events.size());
    EXPECT_TRUE(other.locomotion) << other.not_locomotion;
    if (gait().forward > 0) {
        EXPECT_LT(other.speed, 0);
        EXPECT_NEAR(std::fabs(other.travel), 180, 0.1f);
    }
}

TEST(analyze_clip, an_in_place_clip_keeps_its_frames_and_its_pose_over_the_ground) {
    Motion still = synthetic_set().clips[1];
    ASSERT_EQ(still.name, "walk");
    std::fill(still.root.begin(), still.root.end(), RootFrame{});
    const AnalyzedClip clip = facts_of(still);
    EXPECT_EQ(clip.motion.frame_count(), still.frame_count());
    EXPECT_EQ(clip.source_first, 0);
    EXPECT_EQ(clip.source_last, still.frame_count() - 1);
    EXPECT_EQ(clip.source, "made");
    EXPECT_LT(clip.facts.skate, 0.02f);  // with the root that was found, standing feet stand
}

TEST(analyze_clip, one_frame_is_a_pose_and_no_motion) {
    const AnalyzedClip clip = facts_of(cut(synthetic_set().clips[1], 5, 5));
    EXPECT_EQ(clip.facts.frames, 1);
    EXPECT_EQ(clip.facts.duration, 0);
    EXPECT_EQ(clip.facts.speed, 0);
    EXPECT_EQ(clip.facts.turn, 0);
    EXPECT_FALSE(clip.facts.locomotion);
    EXPECT_NE(clip.facts.not_locomotion.find("pose"), std::string::npos) << clip.facts.not_locomotion;
    EXPECT_TRUE(find_cycles(clip).empty());
}

TEST(analyze_clip, any_few_frames_are_measured_without_trouble) {
    for (const Motion& motion : synthetic_set().clips)
        for (int frames = 1; frames <= 8; ++frames) {
            const AnalyzedClip clip = facts_of(cut(motion, 3, 2 + frames));
            EXPECT_EQ(clip.facts.frames, frames);
            EXPECT_EQ(problem(clip.motion), "");
            EXPECT_TRUE(std::isfinite(clip.facts.speed) && std::isfinite(clip.facts.turn));
            for (const AnalyzedClip& cycle : find_cycles(clip)) EXPECT_EQ(problem(cycle.motion), "");
        }
}

/// The message of what analyze_clip throws; empty where it does not.
std::string refusal(const Motion& motion) {
    try {
        facts_of(motion);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(analyze_clip, a_skeleton_without_legs_is_refused_with_the_names_of_what_is_missing) {
    auto tail = std::make_shared<Skeleton>();
    for (int j = 0; j < 6; ++j) tail->add("segment_" + std::to_string(j), j - 1, {{}, {0, 0, j ? 0.2f : 0}});
    const std::string message = refusal(make_motion(tail, "eel", 30, 30));
    for (const char* text : {"eel", "left_upper_leg", "left_foot", "right_lower_leg", "made"})
        EXPECT_NE(message.find(text), std::string::npos) << text << " in: " << message;
}

TEST(analyze_clip, one_leg_is_not_enough_and_only_the_other_is_named) {
    auto one = std::make_shared<Skeleton>();
    one->add("Hips", k_no_joint, {{}, {0, 0.9f, 0}});
    one->add("Spine", 0, {{}, {0, 0.3f, 0}});
    one->add("LeftUpLeg", 0, {{}, {0.1f, 0, 0}});
    one->add("LeftLeg", 2, {{}, {0, -0.45f, 0}});
    one->add("LeftFoot", 3, {{}, {0, -0.4f, 0}});
    const std::string message = refusal(make_motion(one, "pirate", 30, 30));
    EXPECT_NE(message.find("right_upper_leg"), std::string::npos) << message;
    EXPECT_EQ(message.find("left_"), message.find("left_foot=")) << message;
}

TEST(analyze_clip, legs_of_no_length_are_refused) {
    Motion motion = synthetic_set().clips[1];
    for (Transform& joint : motion.locals) joint.translation = {};
    auto flat = std::make_shared<Skeleton>(*motion.skeleton);
    for (Transform& joint : flat->rest) joint.translation = {};
    motion.skeleton = flat;
    EXPECT_FALSE(refusal(motion).empty());
}

TEST(analyze_clip, numbers_that_are_not_finite_are_refused) {
    Motion motion = synthetic_set().clips[1];
    motion.locals[100].translation.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(refusal(motion).find("made"), std::string::npos);
}

TEST(find_cycles, gives_a_cycle_back_closed_and_under_its_own_name) {
    for (const Motion& motion : synthetic_set().clips) {
        const std::vector<AnalyzedClip> cycles = find_cycles(facts_of(motion));
        ASSERT_EQ(cycles.size(), 1u) << motion.name;
        EXPECT_EQ(cycles[0].facts.name, motion.name);
        EXPECT_TRUE(cycles[0].motion.cyclic);
        EXPECT_LT(cycles[0].facts.loop_error, 1e-5f);
    }
}

TEST(find_cycles, cuts_one_stride_out_of_many) {
    const Motion& walk = synthetic_set().clips[1];
    const std::vector<Motion> parts(5, walk);
    Motion take = concatenate(parts);
    bake_root_motion(take);
    take = cut(take, 17, take.frame_count() - 12);
    const AnalyzedClip whole = facts_of(take);
    EXPECT_NEAR(whole.facts.speed, 1.4f, 0.01f);
    EXPECT_NEAR(whole.facts.cadence, 120 / walk.duration(), 1.0f);
    // A strict treadmill of equal strides is a loop as a whole or many equal ones: either way each is exact.
    const std::vector<AnalyzedClip> cycles = find_cycles(whole);
    ASSERT_FALSE(cycles.empty());
    for (const AnalyzedClip& cycle : cycles) {
        EXPECT_NEAR(cycle.facts.speed, 1.4f, 0.01f);
        EXPECT_NEAR(cycle.facts.turn, 0, 0.5f);
        EXPECT_NEAR(cycle.facts.cadence, 120 / walk.duration(), 1.0f);
        EXPECT_LT(cycle.facts.seam, 0.005f);
        EXPECT_LT(cycle.facts.loop_error, 1e-5f);
        ASSERT_FALSE(cycle.facts.events.empty());
        EXPECT_EQ(cycle.source, "made");
        EXPECT_LE(cycle.source_last, take.frame_count() - 1);
        EXPECT_LT(cycle.source_first, cycle.source_last);
    }
}

TEST(find_strides, cuts_every_stride_even_where_the_pace_changes) {
    const Motion& walk = synthetic_set().clips[1];
    const Motion faster = resample(retime(walk, 1.2f), walk.fps);
    Motion second = faster;
    second.fps = walk.fps;
    const std::vector<Motion> parts{walk, walk, walk, second, second, second};
    Motion take = concatenate(parts);
    bake_root_motion(take);
    take = cut(take, 17, take.frame_count() - 12);
    const std::vector<AnalyzedClip> strides = find_strides(facts_of(take));
    ASSERT_GE(strides.size(), 4u);
    ASSERT_LE(strides.size(), 5u);
    int before = -1;
    for (const AnalyzedClip& stride : strides) {
        EXPECT_TRUE(stride.motion.cyclic);
        EXPECT_GT(stride.facts.speed, 1.3f);
        EXPECT_LT(stride.facts.speed, 1.8f);
        EXPECT_LT(stride.facts.loop_error, 1e-5f);
        EXPECT_GT(stride.source_first, before);
        EXPECT_EQ(std::count_if(stride.facts.events.begin(), stride.facts.events.end(),
                                [](const PhaseEvent& e) { return e.kind == StrideEvent::strike; }),
                  2);
        before = stride.source_first;
    }
    EXPECT_LT(strides.front().facts.speed, strides.back().facts.speed - 0.15f);
    EXPECT_TRUE(find_strides(facts_of(take), 0).size() < strides.size());  // no stride closes without a trace
}

}  // namespace
}  // namespace surefoot
