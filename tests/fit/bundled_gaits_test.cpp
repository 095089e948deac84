#include <surefoot/analysis/leg_track.h>
#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/live_rigs.h>
#include <surefoot/author/personalities.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/derive.h>
#include <surefoot/fit/fit_gait.h>

#include "tests/fit/baked_clip.h"
#include "tests/fit/largest_change.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

/// Whether feet and root agree: what analysis makes of the clip as it stands.
void expect_speed(const HarmonicGait& gait, float speed, float turn_deg) {
    const AnalyzedClip clip = analyze_clip(bake_gait(gait, speed, turn_deg).motion, gait.name);
    EXPECT_NEAR(std::fabs(clip.facts.speed), speed, 0.02f * speed) << gait.name;
    EXPECT_LT(clip.facts.root_disagreement_speed, 0.02f * std::max(speed, 0.5f)) << gait.name << " at " << speed;
}

TEST(BundledGaits, all_can_be_had_by_name) {
    for (const NamedGait& named : fitted_gaits()) {
        const HarmonicGait gait = fitted_gait(named.name);
        EXPECT_EQ(problem(gait), "") << named.name;
        EXPECT_EQ(gait.skeleton->names, fitted_gait("walk").skeleton->names) << named.name;  // of one body
        const AnalyzedClip clip = bake_gait(gait, named.speed, named.turn_deg);
        EXPECT_TRUE(clip.facts.cyclic);
        EXPECT_NEAR(std::fabs(clip.facts.speed), named.speed, 0.01f) << named.name;
    }
    EXPECT_THROW(fitted_gait("swim"), Error);
    EXPECT_EQ(find_fitted_gait("swim"), nullptr);
}

TEST(BundledGaits, each_goes_as_fast_as_asked_over_its_range) {
    for (const char* name : {"back", "strafe_left", "strafe_right"}) {
        const HarmonicGait gait = fitted_gait(name);
        for (int i = 0; i < 8; ++i)
            expect_speed(gait, gait.basis.least_speed + (gait.basis.most_speed - gait.basis.least_speed) * i / 7.0f, 0);
    }
}

TEST(BundledGaits, played_live_feet_stand_nearly_still) {
    struct {
        const char* name;
        float speed, turn_deg;
        double skate_cm_s;
    } constexpr k_all[] = {{"human", 0.7f, 0, 1.2}, {"human", 1.4f, 0, 1.2},  {"human", 1.4f, 60, 1.2},
                           {"human", 2.6f, 0, 2},   {"human", 3, 0, 3.5},     {"human", 4.2f, 0, 5.5},
                           {"back", 1, 0, 1.2},     {"strafe_left", 1, 0, 2}, {"crouch", 0.74f, 0, 1.2},
                           {"turn", 0, 60, 1.6}};
    for (const auto& [name, speed, turn_deg, most] : k_all) {
        SCOPED_TRACE(testing::Message() << name << " " << speed << " m/s " << turn_deg << " deg/s");
        const HarmonicGait gait = as_played_live(fitted_gait(name));
        const AnalyzedClip clip = bake_gait(gait, speed, turn_deg);
        EXPECT_LT(skate_of(clip), most);
        EXPECT_GT(lowest_sole(clip), -0.008f);
    }
    // Captured, they are of the actor's feet.
    EXPECT_GT(skate_of(bake_gait(fitted_gait("human"), 1.4f, 0)), 3);
}

// As captured they do, too: BundledFamily in fit_family_test.cpp.
TEST(BundledGaits, played_live_poses_change_smoothly_with_the_speed) {
    const HarmonicGait live = as_played_live(fitted_gait("human"));
    for (const float turn : {0.0f, 60.0f, -90.0f}) {
        const float whole = largest_change(live, 2, turn), half = largest_change(live, 1, turn);
        EXPECT_LT(whole, 6) << turn;
        EXPECT_LT(half, 0.6f * whole) << turn;
    }
}

struct LiveWalk {
    float head = 0, lowest_sole = 1, slide = 0, speed = 0;  ///< means [m], [m/s]; of heels and balls that stand flat
};
/// Three seconds of it, after one.
LiveWalk walk_live(const LiveRig& rig, float asked) {
    constexpr float k_dt = 1.0f / 60, k_low = 0.01f;
    LiveState state = start(rig, {.speed = asked});
    LiveScratch scratch(rig);
    std::vector<Transform> locals(rig.stand.size()), models(locals.size());
    const auto head = static_cast<std::size_t>(rig.skeleton->find("Head"));
    RootFrame root;
    std::array<Vec3, 4> before{};
    LiveWalk walk;
    int standing = 0;
    for (int f = 0; f < 240; ++f) {
        const LiveFrame frame = update(rig, state, {.speed = asked}, k_dt);
        root = root * frame.root_delta;
        pose(rig, state, scratch, locals);
        local_to_model(*rig.skeleton, locals, models);
        std::array<Vec3, 4> soles;
        for (std::size_t side = 0; side < 2; ++side) {
            const Leg& leg = rig.soles.side[side];
            const SolePoints sole = sole_points(leg, to_transform(root) * models[static_cast<std::size_t>(leg.foot)],
                                                to_transform(root) * models[static_cast<std::size_t>(leg.toes)]);
            soles[2 * side] = sole.heel, soles[2 * side + 1] = sole.ball;
            for (std::size_t i = 2 * side; f >= 60 && frame.planted[side] && i < 2 * side + 2; ++i) {
                if (soles[i].y > k_low || before[i].y > k_low) continue;
                walk.slide += planar_length(soles[i] - before[i]) / k_dt;
                ++standing;
            }
        }
        before = soles;
        if (f < 60) continue;
        for (const Vec3 sole : soles) walk.lowest_sole = std::min(walk.lowest_sole, sole.y);
        walk.head += models[head].translation.y / 180;
        walk.speed += planar_length(frame.root_delta.position) / (180 * k_dt);
    }
    walk.slide /= static_cast<float>(standing);
    return walk;
}

TEST(BundledGaits, played_live_with_a_personality_they_look_like_it_and_their_feet_hold) {
    const HarmonicGait human = fitted_gait("human");
    const LiveWalk plain = walk_live(live_rig_of(human, GaitCompany::alone, "human"), 1.2f);
    for (const Personality& personality : bundled_personalities()) {
        const LiveWalk walk = walk_live(live_rig_of(human, GaitCompany::alone, "human", personality.style), 1.2f);
        EXPECT_NEAR(walk.speed, 1.2f, 1e-3f) << personality.name;
        EXPECT_GT(walk.lowest_sole, -0.01f) << personality.name;
        EXPECT_LT(walk.slide, std::max(1.2f * plain.slide, 0.015f)) << personality.name;
        const float lower = personality.name == "tired" ? 0.02f : personality.name == "sneaky" ? 0.15f : -1.0f;
        EXPECT_LT(walk.head, plain.head - lower) << personality.name;
    }
}

TEST(BundledGaits, what_stands_or_climbs_is_played_live_as_it_is) {
    for (const char* name : {"idle", "stairs_up", "stairs_down"})
        EXPECT_EQ(as_played_live(fitted_gait(name)).foot_hold, 0) << name;
    const HarmonicGait live = as_played_live(fitted_gait("human"));
    EXPECT_EQ(as_played_live(live).coefficients, live.coefficients);
}

TEST(BundledGaits, soles_keep_to_the_floor) {
    for (const char* name : {"walk", "jog", "run", "back", "strafe", "turn", "idle", "crouch"}) {
        const NamedGait& named = *find_fitted_gait(name);
        const float lowest = lowest_sole(bake_gait(fitted_gait(name), named.speed, named.turn_deg));
        EXPECT_GT(lowest, -0.03f) << name;
        EXPECT_LT(lowest, 0.02f) << name;
    }
}

TEST(BundledGaits, turning_on_the_spot_stays_on_the_spot) {
    const HarmonicGait turn = fitted_gait("turn");
    for (const float rate : {-120.0f, -60.0f, 30.0f, 90.0f}) {
        const AnalyzedClip clip = bake_gait(turn, 0, rate);
        EXPECT_NEAR(clip.facts.turn, rate, 0.5f);
        EXPECT_LT(length(clip.motion.root.back().position), 1e-4f);
    }
}

TEST(BundledGaits, stairs_rise_by_a_step_each) {
    for (const float sign : {1.0f, -1.0f}) {
        const HarmonicGait stairs = fitted_gait(sign > 0 ? "stairs_up" : "stairs_down");
        for (const float speed : {0.3f, 0.6f, 0.9f}) {
            const AnalyzedClip clip = bake_gait(stairs, speed, 0);
            const Vec3 end = clip.motion.root.back().position;
            EXPECT_NEAR(end.z, 2 * 0.28f, 0.002f);
            EXPECT_NEAR(end.y, sign * 2 * 0.17f, 0.002f);
        }
    }
}

TEST(BundledGaits, feet_on_stairs_clear_the_edges) {
    // Each foot stands on a tread of its own; its toe tip must be above the edge of the one it passes.
    const AnalyzedClip clip = bake_gait(fitted_gait("stairs_up"), 0.5f, 0);
    const WalkTrack track = make_track(clip.motion, clip.legs);
    constexpr float k_riser = 0.17f, k_tread = 0.28f;
    for (std::size_t side = 0; side < 2; ++side) {
        // The stance: where the heel is slowest.
        const auto& frames = track.frames;
        std::size_t still = 1;
        for (std::size_t f = 1; f + 1 < frames.size(); ++f) {
            const auto speed = [&](std::size_t g) {
                return distance(frames[g].legs[side].sole[1], frames[g - 1].legs[side].sole[1]);
            };
            if (speed(f) < speed(still)) still = f;
        }
        const Vec3 stand = frames[still].legs[side].sole[0];
        for (const TrackFrame& frame : frames)
            for (const Vec3 point : frame.legs[side].sole) {
                // The foot is nearly as long as its tread: the heel stands 3 cm behind its edge.
                const float steps = std::floor((point.z - (stand.z + 0.03f)) / k_tread);
                EXPECT_GT(point.y, stand.y + steps * k_riser - 0.03f) << "side " << side;
            }
    }
}

TEST(BundledGaits, crouching_is_lower_than_walking) {
    const float walk = bake_gait(fitted_gait("walk"), 0.8f, 0).facts.hip_height;
    for (const float speed : {0.3f, 0.8f, 1.4f})
        EXPECT_LT(bake_gait(fitted_gait("crouch"), speed, 0).facts.hip_height, 0.75f * walk);
}

TEST(BundledGaits, an_idle_breathes_and_shifts_its_weight) {
    const AnalyzedClip idle = bake_gait(fitted_gait("idle"), 0, 0);
    EXPECT_GT(idle.motion.duration(), 6);
    std::vector<Transform> models(static_cast<std::size_t>(idle.motion.joint_count()));
    float left = 1, right = -1;
    for (int f = 0; f < idle.motion.frame_count(); ++f) {
        local_to_model(*idle.motion.skeleton, idle.motion.frame(f), models);
        const float x = models[static_cast<std::size_t>(idle.legs.hips)].translation.x;
        left = std::min(left, x), right = std::max(right, x);
    }
    EXPECT_GT(right - left, 0.03f);
    EXPECT_LT(right - left, 0.08f);
}

TEST(DerivedGaits, what_makes_no_sense_is_refused) {
    const HarmonicGait walk = fitted_gait("walk"), idle = fitted_gait("idle");
    EXPECT_THROW(stretched(walk, 0.3f, 1), Error);
    EXPECT_THROW(stretched(idle, 0.3f, 1), Error);
    EXPECT_THROW(shifting_weight(walk), Error);
    EXPECT_THROW(on_stairs(idle), Error);
    EXPECT_THROW(on_stairs(fitted_gait("back")), Error);
}

}  // namespace
}  // namespace surefoot
