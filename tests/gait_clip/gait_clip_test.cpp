// The corrected model of Bhatti et al. (2017) on bodies, measured by the analysis that measures every clip.

#include <surefoot/base/error.h>
#include <surefoot/gait_clip/gait_clip.h>

#include "tests/support/rigs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

Gait bundled(const std::string& name) { return read_gait(bundled_gait(name), name + ".gait"); }

GaitActor actor_of(const test::Rig& rig) {
    const std::vector<Transform> rest = test::models_of(*rig.skeleton);
    RoleReport roles;
    roles.roles = rig.roles;
    return make_gait_actor(rig.skeleton, roles, rig.legs, rest, rig.name);
}
const GaitActor& adult() {
    static const GaitActor actor = actor_of(test::many_rigs().front());
    return actor;
}

AnalyzedClip played(const std::string& preset, const GaitPlay& play, const GaitActor& actor = adult(),
                    const std::vector<std::string>& set = {}) {
    const Gait gait = bundled("bhatti2017");
    return play_gait(gait, gait_values(gait, preset, set), actor, play);
}

/// The deepest that any sole point ever is below y = 0 [m].
float penetration(const AnalyzedClip& clip) {
    std::vector<Transform> world(static_cast<std::size_t>(clip.motion.joint_count()));
    float lowest = 1;
    for (int f = 0; f < clip.motion.frame_count(); ++f) {
        world_pose(clip.motion, f, world);
        for (const Leg& leg : clip.legs.side) {
            const Transform& foot = world[static_cast<std::size_t>(leg.foot)];
            const SolePoints p =
                sole_points(leg, foot, leg.toes == k_no_joint ? foot : world[static_cast<std::size_t>(leg.toes)]);
            lowest = std::min({lowest, p.heel.y, p.mid.y, p.ball.y, p.toe_tip.y});
        }
    }
    return -lowest;
}

/// How a joint swings fore and aft as seen from the root, about its mean.
std::vector<float> swing(const AnalyzedClip& clip, Role role) {
    std::vector<float> ahead;
    std::vector<Transform> world(static_cast<std::size_t>(clip.motion.joint_count()));
    float mean = 0;
    for (int f = 0; f + 1 < clip.motion.frame_count(); ++f) {
        world_pose(clip.motion, f, world);
        const Transform to_root = inverse(to_transform(clip.motion.root[static_cast<std::size_t>(f)]));
        ahead.push_back(
            transform_point(to_root, world[static_cast<std::size_t>(clip.roles.roles[role])].translation).z);
        mean += ahead.back();
    }
    for (float& z : ahead) z -= mean / static_cast<float>(ahead.size());
    return ahead;
}
float correlation(const std::vector<float>& a, const std::vector<float>& b) {
    float ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) ab += a[i] * b[i], aa += a[i] * a[i], bb += b[i] * b[i];
    return ab / std::sqrt(aa * bb);
}

TEST(GaitClip, the_corrected_walk_goes_as_fast_and_as_far_as_asked_with_feet_that_stand) {
    for (const double speed : {0.0, 0.6, 1.0, 1.4, 1.8, 2.2})
        for (const double turn : {0.0, 45.0, -90.0}) {
            const AnalyzedClip walk = played("", {.speed_mps = speed, .turn_deg_s = turn});
            const std::string where = std::to_string(speed) + " m/s " + std::to_string(turn) + " deg/s";
            const double asked = speed > 0 ? speed : 1.4;
            EXPECT_NEAR(walk.facts.speed, asked, 0.01 * asked) << where;
            EXPECT_NEAR(walk.facts.turn, turn, std::max(0.01 * std::fabs(turn), 0.1)) << where;
            EXPECT_NEAR(walk.facts.stride, 1.4 * std::sqrt(asked / 1.4), 0.014 * std::sqrt(asked / 1.4)) << where;
            // The measure smooths over 25 ms, which lets quick swings leak into the stance: see the next test.
            EXPECT_LE(100 * walk.facts.skate, asked > 1.5 ? 1.25 : 1.0) << where;
            EXPECT_LE(penetration(walk), 0.001f) << where;
        }
}

TEST(GaitClip, heel_then_ball_of_a_foot_on_the_ground_do_not_move_at_all) {
    for (const double turn : {0.0, 60.0}) {
        const AnalyzedClip walk = played("", {.speed_mps = 1.6, .turn_deg_s = turn, .cycles = 2});
        const int cycle = (walk.motion.frame_count() - 1) / 2;
        const Leg& leg = walk.legs[Side::left];
        std::vector<Transform> world(static_cast<std::size_t>(walk.motion.joint_count()));
        std::vector<Vec3> heels, balls;
        for (int f = 0; f <= static_cast<int>(0.61f * static_cast<float>(cycle)); ++f) {
            world_pose(walk.motion, f, world);
            const SolePoints p =
                sole_points(leg, world[static_cast<std::size_t>(leg.foot)], world[static_cast<std::size_t>(leg.toes)]);
            // The heel until the foot is flat (a fifth of the stance), the ball from then on.
            (f < 0.12 * cycle ? heels : balls).push_back(f < 0.12 * cycle ? p.heel : p.ball);
        }
        for (const std::vector<Vec3>& points : {heels, balls}) {
            ASSERT_GT(points.size(), 4u);
            for (const Vec3 p : points) EXPECT_LT(distance(p, points.front()), 5e-4f) << turn;
        }
    }
}

TEST(GaitClip, opposite_arm_and_leg_swing_together) {
    const AnalyzedClip walk = played("", {});
    const std::vector<float> left_hand = swing(walk, Role::left_hand), right_hand = swing(walk, Role::right_hand);
    const std::vector<float> left_foot = swing(walk, Role::left_foot), right_foot = swing(walk, Role::right_foot);
    EXPECT_GT(correlation(left_hand, right_foot), 0.9f);
    EXPECT_GT(correlation(right_hand, left_foot), 0.9f);
    EXPECT_LT(correlation(left_hand, left_foot), -0.8f);
}

TEST(GaitClip, the_left_foot_strikes_at_phase_0_and_the_right_one_at_a_half) {
    const AnalyzedClip walk = played("", {});
    int strikes = 0;
    for (const PhaseEvent& event : walk.facts.events) {
        if (event.kind != StrideEvent::strike) continue;
        ++strikes;
        const float phase = event.time / walk.motion.duration(), meant = event.foot == Side::left ? 0.0f : 0.5f;
        EXPECT_LT(std::fabs(std::remainder(phase - meant, 1.0f)), 0.05f);
    }
    EXPECT_EQ(strikes, 2);
    EXPECT_NEAR(walk.facts.duty, 0.62f, 0.08f);
}

TEST(GaitClip, every_preset_moves_any_rig_without_a_foot_under_the_floor) {
    const Gait gait = bundled("bhatti2017");
    for (const test::Rig& rig : test::many_rigs()) {
        const GaitActor actor = actor_of(rig);
        for (const GaitPreset& preset : gait.presets) {
            const AnalyzedClip clip = played(preset.name, {}, actor);
            EXPECT_EQ(problem(clip.motion), "") << rig.name << " " << preset.name;
            EXPECT_LE(penetration(clip), 0.001f) << rig.name << " " << preset.name;
        }
    }
}

TEST(GaitClip, every_rig_goes_as_fast_as_asked) {
    for (const test::Rig& rig : test::many_rigs()) {
        const AnalyzedClip walk = played("", {.speed_mps = 1.1, .turn_deg_s = 30}, actor_of(rig));
        EXPECT_NEAR(walk.facts.speed, 1.1f, 0.011f) << rig.name;
        EXPECT_NEAR(walk.facts.turn, 30, 0.3f) << rig.name;
        // A child's steps are so quick that the measure's smoothing sees the swing (see above).
        EXPECT_LE(100 * walk.facts.skate, rig.name == "child" ? 1.8 : 1.0) << rig.name;
        EXPECT_LT(walk.facts.seam, 1e-3f) << rig.name;
    }
}

TEST(GaitClip, a_child_takes_shorter_and_quicker_steps_at_the_same_speed) {
    const AnalyzedClip grown = played("", {.speed_mps = 1});
    const AnalyzedClip small = played("", {.speed_mps = 1}, actor_of(test::many_rigs()[1]));
    EXPECT_NEAR(small.facts.speed, grown.facts.speed, 0.02f);
    EXPECT_LT(small.facts.stride, 0.9f * grown.facts.stride);
    EXPECT_GT(small.facts.cadence, 1.1f * grown.facts.cadence);
}

TEST(GaitClip, uphill_the_root_climbs_and_feet_stand_on_the_slope) {
    const AnalyzedClip up = played("", {.speed_mps = 1.2, .slope_deg = 10});
    const Vec3 end = up.motion.root.back().position;
    EXPECT_NEAR(end.y, end.z * tan(10 * k_radians_per_degree), 1e-4f);
    std::vector<Transform> world(static_cast<std::size_t>(up.motion.joint_count()));
    int flat = 0;
    for (int f = 0; f < up.motion.frame_count(); ++f) {
        world_pose(up.motion, f, world);
        for (const Leg& leg : up.legs.side) {
            const SolePoints p =
                sole_points(leg, world[static_cast<std::size_t>(leg.foot)], world[static_cast<std::size_t>(leg.toes)]);
            const auto above = [](Vec3 q) { return q.y - q.z * tan(10 * k_radians_per_degree); };
            EXPECT_GT(std::min({above(p.heel), above(p.ball), above(p.toe_tip)}), -0.001f) << f;
            flat += above(p.heel) < 0.002f && above(p.ball) < 0.002f;
        }
    }
    EXPECT_GT(flat, up.motion.frame_count() / 4);
}

TEST(GaitClip, frames_divide_the_cycle_and_cycles_follow_each_other) {
    const AnalyzedClip one = played("", {.fps = 30}), three = played("", {.fps = 30, .cycles = 3});
    EXPECT_EQ(one.motion.frame_count(), 31);
    EXPECT_EQ(three.motion.frame_count(), 91);
    EXPECT_EQ(three.motion.frame(31)[5], one.motion.frame(1)[5]);
    EXPECT_NEAR(three.motion.root.back().position.z, 3 * one.motion.root.back().position.z, 1e-4f);
    EXPECT_EQ(one.motion.frame(0)[7], one.motion.frame(30)[7]);
    EXPECT_THROW(played("", {.fps = 3}), Error);
    EXPECT_THROW(played("", {.cycles = 0}), Error);
}

TEST(GaitClip, the_printed_model_moves_a_body_too_and_its_feet_stay_above_the_floor) {
    const Gait printed = bundled("bhatti2017_as_printed");
    EXPECT_TRUE(bind_gait(printed).unknown.empty());
    const AnalyzedClip clip = play_gait(printed, gait_values(printed, "", {}), adult());
    EXPECT_LE(penetration(clip), 0.001f);
    EXPECT_NEAR(clip.motion.root.back().position.z, 0, 1e-6f);  // nothing moves the root
}

TEST(GaitClip, a_gait_of_ones_own_moves_what_it_names_and_says_what_it_does_not_know) {
    const Gait wave = read_gait(
        "gait wave\ncontrol right_hand.tY = 1.6 + 0.1 * sin(2 * pi * t) unit \"m\"\n"
        "control right_hand.tZ = 0.2\ncontrol tail.rX = 1\nlet unused_part = 3\nperiod = 1",
        "wave.gait", GaitOutputs::everything);
    EXPECT_EQ(bind_gait(wave).unknown, std::vector<std::string>{"tail.rX"});
    const AnalyzedClip clip = play_gait(wave, {}, adult());
    std::vector<Transform> world(static_cast<std::size_t>(clip.motion.joint_count()));
    world_pose(clip.motion, 15, world);
    const auto height = [&](Role role) {
        return world[static_cast<std::size_t>(clip.roles.roles[role])].translation.y;
    };
    EXPECT_NEAR(height(Role::right_hand), 1.7f, 0.05f);
    EXPECT_NEAR(height(Role::left_hand), 0.84f, 0.05f);
}

}  // namespace
}  // namespace surefoot
