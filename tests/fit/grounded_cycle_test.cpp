#include <surefoot/analysis/leg_track.h>
#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/personalities.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/fit/grounded_cycle.h>
#include <surefoot/math/trig.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

struct Asked {
    const char* gait;
    float speed, turn_deg;
};

/// All bundled gaits that keep to level ground, over their ranges.
std::vector<Asked> all_asked() {
    std::vector<Asked> list{{"idle", 0, 0}};
    for (const float turn : {-120.0f, -40.0f, 0.0f, 80.0f}) {
        for (const float speed : {0.4f, 0.9f, 1.4f, 2.0f, 2.7f, 3.4f, 4.6f}) list.push_back({"human", speed, turn});
        for (const float speed : {0.4f, 1.0f, 1.8f}) list.push_back({"back", speed, turn});
        for (const float speed : {0.4f, 0.9f, 1.5f}) list.push_back({"strafe_left", speed, turn});
        for (const float speed : {0.4f, 0.8f, 1.3f}) list.push_back({"crouch", speed, turn});
        if (turn != 0) list.push_back({"turn", 0, turn});
    }
    return list;
}

/// What a cycle does to the floor, by its joints in the world.
struct OnFloor {
    float lowest = 1, knee_deg = 180;
    float skate_cm_s = 0;  ///< of sole points on the floor
    int touching = 0;
};
OnFloor on_floor(const Motion& motion, const Legs& legs) {
    OnFloor found;
    const WalkTrack track = make_track(motion, legs);
    for (std::size_t f = 0; f < track.frames.size(); ++f)
        for (std::size_t side = 0; side < 2; ++side) {
            const LegTrack& leg = track.frames[f].legs[side];
            const Vec3 thigh = normalized(leg.knee - leg.hip), shank = normalized(leg.ankle - leg.knee);
            found.knee_deg =
                std::min(found.knee_deg, acos(std::clamp(dot(thigh, shank), -1.0f, 1.0f)) * k_degrees_per_radian);
            float least = 1e9f;  // of the points that touch, the one that moves least: it rolls about that
            for (std::size_t p = 0; p < leg.sole.size(); ++p) {
                found.lowest = std::min(found.lowest, leg.sole[p].y);
                if (f == 0 || leg.sole[p].y > 1e-5f) continue;
                const Vec3 before = track.frames[f - 1].legs[side].sole[p];
                if (before.y <= 1e-5f) least = std::min(least, planar_length(leg.sole[p] - before));
            }
            if (least > 1e8f) continue;
            found.skate_cm_s += 100 * least * motion.fps;
            ++found.touching;
        }
    found.skate_cm_s /= static_cast<float>(std::max(1, found.touching));
    return found;
}

TEST(GroundedCycle, feet_keep_to_the_floor_at_every_speed_and_turn) {
    for (const Asked& asked : all_asked()) {
        SCOPED_TRACE(testing::Message() << asked.gait << " " << asked.speed << " m/s " << asked.turn_deg << " deg/s");
        const HarmonicGait gait = fitted_gait(asked.gait);
        const OnFloor found = on_floor(grounded_cycle(gait, asked.speed, asked.turn_deg), gait.soles);
        EXPECT_GT(found.lowest, -1e-4f);
        EXPECT_GT(found.touching, 5);
        EXPECT_LT(found.skate_cm_s, 0.2f);
        EXPECT_GT(found.knee_deg, 5);
    }
}

TEST(GroundedCycle, is_an_exact_loop_of_a_steady_root) {
    for (const Asked& asked : all_asked()) {
        SCOPED_TRACE(testing::Message() << asked.gait << " " << asked.speed << " m/s " << asked.turn_deg << " deg/s");
        const HarmonicGait gait = fitted_gait(asked.gait);
        const Motion motion = grounded_cycle(gait, asked.speed, asked.turn_deg);
        EXPECT_EQ(problem(motion), "");
        EXPECT_EQ(motion.fps, 60);
        EXPECT_TRUE(motion.cyclic);
        EXPECT_EQ(motion.frame_count() % 2, 1);
        const auto first = motion.frame(0), last = motion.frame(motion.frame_count() - 1);
        EXPECT_TRUE(std::equal(first.begin(), first.end(), last.begin()));
        EXPECT_NEAR(wrap_angle(motion.root.back().yaw - asked.turn_deg * k_radians_per_degree * motion.duration()), 0,
                    1e-4f);
        for (std::size_t f = 1; f < motion.root.size(); ++f) {
            const float chord = planar_length(motion.root[f].position - motion.root[f - 1].position);
            EXPECT_NEAR(chord * motion.fps, asked.speed, 1e-3f + 1e-3f * asked.speed);
        }
    }
}

// Toes of the gait as it is change by up to 11 degrees from one frame to the next.
TEST(GroundedCycle, no_joint_jumps_where_a_foot_lifts_or_strikes) {
    const HarmonicGait gait = fitted_gait("human");
    for (const float speed : {0.8f, 1.4f, 3.4f}) {
        const Motion motion = grounded_cycle(gait, speed, 30);
        const int n = motion.frame_count() - 1;
        for (std::size_t j = 0; j < gait.mean.size(); ++j)
            for (int f = 0; f < n; ++f) {
                const auto at = [&](int g) { return motion.frame((g + n) % n)[j].rotation; };
                const Quat before = conjugate(at(f - 1)) * at(f), after = conjugate(at(f)) * at(f + 1);
                const float change_deg = rotation_angle(conjugate(before) * after) * k_degrees_per_radian;
                EXPECT_LT(change_deg, 9) << gait.skeleton->names[j] << " frame " << f << " of " << n << " at " << speed;
            }
    }
}

TEST(GroundedCycle, moves_the_body_as_the_gait_does) {
    // Arms and trunk are the gait's own. A foot stands until its stance is over, where those of the gait set off
    // sooner.
    const HarmonicGait gait = fitted_gait("human");
    const Motion motion = grounded_cycle(gait, 1.2f, 0);
    std::vector<float> values(static_cast<std::size_t>(value_count(gait)));
    values_at(gait, 1.2f, 0, values);
    std::vector<Transform> own(gait.mean.size()), own_models(own.size()), models(own.size());
    const int arm = gait.skeleton->find("LeftUpperArm"), chest = gait.skeleton->find("UpperChest");
    for (int f = 0; f < motion.frame_count() - 1; ++f) {
        pose(gait, values, static_cast<float>(f) / static_cast<float>(motion.frame_count() - 1), own);
        for (const int j : {arm, chest}) {
            const Quat a = own[static_cast<std::size_t>(j)].rotation,
                       b = motion.frame(f)[static_cast<std::size_t>(j)].rotation;
            EXPECT_LT(rotation_angle(conjugate(a) * b) * k_degrees_per_radian, 0.2f);
        }
        local_to_model(*gait.skeleton, own, own_models);
        local_to_model(*gait.skeleton, motion.frame(f), models);
        const auto foot = static_cast<std::size_t>(gait.soles.side[0].foot);
        EXPECT_LT(distance(own_models[foot].translation, models[foot].translation), 0.12f) << "frame " << f;
    }
}

TEST(GroundedCycle, strides_may_be_longer_at_the_same_speed) {
    const HarmonicGait gait = fitted_gait("human");
    GaitStyle longer;
    longer.stride = 1.2f;
    const Motion own = grounded_cycle(gait, 3, 0), styled = grounded_cycle(gait, 3, 0, longer);
    EXPECT_NEAR(styled.duration() / own.duration(), 1.2f, 0.04f);
    EXPECT_LT(on_floor(styled, gait.soles).skate_cm_s, 0.2f);
}

TEST(GroundedCycle, bakes_of_personalities_keep_to_the_floor_and_their_rhythm) {
    const HarmonicGait gait = fitted_gait("human");
    for (const Personality& personality : bundled_personalities())
        for (const float speed : {0.5f, 1.0f, 1.5f, 3.0f}) {
            SCOPED_TRACE(testing::Message() << personality.name << " " << speed);
            GaitBakeOptions options{personality.style};
            const AnalyzedClip own = bake_gait(gait, speed, 20, options);
            options.grounded = true;
            const AnalyzedClip clip = bake_gait(gait, speed, 20, options);
            const OnFloor found = on_floor(clip.motion, clip.legs), before = on_floor(own.motion, own.legs);
            EXPECT_GT(found.lowest, -1e-4f);
            EXPECT_LT(before.lowest, -2e-3f);  // what holding them is for
            EXPECT_LT(found.skate_cm_s, 0.2f);
            EXPECT_GT(found.knee_deg, 5);
            EXPECT_EQ(clip.motion.root, own.motion.root);
            ASSERT_EQ(clip.facts.events.size(), own.facts.events.size());
            for (std::size_t e = 0; e < own.facts.events.size(); ++e)
                EXPECT_EQ(clip.facts.events[e].time, own.facts.events[e].time);
        }
}

TEST(GroundedCycle, bakes_on_slopes_and_stairs_are_the_gait_s_own) {
    for (const float slope : {0.0f, 8.0f}) {
        const HarmonicGait gait = fitted_gait(slope == 0 ? "stairs_up" : "walk");
        GaitBakeOptions options;
        options.slope_deg = slope;
        const AnalyzedClip own = bake_gait(gait, 0.6f, 0, options);
        options.grounded = true;
        EXPECT_EQ(bake_gait(gait, 0.6f, 0, options).motion.locals, own.motion.locals);
    }
}

TEST(GroundedCycle, what_it_cannot_do_is_said) {
    EXPECT_THROW(grounded_cycle(fitted_gait("stairs_up"), 0.5f, 0), Error);
    EXPECT_THROW(grounded_cycle(fitted_gait("human"), 9, 0), Error);
    HarmonicGait footless = fitted_gait("human");
    footless.legs.count = 0;
    EXPECT_THROW(grounded_cycle(footless, 1, 0), Error);
}

}  // namespace
}  // namespace surefoot
