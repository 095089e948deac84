#include <surefoot/motion/plant.h>
#include <surefoot/motion/steer.h>

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/measure.h>
#include <surefoot/io/load.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/support/motion_data.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

AnalyzedClip generated(const std::string& name) {
    ClipSet set = make_synthetic_set();
    for (Motion& motion : set.clips)
        if (motion.name == name) return analyze_clip(std::move(motion), name);
    ADD_FAILURE() << name;
    return {};
}

/// The clip on another path, measured again.
ClipFacts steered(const AnalyzedClip& clip, const PathTarget& target, bool keep_feet, SteerReport* report = nullptr) {
    const StanceFlags stances = keep_feet ? stance_flags(clip.facts) : StanceFlags{};
    const Motion motion = steer(clip.motion, clip.roles.roles, stances, target, report);
    EXPECT_EQ(problem(motion), "");
    EXPECT_EQ(motion.frame_count(), clip.motion.frame_count());
    EXPECT_EQ(motion.cyclic, clip.motion.cyclic);
    ClipFacts facts = clip.facts;
    measure(motion, clip.roles.roles, clip.legs, facts);
    return facts;
}

PathTarget turning(float deg_s) {
    PathTarget target;
    target.turn = deg_s * k_radians_per_degree;
    return target;
}

TEST(steer, a_straight_walk_turns_as_asked_and_its_standing_feet_stand) {
    const AnalyzedClip walk = generated("walk");
    SteerReport report;
    const ClipFacts kept = steered(walk, turning(40), true, &report), dragged = steered(walk, turning(40), false);
    EXPECT_NEAR(kept.turn, 40, 0.01f);
    EXPECT_NEAR(kept.speed, walk.facts.speed, 0.01f);
    EXPECT_GT(dragged.skate, walk.facts.skate + 0.04f);  // what bending the path alone costs
    EXPECT_LT(kept.skate, walk.facts.skate + 0.02f);
    EXPECT_NEAR(kept.cadence, walk.facts.cadence, 0.5f);
    EXPECT_LT(kept.loop_error, 1e-3f);
    EXPECT_LT(report.missed, 0.005f);
    EXPECT_GT(report.foot_turned, 0.1f);
}

TEST(steer, a_turning_walk_is_straightened) {
    const AnalyzedClip left = generated("walk_left");
    ASSERT_GT(left.facts.turn, 30);
    const ClipFacts straight = steered(left, turning(0), true);
    EXPECT_NEAR(straight.turn, 0, 0.01f);
    EXPECT_LT(straight.skate, left.facts.skate + 0.02f);
}

TEST(steer, drift_and_pace_are_brought_to_what_is_asked) {
    const AnalyzedClip walk = generated("walk");
    PathTarget target;
    target.lateral = 0.1f;
    target.forward = 0.85f * walk.facts.forward;
    const ClipFacts facts = steered(walk, target, true);
    EXPECT_NEAR(facts.lateral, 0.1f, 1e-3f);
    EXPECT_NEAR(facts.forward, 0.85f * walk.facts.forward, 1e-3f);
    EXPECT_LT(facts.skate, walk.facts.skate + 0.02f);
    EXPECT_NEAR(facts.cadence, walk.facts.cadence, 0.5f);  // shorter steps, the same rhythm
}

TEST(steer, what_is_there_already_changes_nothing_that_can_be_seen) {
    const AnalyzedClip walk = generated("walk");
    const Motion same = steer(walk.motion, walk.roles.roles, stance_flags(walk.facts), turning(walk.facts.turn));
    std::vector<Transform> a(static_cast<std::size_t>(same.joint_count())), b = a;
    for (int f = 0; f < same.frame_count(); ++f) {
        world_pose(walk.motion, f, a);
        world_pose(same, f, b);
        for (std::size_t j = 0; j < a.size(); ++j) EXPECT_LT(distance(a[j].translation, b[j].translation), 1e-4f);
    }
}

TEST(plant, feet_of_captured_walks_stop_sliding_and_the_rest_stays) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    const std::string file = (folder / "o3de_mocap_bvh/Jog1.bvh").string();
    const AnalyzedClip take = analyze_clip(std::move(load_clips({&file, 1}).clips.at(0).motion), file);
    float before = 0, after = 0;
    int cycles = 0;
    for (const AnalyzedClip& cycle : find_cycles(take)) {
        if (cycle.facts.speed < 0.5f) continue;
        PlantReport report;
        const Motion held = plant(cycle.motion, cycle.roles.roles, cycle.legs, stance_flags(cycle.facts), &report);
        ClipFacts facts = cycle.facts;
        measure(held, cycle.roles.roles, cycle.legs, facts);
        before += cycle.facts.skate, after += facts.skate, ++cycles;
        EXPECT_NEAR(facts.speed, cycle.facts.speed, 1e-3f);
        EXPECT_LT(report.moved, 0.15f) << cycle.facts.name;
        EXPECT_LT(facts.loop_error, 1e-3f);
    }
    ASSERT_GT(cycles, 0);
    std::printf("  %d cycles: skate %.1f -> %.1f cm/s\n", cycles, 100.0 * before / cycles, 100.0 * after / cycles);
    EXPECT_LT(after, 0.6f * before);
}

TEST(steer, captured_walks_turn_without_skating_more) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    const std::string file = (folder / "o3de_mocap_bvh/Walk1.bvh").string();
    const AnalyzedClip take = analyze_clip(std::move(load_clips({&file, 1}).clips.at(0).motion), file);
    int walks = 0;
    for (const AnalyzedClip& cycle : find_cycles(take)) {
        if (cycle.facts.speed < 0.5f) continue;
        ++walks;
        const ClipFacts bent = steered(cycle, turning(cycle.facts.turn + 30), true);
        std::printf("  %s: skate %.1f -> %.1f cm/s\n", cycle.facts.name.c_str(), 100.0 * cycle.facts.skate,
                    100.0 * bent.skate);
        EXPECT_NEAR(bent.turn, cycle.facts.turn + 30, 0.05f);
        EXPECT_LT(bent.skate, cycle.facts.skate + 0.03f) << cycle.facts.name;
    }
    EXPECT_GT(walks, 0);
}

}  // namespace
}  // namespace surefoot
