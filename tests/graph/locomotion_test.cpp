#include <surefoot/graph/locomotion.h>
#include <surefoot/space/triangulate.h>

#include "tests/support/allocations.h"
#include "tests/support/treadmill_clips.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

namespace surefoot {
namespace {

using namespace surefoot::test;

constexpr float k_degree = k_radians_per_degree;
constexpr float k_dt = 1.0f / 60;

struct Sample {
    std::int32_t clip;
    SpacePoint at;
};
SpaceDefinition space_of(std::vector<Axis> axes, const std::vector<Sample>& samples) {
    SpaceDefinition definition;
    definition.space.axes = std::move(axes);
    for (const Sample& s : samples) {
        definition.space.samples.push_back(s.at);
        definition.clips.push_back(s.clip);
    }
    triangulate(definition.space);
    return definition;
}

/// Idle, walk, run, back and turns; strafes both ways and one diagonal.
LocomotionGraph make_graph() {
    const auto skeleton = feet_skeleton();
    std::vector<PackedClip> clips;
    std::vector<Sample> facing, lateral;
    clips.push_back(idle_clip(*skeleton));
    facing.push_back({0, {0, 0}});
    lateral.push_back({0, {0, 0}});
    const auto add = [&](Gait gait) {
        clips.push_back(gait_clip(*skeleton, gait, "clip" + std::to_string(clips.size())));
        return static_cast<std::int32_t>(clips.size()) - 1;
    };
    for (const float turn : {-90.0f, 0.0f, 90.0f}) {
        facing.push_back({add({{0, 0, 1.4f}, turn * k_degree, 1.1f}), {1.4f, turn}});
        facing.push_back({add({{0, 0, 3.5f}, turn * k_degree, 0.7f}), {3.5f, turn}});
        facing.push_back({add({{0, 0, -0.8f}, turn * k_degree, 1.3f}), {-0.8f, turn}});
        if (turn != 0) facing.push_back({add({{}, turn * k_degree, 0.9f}), {0, turn}});
    }
    for (const float side : {-1.0f, 1.0f}) {
        lateral.push_back({add({{side * 1.0f, 0, 0}, 0, 1.2f}), {0, side}});
        lateral.push_back({add({{side * 0.9f, 0, 0.9f}, 0, 1.0f}), {0.9f, side * 0.9f}});
        lateral.push_back({add({{side * 0.6f, 0, -0.6f}, 0, 1.0f}), {-0.6f, side * 0.6f}});
    }
    return make_locomotion_graph(skeleton, std::move(clips),
                                 space_of({{"speed", "m/s", -1, 4}, {"turn", "deg/s", -90, 90}}, facing),
                                 space_of({{"forward", "m/s", -1, 1}, {"lateral", "m/s", -1, 1}}, lateral));
}

TEST(Locomotion, the_test_graph_is_sound) { EXPECT_EQ(problem(make_graph()), ""); }

TEST(Locomotion, a_minute_straight_covers_the_distance_asked_for) {
    const LocomotionGraph graph = make_graph();
    for (const float speed : {0.4f, 0.9f, 1.4f, 2.2f, 3.5f, -0.5f}) {
        LocomotionState state;
        RootFrame root;
        for (int i = 0; i < 3600; ++i) root = root * update(graph, state, {speed, 0, 0}, k_dt).root_delta;
        EXPECT_NEAR(root.position.z, 60 * speed, 0.001 * std::fabs(60 * speed));
        EXPECT_NEAR(root.position.x, 0, 0.01);
        EXPECT_NEAR(root.yaw, 0, 0.001);
    }
}

TEST(Locomotion, turning_integrates_to_the_angle_and_circle_asked_for) {
    const LocomotionGraph graph = make_graph();
    for (const float turn : {-60.0f, 25.0f, 90.0f})
        for (const float speed : {0.0f, 1.2f, 2.6f}) {
            LocomotionState state;
            RootFrame root;
            for (int i = 0; i < 600; ++i) {
                const LocomotionFrame frame = update(graph, state, {speed, turn, 0}, k_dt);
                ASSERT_FALSE(frame.clamped);
                root = root * frame.root_delta;
            }
            EXPECT_NEAR(root.yaw / k_degree, 10 * turn, 0.05);
            const RootFrame wanted = integrate({0, 0, speed}, turn * k_degree, 10);
            EXPECT_LT(distance(root.position, wanted.position), 0.005f) << speed << " m/s, " << turn << " deg/s";
        }
}

TEST(Locomotion, every_direction_within_the_spaces_is_obeyed) {
    const LocomotionGraph graph = make_graph();
    for (int degrees = -180; degrees <= 180; degrees += 5) {
        const float angle = static_cast<float>(degrees) * k_degree, speed = 0.45f;
        LocomotionState state;
        const LocomotionFrame frame = update(graph, state, {speed * cos(angle), 0, speed * sin(angle)}, k_dt);
        EXPECT_FALSE(frame.clamped) << degrees;
        EXPECT_NEAR(frame.velocity.z, speed * cos(angle), 1e-4) << degrees;
        EXPECT_NEAR(frame.velocity.x, speed * sin(angle), 1e-4) << degrees;
    }
}

TEST(Locomotion, velocity_changes_smoothly_with_direction) {
    const LocomotionGraph graph = make_graph();
    for (const float speed : {0.45f, 1.3f}) {
        Vec3 last;
        for (int tenth = -1800; tenth <= 1800; ++tenth) {
            const float angle = 0.1f * static_cast<float>(tenth) * k_degree;
            LocomotionState state;
            const Vec3 velocity = update(graph, state, {speed * cos(angle), 0, speed * sin(angle)}, 0).velocity;
            if (tenth > -1800) {
                EXPECT_LT(distance(velocity, last), 0.02f * speed) << 0.1 * tenth << " degrees";
            }
            last = velocity;
        }
    }
}

TEST(Locomotion, a_request_beyond_the_clips_is_clamped_and_says_so) {
    const LocomotionGraph graph = make_graph();
    LocomotionState state;
    const LocomotionFrame frame = update(graph, state, {9, 0, 0}, k_dt);
    EXPECT_TRUE(frame.clamped);
    EXPECT_NEAR(frame.velocity.z, 3.5f, 1e-3);
}

TEST(Locomotion, leaves_are_few_weigh_one_and_stay_within_their_clips) {
    const LocomotionGraph graph = make_graph();
    Random random(1);
    LocomotionState state;
    for (int i = 0; i < 5000; ++i) {
        const LocomotionRequest request{random.between(-2, 5), random.between(-120, 120), random.between(-2, 2)};
        const LocomotionFrame frame = update(graph, state, request, random.between(0, 0.1f));
        ASSERT_GE(frame.leaf_count, 1);
        ASSERT_LE(frame.leaf_count, 6);  // 2 x (2 + 1)
        float sum = 0;
        for (const Leaf& leaf : frame.leaves()) {
            EXPECT_GT(leaf.weight, 0);
            EXPECT_GE(leaf.time, 0);
            EXPECT_LE(leaf.time, graph.clips[static_cast<std::size_t>(leaf.clip)].duration());
            for (const Leaf& other : frame.leaves()) EXPECT_TRUE(&other == &leaf || other.clip != leaf.clip);
            sum += leaf.weight;
        }
        EXPECT_NEAR(sum, 1, 1e-5);
        EXPECT_GE(frame.phase, 0);
        EXPECT_LT(frame.phase, 1);
        ASSERT_TRUE(std::isfinite(frame.phase_rate) && is_finite(frame.root_delta.position));
        EXPECT_LE(std::fabs(frame.phase_rate), 3);
    }
}

TEST(Locomotion, copying_the_state_back_replays_the_same_bits) {
    const LocomotionGraph graph = make_graph();
    const auto request = [](int i) {
        return LocomotionRequest{1.5f + sin(0.05f * static_cast<float>(i)), 60 * sin(0.03f * static_cast<float>(i)),
                                 0.8f * sin(0.02f * static_cast<float>(i))};
    };
    LocomotionState state, saved;
    std::vector<Transform> locals(3);
    std::vector<float> first, again;
    const auto play = [&](int from, std::vector<float>& out) {
        for (int i = from; i < 600; ++i) {
            if (i == 500 && out.empty()) std::memcpy(&saved, &state, sizeof state);
            const LocomotionFrame frame = update(graph, state, request(i), k_dt);
            pose(graph, frame, locals);
            if (i < 500) continue;
            for (const Transform& t : locals)
                out.insert(out.end(), {t.rotation.x, t.rotation.w, t.translation.x, t.translation.y, t.translation.z});
            out.insert(out.end(),
                       {frame.root_delta.position.x, frame.root_delta.position.z, frame.root_delta.yaw, frame.phase});
        }
    };
    play(0, first);
    const LocomotionState end = state;
    std::memcpy(&state, &saved, sizeof state);
    play(500, again);
    ASSERT_EQ(first.size(), again.size());
    EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(float)), 0);
    EXPECT_EQ(std::memcmp(&state, &end, sizeof end), 0);
}

TEST(Locomotion, a_frame_allocates_nothing) {
    const LocomotionGraph graph = make_graph();
    LocomotionState state;
    std::vector<Transform> locals(3);
    const long before = allocation_count();
    for (int i = 0; i < 1000; ++i) {
        const float t = 0.01f * static_cast<float>(i);
        const LocomotionFrame frame = update(graph, state, {2 * sin(t), 90 * cos(t), sin(3 * t)}, k_dt);
        pose(graph, frame, locals);
    }
    EXPECT_EQ(allocation_count() - before, 0);
    const auto counted = std::make_unique<int>(1);
    EXPECT_EQ(allocation_count() - before, 1) << "the counter must count";
}

/// Largest speed over the ground of a foot that stands in both clips of a blend.
float worst_stance_speed(const LocomotionGraph& graph, const LocomotionRequest& request, float duty) {
    LocomotionState state;
    RootFrame root;
    std::vector<Transform> locals(3), models(3);
    Vec3 last[2];
    bool stood[2] = {};
    float worst = 0;
    const float dt = 1.0f / 240;
    for (int i = 0; i < 720; ++i) {
        const LocomotionFrame frame = update(graph, state, request, dt);
        root = root * frame.root_delta;
        pose(graph, frame, locals);
        local_to_model(*graph.skeleton, locals, models);
        for (int foot = 0; foot < 2; ++foot) {
            const float share =
                frame.phase - 0.5f * static_cast<float>(foot) + (foot == 1 && frame.phase < 0.5f ? 1.0f : 0.0f);
            const bool stands = share > 0.02f && share < duty - 0.02f;
            const Vec3 at = transform_point(to_transform(root), models[static_cast<std::size_t>(1 + foot)].translation);
            if (stands && stood[foot]) worst = std::max(worst, distance(at, last[foot]) / dt);
            stood[foot] = stands;
            last[foot] = at;
        }
    }
    return worst;
}

TEST(Locomotion, feet_of_a_blend_of_walk_and_run_stand_still) {
    const LocomotionGraph graph = make_graph();
    for (const float speed : {1.4f, 1.8f, 2.5f, 3.2f})
        EXPECT_LT(worst_stance_speed(graph, {speed, 0, 0}, 0.6f), 0.01f) << speed << " m/s";
    for (const float speed : {0.3f, 0.7f, 1.2f})
        EXPECT_LT(worst_stance_speed(graph, {speed, 0, 0}, 0.6f), 0.01f) << speed << " m/s, blended with the idle";
}

TEST(Locomotion, feet_turning_on_the_spot_skate_little_at_any_rate) {
    const LocomotionGraph graph = make_graph();
    EXPECT_LT(worst_stance_speed(graph, {0, 90, 0}, 0.6f), 0.01f);
    EXPECT_LT(worst_stance_speed(graph, {0, 45, 0}, 0.6f), 0.02f);
}

TEST(Locomotion, a_lone_clip_plays_as_recorded_though_its_strikes_are_uneven) {
    const auto skeleton = feet_skeleton();
    std::vector<PackedClip> clips;
    clips.push_back(gait_clip(*skeleton, {{0, 0, 1.4f}, 0, 1.1f, 0.6f, 0.42f, 0.13f}));
    const LocomotionGraph graph =
        make_locomotion_graph(skeleton, std::move(clips), space_of({{"speed", "m/s", 0, 2}}, {{0, {1.4f}}}), {});
    ASSERT_EQ(problem(graph), "");
    LocomotionState state;
    float time = update(graph, state, {1.4f, 0, 0}, 0).leaf[0].time;
    double played = 0;
    for (int i = 0; i < 6600; ++i) {
        const float next = update(graph, state, {1.4f, 0, 0}, 0.001f).leaf[0].time;
        const float step = next - time + (next < time ? graph.clips[0].duration() : 0);
        EXPECT_NEAR(step, 0.001f, 3e-4f);
        played += step;
        time = next;
    }
    EXPECT_NEAR(played, 6.6, 0.01);
}

TEST(Locomotion, an_idle_does_not_drag_the_phase) {
    const LocomotionGraph graph = make_graph();
    LocomotionState state;
    for (const float speed : {0.2f, 0.7f, 1.4f}) {
        const LocomotionFrame frame = update(graph, state, {speed, 0, 0}, k_dt);
        EXPECT_NEAR(frame.phase_rate, 1 / 1.1f, 1e-3) << "the walk's own cadence at " << speed;
    }
    const LocomotionFrame frame = update(graph, state, {0, 0, 0}, k_dt);
    EXPECT_FALSE(frame.stepping);
    EXPECT_EQ(frame.phase_rate, 0);
}

TEST(Locomotion, the_rate_of_a_blend_lies_between_the_clips_and_moves_smoothly_through_standing) {
    const LocomotionGraph graph = make_graph();
    LocomotionState state;
    const float between_clips = update(graph, state, {2.45f, 0, 0}, 0).phase_rate;
    // (0.5 * 1.4 + 0.5 * 3.5) / (0.5 * 1.4 * 1.1 + 0.5 * 3.5 * 0.7) cycles a second
    EXPECT_NEAR(between_clips, 2.45f / (0.5f * 1.4f * 1.1f + 0.5f * 3.5f * 0.7f), 1e-3);
}

TEST(Locomotion, clips_of_two_cycles_take_turns_with_clips_of_one) {
    const auto skeleton = feet_skeleton();
    std::vector<PackedClip> clips;
    clips.push_back(gait_clip(*skeleton, {{0, 0, 1}, 0, 1.0f}));
    PackedClip two = gait_clip(*skeleton, {{0, 0, 2}, 0, 2.0f});
    two.cycles = 2;
    two.phase_map = {{0.0f, 0.0f}, {0.25f, 0.5f}, {0.5f, 1.0f}, {0.75f, 1.5f}, {1.0f, 2.0f}};
    clips.push_back(two);
    const LocomotionGraph graph =
        make_locomotion_graph(skeleton, std::move(clips), space_of({{"speed", "m/s", 0, 2}}, {{0, {1}}, {1, {2}}}), {});
    ASSERT_EQ(problem(graph), "");
    LocomotionState state;
    bool second_half = false;
    for (int i = 0; i < 300; ++i) {
        const LocomotionFrame frame = update(graph, state, {1.5f, 0, 0}, 0.01f);
        ASSERT_EQ(frame.leaf_count, 2);
        const float one = frame.leaf[frame.leaf[0].clip == 0 ? 0 : 1].time,
                    other = frame.leaf[frame.leaf[0].clip == 0 ? 1 : 0].time;
        EXPECT_NEAR(other - std::floor(other), one, 2e-4);  // both count a cycle a second; only which cycle differs
        second_half |= other > 1.2f;
    }
    EXPECT_TRUE(second_half);
}

TEST(Locomotion, clips_without_steps_go_round_or_there_and_back_and_never_jump) {
    const auto skeleton = feet_skeleton();
    for (const bool cyclic : {true, false}) {
        std::vector<PackedClip> clips{idle_clip(*skeleton, 2, cyclic)};
        const LocomotionGraph graph =
            make_locomotion_graph(skeleton, std::move(clips), space_of({{"speed", "m/s", 0, 1}}, {{0, {0}}}), {});
        LocomotionState state;
        state.clock = 1e7;  // after four months of play
        float last = update(graph, state, {}, 0).leaf[0].time;
        for (int i = 0; i < 1000; ++i) {
            const float next = update(graph, state, {}, k_dt).leaf[0].time;
            const float step = std::fabs(next - last);
            EXPECT_LT(cyclic ? std::min(step, 2 - step) : step, 1.01f * k_dt);
            last = next;
        }
    }
}

TEST(Locomotion, without_a_turn_axis_the_root_turns_as_asked) {
    const auto skeleton = feet_skeleton();
    std::vector<PackedClip> clips{gait_clip(*skeleton, {{0, 0, 1.4f}, 0.01f, 1.1f})};
    const LocomotionGraph graph =
        make_locomotion_graph(skeleton, std::move(clips), space_of({{"speed", "m/s", 0, 2}}, {{0, {1.4f}}}), {});
    LocomotionState state;
    EXPECT_NEAR(update(graph, state, {1.4f, 40, 0}, k_dt).turn, 40, 1e-4);
}

/// Walk and jog over speed, turn, slope and style: each clip at a corner of the box.
LocomotionGraph make_wide_graph(Outside outside = Outside::clamp) {
    const auto skeleton = feet_skeleton();
    std::vector<PackedClip> clips;
    std::vector<Sample> samples;
    for (const float speed : {1.0f, 3.0f})
        for (const float turn : {-60.0f, 60.0f})
            for (const float slope : {-10.0f, 10.0f})
                for (const float style : {0.0f, 1.0f}) {
                    clips.push_back(gait_clip(*skeleton, {{0, 0, speed}, turn * k_degree, speed < 2 ? 1.1f : 0.8f},
                                              "clip" + std::to_string(clips.size())));
                    samples.push_back({static_cast<std::int32_t>(clips.size()) - 1, {speed, turn, slope, style}});
                }
    SpaceDefinition space = space_of(
        {{"speed", "m/s", 0, 4}, {"turn", "deg/s", -90, 90}, {"slope", "deg", -15, 15}, {"style", "", 0, 1}}, samples);
    space.space.outside = outside;
    return make_locomotion_graph(skeleton, std::move(clips), std::move(space), {});
}

TEST(Locomotion, a_space_of_four_dimensions_is_walked_and_each_axis_moves_its_own_weights) {
    const LocomotionGraph graph = make_wide_graph();
    ASSERT_EQ(problem(graph), "");
    ASSERT_EQ(graph.custom_names, std::vector<std::string>{"style"});
    EXPECT_EQ(graph.custom_slot("style"), 0);
    EXPECT_EQ(graph.custom_slot("mood"), -1);
    Random random(2);
    LocomotionState state;
    for (int i = 0; i < 2000; ++i) {
        const float at[] = {random.between(1, 3), random.between(-60, 60), random.between(-10, 10), random.unit()};
        const LocomotionRequest request = request_at(graph.facing, at);
        const LocomotionFrame frame = update(graph, state, request, k_dt);
        ASSERT_FALSE(frame.clamped);
        EXPECT_NEAR(frame.velocity.z, request.speed, 1e-3);
        EXPECT_NEAR(frame.turn, request.turn, 2e-2);
        float slope = 0, style = 0;
        for (const Leaf& leaf : frame.leaves()) {
            const SpacePoint& at = graph.facing.space.samples[static_cast<std::size_t>(leaf.clip)];
            slope += leaf.weight * at[2];
            style += leaf.weight * at[3];
        }
        EXPECT_NEAR(slope, request.slope, 1e-3);
        EXPECT_NEAR(style, request.custom[0], 1e-4);
    }
}

TEST(Locomotion, extrapolation_obeys_a_little_beyond_the_clips_and_the_feet_still_stand) {
    LocomotionGraph graph = make_graph();
    graph.facing.space.outside = Outside::extrapolate;
    ASSERT_EQ(problem(graph), "");
    const auto taken_off = [&](const LocomotionRequest& request) {
        LocomotionState state;
        const LocomotionFrame frame = update(graph, state, request, k_dt);
        EXPECT_FALSE(frame.clamped);
        EXPECT_NEAR(frame.velocity.z, request.speed, 1e-4);
        EXPECT_NEAR(frame.turn, request.turn, 1e-2);
        float sum = 0, least = 0;
        for (const Leaf& leaf : frame.leaves()) {
            sum += leaf.weight;
            least = std::min(least, leaf.weight);
        }
        EXPECT_NEAR(sum, 1, 1e-5);
        return least < -0.01f;
    };
    for (const float speed : {3.6f, 3.9f, -0.9f}) {
        EXPECT_TRUE(taken_off({speed, 0})) << speed;
        EXPECT_LT(worst_stance_speed(graph, {speed, 0}, 0.6f), 0.01f) << speed;
    }
    EXPECT_TRUE(taken_off({1.4f, 100}));
    EXPECT_TRUE(taken_off({3.7f, 95}));
    LocomotionState state;
    const LocomotionFrame far = update(graph, state, {9, 0}, k_dt);
    EXPECT_TRUE(far.clamped);
    EXPECT_GT(far.velocity.z, 3.8f);
}

TEST(Locomotion, a_wide_space_extrapolates_in_all_its_dimensions_at_once) {
    const LocomotionGraph graph = make_wide_graph(Outside::extrapolate);
    LocomotionRequest request{3.2f, 66};
    request.slope = -11;
    request.custom[0] = 1.05f;
    LocomotionState state;
    const LocomotionFrame frame = update(graph, state, request, k_dt);
    EXPECT_FALSE(frame.clamped);
    EXPECT_NEAR(frame.velocity.z, 3.2f, 1e-3);
    EXPECT_NEAR(frame.turn, 66, 2e-2);
}

TEST(Locomotion, direction_and_pace_as_axes_turn_through_backwards_without_a_seam) {
    const auto skeleton = feet_skeleton();
    std::vector<PackedClip> clips{idle_clip(*skeleton)};
    SpaceDefinition ring;
    ring.space.axes = {{"travel", "deg", -180, 180, true}, {"pace", "m/s", 0, 2}};
    for (int n = 0; n < 8; ++n) {
        const float angle = static_cast<float>(n - 4) * 45 * k_degree;
        ring.clips.push_back(0);  // standing has no direction: it is there in each
        ring.space.samples.push_back({static_cast<float>(n - 4) * 45, 0});
        ring.clips.push_back(static_cast<std::int32_t>(clips.size()));
        ring.space.samples.push_back({static_cast<float>(n - 4) * 45, 1.2f});
        clips.push_back(gait_clip(*skeleton, {{1.2f * sin(angle), 0, 1.2f * cos(angle)}, 0, 1.0f}));
    }
    add_wrap_copies(ring.space);
    for (std::size_t i = ring.clips.size(); i < ring.space.samples.size(); ++i)
        ring.clips.push_back(ring.clips[static_cast<std::size_t>(ring.space.copy_of[i])]);
    triangulate(ring.space);
    const LocomotionGraph graph = make_locomotion_graph(skeleton, std::move(clips), {}, std::move(ring));
    ASSERT_EQ(problem(graph), "");
    Vec3 last;
    for (int tenth = 0; tenth <= 7200; ++tenth) {
        const float angle = 0.1f * static_cast<float>(tenth) * k_degree;
        LocomotionState state;
        const LocomotionFrame frame = update(graph, state, {0.9f * cos(angle), 0, 0.9f * sin(angle)}, 0);
        ASSERT_FALSE(frame.clamped) << tenth;
        // Means of directions are no arcs: between clips 45 degrees apart the velocity is some degrees off.
        EXPECT_LT(distance(frame.velocity, Vec3{0.9f * sin(angle), 0, 0.9f * cos(angle)}), 0.2f) << tenth;
        if (tenth > 0) {
            ASSERT_LT(distance(frame.velocity, last), 0.004f) << tenth;
        }
        last = frame.velocity;
    }
}

TEST(Locomotion, a_graph_has_room_for_four_axes_of_the_users_own) {
    const auto skeleton = feet_skeleton();
    const auto space = [](const char* a, const char* b, const char* c) {
        return space_of({{a, "", 0, 1}, {b, "", 0, 1}, {c, "", 0, 1}}, {{0, {0, 0, 0}}});
    };
    EXPECT_EQ(
        problem(make_locomotion_graph(skeleton, {idle_clip(*skeleton)}, space("a", "b", "c"), space("c", "d", "a"))),
        "");
    EXPECT_NE(
        problem(make_locomotion_graph(skeleton, {idle_clip(*skeleton)}, space("a", "b", "c"), space("d", "e", "a")))
            .find("from 'a' to 'e'"),
        std::string::npos);
}

TEST(Locomotion, faults_of_a_graph_are_told) {
    LocomotionGraph graph = make_graph();
    graph.facing.clips[2] = 99;
    EXPECT_NE(problem(graph).find("space 'facing' names a clip"), std::string::npos);
    graph = make_graph();
    graph.lateral.axes[0] = RequestAxis::none;
    EXPECT_NE(problem(graph).find("that no request can set"), std::string::npos);
    graph = make_graph();
    graph.clips[1].rotations = {};
    EXPECT_NE(problem(graph).find("rotations"), std::string::npos);
    EXPECT_NE(problem(LocomotionGraph{}).find("no skeleton"), std::string::npos);
}

TEST(Integrate, agrees_with_many_small_steps) {
    for (const float turn : {0.0f, 0.02f, 1.0f, -3.0f}) {
        RootFrame sum;
        for (int i = 0; i < 1000; ++i) sum = sum * integrate({0.4f, 0.1f, 1.5f}, turn, 0.001f);
        const RootFrame once = integrate({0.4f, 0.1f, 1.5f}, turn, 1);
        EXPECT_LT(distance(sum.position, once.position), 1e-4f) << turn;
        EXPECT_NEAR(sum.yaw, once.yaw, 1e-4);
    }
}

TEST(Approach, moves_at_the_given_rates_and_arrives) {
    LocomotionRequest current;
    const LocomotionRequest wanted{3, -100, 4};
    int steps = 0;
    while (!(current.speed == 3 && current.turn == -100 && current.lateral == 4) && steps < 1000) {
        const LocomotionRequest next = approach(current, wanted, 0.1f);
        EXPECT_LE(std::sqrt((next.speed - current.speed) * (next.speed - current.speed) +
                            (next.lateral - current.lateral) * (next.lateral - current.lateral)),
                  0.2501f);
        EXPECT_LE(std::fabs(next.turn - current.turn), 24.001f);
        current = next;
        ++steps;
    }
    EXPECT_EQ(steps, 20);  // 5 m/s at 2.5 m/s^2
    LocomotionRequest steep;
    steep.slope = 30;
    steep.custom[1] = -1;
    const LocomotionRequest next = approach({}, steep, 0.1f);
    EXPECT_FLOAT_EQ(next.slope, 6);
    EXPECT_FLOAT_EQ(next.custom[1], -0.2f);
}

}  // namespace
}  // namespace surefoot
