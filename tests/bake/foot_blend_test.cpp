#include <surefoot/bake/character.h>
#include <surefoot/clip/sample.h>

#include "tests/bake/synthetic_clips.h"
#include "tests/support/allocations.h"
#include "tests/support/drag.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

const Character& default_character() {
    static const Character character = [] {
        const auto clips = test::synthetic_clips();
        return bake_character(clips, test::spaces_for(clips), "default");
    }();
    return character;
}

constexpr float k_dt = 1.0f / 120;

/// What heels and balls do that lie on the ground for a moment.
struct Footwork {
    float slide = 0;    ///< [m/s] mean speed over the ground
    float deepest = 0;  ///< [m] below it
    float share = 0;    ///< of all samples
};

/// Walks two cycles as asked and looks at heels and balls. `feet` off: joint angles alone.
Footwork walk(const LocomotionRequest& request, bool feet, Outside outside = Outside::clamp,
              const Character& character = default_character()) {
    LocomotionGraph graph = character.graph;
    if (!feet) graph.legs = {};
    graph.facing.space.outside = outside;
    const std::size_t joints = character.skeleton->rest.size();
    std::vector<Transform> locals(joints), models(joints);
    LocomotionState state;
    RootFrame root;
    std::array<Vec3, 4> last{};
    Footwork work;
    int planted = 0, samples = 0;
    for (float phase = 0; phase < 2; ++samples) {
        const LocomotionFrame frame = update(graph, state, request, k_dt);
        phase += frame.phase_rate * k_dt;
        root = root * frame.root_delta;
        pose(graph, frame, locals);
        local_to_model(*character.skeleton, locals, models);
        for (std::size_t i = 0; i < 4; ++i) {
            const Leg& leg = character.legs.side[i / 2];
            const Transform foot = to_transform(root) * models[static_cast<std::size_t>(leg.foot)];
            const Vec3 point = transform_point(foot, i % 2 ? leg.ball : leg.heel);
            work.deepest = std::max(work.deepest, -point.y);
            constexpr float k_down = 0.002f;  // [m]
            if (samples > 0 && point.y < k_down && last[i].y < k_down) {
                work.slide += planar_length(point - last[i]) / k_dt;
                ++planted;
            }
            last[i] = point;
        }
    }
    EXPECT_GT(planted, samples / 4) << "feet must stand for this to mean anything";
    work.slide /= static_cast<float>(std::max(planted, 1));
    work.share = static_cast<float>(planted) / static_cast<float>(4 * samples);
    return work;
}

// Between idle, walk and run, straight, turning, sideways and backward.
const LocomotionRequest k_blends[] = {{0.5f, 0, 0},   {0.9f, 0, 0},   {2.0f, 0, 0},     {1.0f, 40, 0},
                                      {0.6f, -60, 0}, {-0.4f, 0, 0},  {0, 35, 0},       {0.7f, 0, 0.5f},
                                      {0, 0, 0.4f},   {2.8f, -30, 0}, {0.4f, 20, -0.3f}};

TEST(FootBlend, planted_feet_of_blends_stand_still_and_on_the_ground) {
    for (const LocomotionRequest& request : k_blends) {
        const Footwork work = walk(request, true);
        const std::string what = std::to_string(request.speed) + " m/s " + std::to_string(request.turn) + " deg/s " +
                                 std::to_string(request.lateral) + " m/s to the left: ";
        EXPECT_LT(work.slide, 0.03f) << what;
        EXPECT_LT(work.deepest, 0.006f) << what;
    }
}

/// The longest way [m] of a foot that lies, heel and ball, while a character stands, goes, turns and stands again.
float longest_drag(bool remembers, float speed, float stop) {
    const Character& character = default_character();
    const std::size_t joints = character.skeleton->rest.size();
    std::vector<Transform> locals(joints), models(joints);
    LocomotionState state;
    LocomotionRequest request;
    RootFrame root;
    test::DragMeter drag;
    for (float time = 0; time < 8; time += k_dt) {
        LocomotionRequest wanted;
        if (time > 1 && time < stop) wanted.speed = speed;
        if (time > 3 && time < 5) wanted.turn = 40;
        request = approach(request, wanted, k_dt);
        if (!remembers) state.feet = {};
        const LocomotionFrame frame = update(character.graph, state, request, k_dt);
        root = root * frame.root_delta;
        pose(character.graph, frame, locals);
        local_to_model(*character.skeleton, locals, models);
        drag.see(character.legs, to_transform(root), models);
    }
    return drag.longest();
}

TEST(FootBlend, standing_feet_stay_while_weights_change_whenever_that_is) {
    for (const float speed : {0.5f, 1.4f, 2.5f})
        for (float stop = 5.5f; stop < 6.6f; stop += 0.06f)
            EXPECT_LT(longest_drag(true, speed, stop), 0.05f) << speed << " m/s until " << stop << " s";
    EXPECT_GT(longest_drag(false, 1.4f, 6), 0.08f) << "without what a blend remembers";
}

TEST(FootBlend, who_stands_goes_off_with_the_foot_that_trails) {
    for (const Side ahead : {Side::left, Side::right}) {
        LocomotionGraph graph = default_character().graph;
        for (PackedClip& clip : graph.clips)
            if (clip.name == "idle") test::put_ahead(clip, ahead, 0.15f);
        LocomotionState state;
        update(graph, state, {}, k_dt);
        FootPlans plans;
        for (float time = 0; time < 1 && !plans.side[0].swings() && !plans.side[1].swings(); time += k_dt) {
            const LocomotionFrame frame = update(graph, state, {1.4f, 0, 0}, k_dt);
            const FootBlend blend = foot_blend_of(frame);
            plan_feet(graph.legs, graph.clips, {&blend, 1}, {&plans, 1});
        }
        const std::size_t first = plans.side[0].swings() ? 0 : 1;
        EXPECT_NE(first, static_cast<std::size_t>(ahead));
    }
}

TEST(FootBlend, feet_stand_still_though_the_strikes_of_a_clip_are_unevenly_spaced) {
    auto clips = test::synthetic_clips();
    const float duty = 0.62f;
    for (AnalyzedClip& clip : clips) {
        if (clip.facts.name != "walk") continue;
        // The right foot is said to strike early: its stance then begins in the air, and holds all of the true one.
        const float cycle = clip.motion.duration();
        clip.facts.events = {{Side::left, StrideEvent::strike, 0},
                             {Side::right, StrideEvent::toe_off, (duty - 0.5f) * cycle},
                             {Side::right, StrideEvent::strike, 0.4f * cycle},
                             {Side::left, StrideEvent::toe_off, duty * cycle}};
    }
    const Character uneven = bake_character(clips, test::spaces_for(clips), "uneven");
    for (const float speed : {0.4f, 0.7f, 1.0f}) {
        const Footwork even_work = walk({speed, 0, 0}, true), work = walk({speed, 0, 0}, true, Outside::clamp, uneven);
        EXPECT_LT(work.slide, even_work.slide + 0.01f) << speed;
        EXPECT_LT(work.deepest, 0.006f) << speed;
    }
}

TEST(FootBlend, feet_of_extrapolated_poses_stand_still_too) {
    LocomotionGraph graph = default_character().graph;
    graph.facing.space.outside = Outside::extrapolate;
    float fastest = 0;
    for (const SpacePoint& sample : graph.facing.space.samples) fastest = std::max(fastest, sample[0]);
    const Footwork lone = walk({fastest, 0, 0}, true);
    for (const float more : {0.1f, 0.2f}) {
        const LocomotionRequest request{fastest + more, 0, 0};
        LocomotionState state;
        const LocomotionFrame frame = update(graph, state, request, k_dt);
        EXPECT_FALSE(frame.clamped);
        EXPECT_NEAR(frame.velocity.z, request.speed, 1e-3);
        EXPECT_LT(frame.leaves().back().weight, 0);  // what is taken off comes last
        const Footwork work = walk(request, true, Outside::extrapolate);
        EXPECT_LT(work.slide, 1.2f * lone.slide + 0.01f) << more;
        EXPECT_LT(work.deepest, lone.deepest + 0.005f) << more;
    }
}

TEST(FootBlend, joint_angles_alone_would_slide) {
    float slide = 0, deepest = 0;
    for (const LocomotionRequest& request : k_blends) {
        const Footwork work = walk(request, false);
        slide += work.slide / static_cast<float>(std::size(k_blends));
        deepest = std::max(deepest, work.deepest);
    }
    EXPECT_GT(slide, 0.03f);
    EXPECT_GT(deepest, 0.02f);
}

TEST(FootBlend, a_lone_clip_plays_bit_for_bit_as_packed) {
    const Character& character = default_character();
    const std::size_t joints = character.skeleton->rest.size();
    std::vector<Transform> locals(joints), plain(joints);
    LocomotionState state;
    const auto walk = std::find_if(character.facts.begin(), character.facts.end(),
                                   [](const ClipFacts& facts) { return facts.name == "walk"; });
    ASSERT_NE(walk, character.facts.end());
    for (int i = 0; i < 100; ++i) {
        const LocomotionFrame frame = update(character.graph, state, {walk->speed, 0, 0}, k_dt);
        ASSERT_EQ(frame.leaf_count, 1);
        pose(character.graph, frame, locals);
        sample_pose(*character.skeleton, character.graph.clips, frame.leaves(), plain);
        ASSERT_EQ(locals, plain);
    }
}

TEST(FootBlend, a_blend_that_is_nearly_one_clip_is_nearly_that_clip) {
    const Character& character = default_character();
    const std::size_t joints = character.skeleton->rest.size();
    std::vector<Transform> near(joints), lone(joints), near_models(joints), lone_models(joints);
    LocomotionState state;
    const auto walk = std::find_if(character.facts.begin(), character.facts.end(),
                                   [](const ClipFacts& facts) { return facts.name == "walk"; });
    float apart = 0;
    for (int i = 0; i < 300; ++i) {
        update(character.graph, state, {walk->speed, 0, 0}, k_dt);
        LocomotionState a = state, b = state;
        const LocomotionFrame close = update(character.graph, a, {walk->speed + 0.002f, 0.1f, 0}, 0);
        ASSERT_GT(close.leaf_count, 1);
        pose(character.graph, close, near);
        pose(character.graph, update(character.graph, b, {walk->speed, 0, 0}, 0), lone);
        local_to_model(*character.skeleton, near, near_models);
        local_to_model(*character.skeleton, lone, lone_models);
        for (std::size_t j = 0; j < joints; ++j)
            apart = std::max(apart, distance(near_models[j].translation, lone_models[j].translation));
    }
    EXPECT_LT(apart, 0.003f);
}

TEST(FootBlend, poses_move_smoothly_through_the_cycle) {
    // Ankles accelerate in blends no more than in the clips at either side, with room for a half.
    const Character& character = default_character();
    const std::size_t joints = character.skeleton->rest.size();
    std::vector<Transform> locals(joints), models(joints);
    const auto hardest = [&](const LocomotionRequest& request) {
        LocomotionState state;
        Vec3 before, now;
        float most = 0;
        const auto foot = static_cast<std::size_t>(character.legs.side[0].foot);
        for (int i = 0; i < 400; ++i) {
            pose(character.graph, update(character.graph, state, request, k_dt), locals);
            local_to_model(*character.skeleton, locals, models);
            const Vec3 next = models[foot].translation;
            if (i > 1) most = std::max(most, length(next - now * 2 + before) / (k_dt * k_dt));
            before = now;
            now = next;
        }
        return most;
    };
    const float walk = hardest({1.4f, 0, 0}), jog = hardest({2.6f, 0, 0});
    EXPECT_LT(hardest({0.7f, 0, 0}), 1.5f * walk);
    EXPECT_LT(hardest({2.0f, 0, 0}), 1.5f * std::max(walk, jog));
    EXPECT_LT(hardest({1.0f, 45, 0}), 1.5f * walk);
}

TEST(FootBlend, a_foot_on_its_way_leaves_the_ground_however_small_the_step) {
    const Character& character = default_character();
    const std::size_t joints = character.skeleton->rest.size();
    std::vector<Transform> locals(joints), models(joints);
    LocomotionState state;
    float highest = 0;
    for (int i = 0; i < 300; ++i) {
        pose(character.graph, update(character.graph, state, {0.1f, 0, 0}, k_dt), locals);
        local_to_model(*character.skeleton, locals, models);
        const Leg& leg = character.legs.side[0];
        const Transform& foot = models[static_cast<std::size_t>(leg.foot)];
        highest = std::max(highest, std::min(transform_point(foot, leg.heel).y, transform_point(foot, leg.ball).y));
    }
    EXPECT_GT(highest, 0.015f);
    EXPECT_LT(highest, 0.1f);
}

TEST(FootBlend, nothing_is_allocated) {
    const Character& character = default_character();
    std::vector<Transform> locals(character.skeleton->rest.size());
    LocomotionState state;
    const long before = test::allocation_count();
    for (int i = 0; i < 50; ++i) pose(character.graph, update(character.graph, state, {0.9f, 30, 0.2f}, k_dt), locals);
    EXPECT_EQ(test::allocation_count(), before);
}

TEST(FootPrints, a_standing_foots_print_does_not_move) {
    const Character& character = default_character();
    for (const PackedClip& clip : character.graph.clips) {
        if (clip.cycles == 0) continue;
        for (std::size_t side = 0; side < 2; ++side) {
            const FootPrints& track = clip.feet[side];
            ASSERT_EQ(track.keys.size(), static_cast<std::size_t>(clip.frame_count)) << clip.name;
            const Leg& leg = character.legs.side[side];
            float stray = 0;
            for (std::size_t f = 1; f < track.keys.size(); ++f) {
                const FootKey &a = track.keys[f - 1], &b = track.keys[f];
                const Vec3 p = transform_point(a.print, leg.ball), q = transform_point(b.print, leg.ball);
                // Age runs with time exactly where the foot is in its stance.
                if (std::fabs(b.age - a.age - 1 / clip.fps) < 1e-5f && std::max(p.y, q.y) < 0.001f)
                    stray = std::max(stray, distance(p, q));
            }
            EXPECT_LT(stray, 0.0015f) << clip.name;
            EXPECT_NEAR(track.keys.front().age, track.keys.back().age, 1e-4f) << clip.name << ": a loop";
        }
    }
}

TEST(FootPrints, steps_tell_stance_and_swing_of_the_cycle) {
    const Character& character = default_character();
    for (std::size_t i = 0; i < character.graph.clips.size(); ++i) {
        const PackedClip& clip = character.graph.clips[i];
        if (clip.cycles == 0) continue;
        for (const FootPrints& track : clip.feet) {
            ASSERT_EQ(track.steps.size(), 1u);
            EXPECT_NEAR(track.steps[0].duration, clip.duration(), 1e-4f);
            EXPECT_NEAR(track.steps[0].stance, track.steps[0].lift * clip.duration(), 0.02f);
        }
    }
}

TEST(FootPrints, tracks_that_do_not_fit_their_clip_are_found) {
    PackedClip clip = default_character().graph.clips[1];
    ASSERT_EQ(problem(clip), "");
    clip.feet[1].keys.edit([](std::vector<FootKey>& keys) { keys.pop_back(); });
    EXPECT_NE(problem(clip).find("footprint track"), std::string::npos);
    clip = default_character().graph.clips[1];
    clip.feet[0].steps.push_back({});
    EXPECT_NE(problem(clip).find("foot steps"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
