#include "tests/program/small_graph.h"

#include <cmath>
#include <cstring>

namespace surefoot {
namespace {

using namespace surefoot::test;

constexpr int k_speed = 0, k_jump = 1;

/// idle <-> walk by speed, jump by a trigger from anywhere and back when it has ended.
Program walking_machine(TransitionKind kind = TransitionKind::feather) {
    Program program = small_program();
    add_parameter(program, "speed", ParameterKind::number, 0, 5);
    add_parameter(program, "jump", ParameterKind::trigger);
    program.events = {"left", "right", "leap", "land"};
    program.groups[0].events = {{0, 0.0f}, {1, 0.5f}};
    const int idle = add_node(program, "/idle", clip_alone(0), {});
    const int walk = add_node(program, "/walk", clip_in_group(1), {});
    const int run = add_node(program, "/run", clip_in_group(2), {});
    ClipNode leap = clip_alone(3, false);
    leap.events = {{2, 0.0f}, {3, 0.8f}};
    const int jump = add_node(program, "/jump", leap, {});
    MachineNode machine;
    machine.states = {"idle", "walk", "run", "jump"};
    Condition ends;
    ends.kind = ConditionKind::remaining;
    ends.value = 0.2f;
    machine.transitions = {from_to(0, 1, 0.3f, {when(k_speed, Comparison::greater, 0.1f)}),
                           from_to(1, 0, 0.3f, {when(k_speed, Comparison::less_equal, 0.1f)}),
                           from_to(1, 2, 0.4f, {when(k_speed, Comparison::greater, 2)}),
                           from_to(2, 1, 0.4f, {when(k_speed, Comparison::less_equal, 2)}),
                           from_to(-1, 3, 0.1f, {when(k_jump, Comparison::greater, 0)}),
                           from_to(3, 0, 0.2f, {ends})};
    machine.transitions[4].priority = 1;
    for (Transition& t : machine.transitions) {
        t.kind = kind;
        t.interrupted_by = Interruption::higher;
    }
    add_node(program, "/machine", machine, {idle, walk, run, jump});
    return finished(std::move(program));
}

int machine_of(const Program& program) { return find_node(program, "/machine"); }

TEST(Machine, goes_where_its_conditions_say_and_back) {
    const Program program = walking_machine();
    Player player(program);
    const auto state = [&] { return std::string(machine_state(program, player.state, machine_of(program))); };
    player.go();
    EXPECT_EQ(state(), "idle");
    player.ask(k_speed, 1);
    player.go();
    EXPECT_EQ(state(), "walk");
    EXPECT_GT(player.frame.leaves().size(), 1u) << "both play";
    for (int i = 0; i < 30; ++i) player.go();
    EXPECT_EQ(player.frame.leaves().size(), 1u) << "the old one is culled";
    EXPECT_NEAR(player.frame.velocity.z, 1.4f, 1e-5);
    player.ask(k_speed, 0);
    for (int i = 0; i < 30; ++i) player.go();
    EXPECT_EQ(state(), "idle");
    EXPECT_EQ(player.frame.velocity.z, 0);
}

TEST(Machine, weights_follow_the_curve) {
    for (const Curve curve :
         {Curve::linear, Curve::smoothstep, Curve::cubic_in, Curve::cubic_out, Curve::cubic_in_out}) {
        Program program = walking_machine();
        std::get<MachineNode>(program.nodes.back().data).transitions[0].curve = curve;
        Player player(program);
        player.ask(k_speed, 1);
        for (int i = 1; i <= 18; ++i) {
            player.go();
            EXPECT_NEAR(player.frame.velocity.z, 1.4f * ease(curve, static_cast<float>(i) / 18), 2e-3) << i;
        }
        EXPECT_EQ(ease(curve, 0), 0);
        EXPECT_EQ(ease(curve, 1), 1);
        EXPECT_NEAR(ease(curve, 0.5f),
                    curve == Curve::cubic_in    ? 0.125f
                    : curve == Curve::cubic_out ? 0.875f
                                                : 0.5f,
                    1e-6);
    }
}

TEST(Machine, an_interruption_at_any_moment_moves_no_weight_at_once) {
    const Program program = walking_machine();
    for (int moment = 1; moment < 18; ++moment) {
        Player player(program);
        player.ask(k_speed, 1);
        for (int i = 0; i < moment; ++i) player.go();
        const float before = player.frame.velocity.z;
        player.ask(k_jump, 1);
        player.go();
        EXPECT_EQ(machine_state(program, player.state, machine_of(program)), "jump");
        EXPECT_LE(player.frame.visited, 4);
        // One frame of a tenth of a second may change the mean by a sixth of what is between them at most.
        EXPECT_LT(std::fabs(player.frame.velocity.z - before), 0.2f) << moment;
        float total = 0;
        for (const Leaf& leaf : player.frame.leaves()) total += leaf.weight;
        EXPECT_GT(total, 0.99f);
    }
}

TEST(Machine, going_back_to_a_state_that_still_fades_moves_no_weight_at_once_either) {
    Program program = walking_machine();
    for (Transition& t : std::get<MachineNode>(program.nodes.back().data).transitions)
        t.interrupted_by = Interruption::anyone;
    Player player(program);
    float before = 0;
    for (int i = 0; i < 120; ++i) {
        player.ask(k_speed, i % 20 < 10 ? 1.0f : 0.0f);
        player.go();
        // Smoothstep is at most 1.5 times as steep as a line: 1.4 m/s in 18 frames.
        EXPECT_LE(std::fabs(player.frame.velocity.z - before), 1.5f * 1.4f / 18 + 1e-4f) << i;
        before = player.frame.velocity.z;
    }
}

TEST(Machine, a_trigger_is_spent_by_the_transition_that_takes_it_and_else_forgotten_in_time) {
    Program program = walking_machine();
    program.parameters[k_jump].lasts = 0.25f;
    auto& machine = std::get<MachineNode>(program.nodes.back().data);
    Condition late;
    late.kind = ConditionKind::elapsed;
    late.value = 1;
    machine.transitions[4].conditions.push_back(late);
    Player player(program);
    player.ask(k_jump, 1);
    for (int i = 0; i < 30; ++i) player.go();
    EXPECT_EQ(get(program, player.state, k_jump), 0) << "nobody could take it for half a second";
    for (int i = 0; i < 40; ++i) player.go();
    EXPECT_EQ(machine_state(program, player.state, machine_of(program)), "idle");
    player.ask(k_jump, 1);
    player.go();
    EXPECT_EQ(machine_state(program, player.state, machine_of(program)), "jump");
    EXPECT_EQ(get(program, player.state, k_jump), 0);
}

TEST(Machine, the_highest_priority_runs_and_lower_ones_do_not_interrupt) {
    const Program program = walking_machine();
    Player player(program);
    player.ask(k_speed, 1);
    player.ask(k_jump, 1);
    player.go();
    EXPECT_EQ(machine_state(program, player.state, machine_of(program)), "jump");
    player.go();
    EXPECT_EQ(machine_state(program, player.state, machine_of(program)), "jump");
}

TEST(Machine, what_plays_once_is_left_at_its_end_window) {
    const Program program = walking_machine();
    Player player(program);
    player.ask(k_jump, 1);
    int frames = 0;
    for (player.go(); machine_state(program, player.state, machine_of(program)) == "jump" && frames < 200; ++frames)
        player.go();
    EXPECT_NEAR(static_cast<float>(frames) * k_dt, 0.8f, 0.02f);
    for (int i = 0; i < 60; ++i) player.go();
    EXPECT_NEAR(player.root.position.z, 1, 0.25) << "what of the jump was played while it faded counts in its share";
}

TEST(Machine, a_window_of_the_phase_is_waited_for) {
    Program program = walking_machine();
    auto& machine = std::get<MachineNode>(program.nodes.back().data);
    Condition window;
    window.kind = ConditionKind::window;
    window.subject = 0;
    window.value = 0.9f;
    window.value_to = 0.1f;  // across the seam
    machine.transitions[2].conditions.push_back(window);
    Player player(program);
    player.ask(k_speed, 1);
    for (int i = 0; i < 40; ++i) player.go();
    player.ask(k_speed, 3);
    float phase = 0;
    for (int i = 0; i < 120 && machine_state(program, player.state, machine_of(program)) == "walk"; ++i) {
        phase = player.frame.groups[0].phase;
        player.go();
    }
    EXPECT_EQ(machine_state(program, player.state, machine_of(program)), "run");
    EXPECT_TRUE(phase >= 0.9f || phase < 0.1f) << phase;
}

TEST(Machine, walk_to_run_stays_in_step) {
    const Program program = walking_machine();
    Player player(program);
    player.ask(k_speed, 1);
    for (int i = 0; i < 50; ++i) player.go();
    float phase = player.frame.groups[0].phase;
    player.ask(k_speed, 3);
    for (int i = 0; i < 60; ++i) {
        player.go();
        float step = player.frame.groups[0].phase - phase;
        if (step < 0) step += 1;
        EXPECT_LT(step, 1.2f * k_dt / 0.7f);
        EXPECT_GT(step, 0.8f * k_dt / 1.1f);
        phase = player.frame.groups[0].phase;
    }
}

TEST(Machine, a_group_that_begins_to_run_takes_over_the_step_of_what_played_before) {
    Program program = small_program();
    const int go = add_parameter(program, "go", ParameterKind::flag);
    const int start_clip = add_node(program, "/start", clip_alone(1), {});  // steps, in no group
    const int walk = add_node(program, "/walk", clip_in_group(2), {});
    MachineNode machine;
    machine.states = {"start", "walk"};
    machine.transitions = {from_to(0, 1, 0.2f, {when(go, Comparison::greater, 0)})};
    add_node(program, "/machine", machine, {start_clip, walk});
    program = finished(std::move(program));
    for (int frames : {10, 25, 41}) {
        Player player(program);
        for (int i = 0; i < frames; ++i) player.go();
        player.ask(go, 1);
        player.go();
        const float expected = static_cast<float>(frames) * k_dt / 1.1f;
        EXPECT_NEAR(player.frame.groups[0].phase_before, expected - std::floor(expected), 0.01f);
    }
}

TEST(Machine, a_clip_can_be_entered_on_the_right_foot) {
    Program program = walking_machine();
    auto& machine = std::get<MachineNode>(program.nodes.back().data);
    auto& jump = std::get<ClipNode>(program.nodes[3].data);
    jump.clip = 1;  // another walk, by itself
    jump.events.clear();
    machine.transitions[4].entry = Entry::phase;
    machine.transitions[4].entry_group = 0;
    ASSERT_EQ(problem(program), "");
    Player player(program);
    player.ask(k_speed, 1);
    for (int i = 0; i < 47; ++i) player.go();
    const float phase = player.frame.groups[0].phase;
    player.ask(k_jump, 1);
    player.go();
    ASSERT_EQ(player.frame.leaves().size(), 2u);
    for (const Leaf& leaf : player.frame.leaves()) {
        const float at = phase_at(program.body.clips[1], leaf.time);
        EXPECT_NEAR(at - std::floor(at), phase + k_dt / 1.1f, 0.005f);
    }
}

// --- events

std::vector<std::pair<int, int>> events_of(Player& player, float dt, float seconds) {
    std::vector<std::pair<int, int>> seen;  // event and time in thirtieths of a second, about
    float time = 0;
    while (time < seconds - 0.5f * dt) {
        player.go(dt);
        time += dt;
        float last = 1e9f;
        for (const GraphEvent& event : player.frame.events()) {
            EXPECT_LE(event.ago, last + 1e-6f) << "in order";
            EXPECT_GE(event.ago, -1e-5f);
            EXPECT_LE(event.ago, dt + 1e-5f);
            last = event.ago;
            seen.emplace_back(event.event, static_cast<int>(std::lround((time - event.ago) * 30)));
        }
    }
    return seen;
}

TEST(Machine, events_happen_once_in_order_at_any_frame_rate_and_through_transitions) {
    const Program program = walking_machine();
    std::vector<std::vector<std::pair<int, int>>> runs;
    for (const float dt : {1.0f / 240, 1.0f / 60, 1.0f / 30, 0.1f, 0.5f}) {
        Player player(program);
        std::vector<std::pair<int, int>> all;
        const auto phase = [&](float seconds) {
            for (const auto& event : events_of(player, dt, seconds)) all.push_back(event);
        };
        player.ask(k_speed, 1);
        phase(2);
        player.ask(k_speed, 3);
        phase(2);
        player.ask(k_jump, 1);
        phase(3);
        runs.push_back(all);
    }
    for (const auto& run : runs) {
        ASSERT_EQ(run.size(), runs.front().size());
        for (std::size_t i = 0; i < run.size(); ++i) {
            EXPECT_EQ(run[i].first, runs.front()[i].first) << i;
            EXPECT_NEAR(run[i].second, runs.front()[i].second, 2) << i;
        }
    }
    int leaps = 0, lands = 0, previous = -1;
    for (const auto& [event, time] : runs.front()) {
        leaps += event == 2;
        lands += event == 3;
        if (event > 1) continue;
        EXPECT_NE(event, previous) << "left and right take turns";
        previous = event;
    }
    EXPECT_EQ(leaps, 1);
    EXPECT_EQ(lands, 1);
}

TEST(Machine, what_happens_at_the_beginning_of_a_loop_happens_in_each_round) {
    Program program = small_program();
    program.events = {"begin", "end"};
    ClipNode loop = clip_alone(0);  // two seconds
    loop.events = {{0, 0.0f}, {1, 2.0f}};
    add_node(program, "/loop", loop, {});
    program = finished(std::move(program));
    for (const float dt : {1.0f / 60, 0.3f, 1.5f}) {
        Player player(program);
        int begins = 0, ends = 0;
        for (const auto& [event, time] : events_of(player, dt, 9)) ++(event == 0 ? begins : ends);
        EXPECT_EQ(begins, 5) << dt;
        EXPECT_EQ(ends, 4) << dt;
    }
}

// --- rolling back

TEST(Machine, rolled_back_and_replayed_it_is_the_same_to_the_bit) {
    for (const TransitionKind kind : {TransitionKind::feather, TransitionKind::inertialize}) {
        const Program program = walking_machine(kind);
        Player player(program);
        const auto steer = [&](int i) {
            player.ask(k_speed, i % 200 < 70 ? 0.0f : i % 200 < 140 ? 1.5f : 3.0f);
            if (i % 130 == 60) player.ask(k_jump, 1);
        };
        std::vector<std::byte> saved;
        std::vector<Transform> poses;
        RootFrame root;
        const auto frames = [&](int from, int to, bool record) {
            for (int i = from; i < to; ++i) {
                steer(i);
                player.go();
                if (record) poses.insert(poses.end(), player.locals.begin(), player.locals.end());
            }
        };
        frames(0, 500, false);
        saved = player.state;
        root = player.root;
        frames(500, 600, true);
        const std::vector<Transform> first = poses;
        const std::vector<std::byte> end = player.state;
        player.state = saved;
        player.root = root;
        poses.clear();
        frames(500, 600, true);
        EXPECT_EQ(std::memcmp(first.data(), poses.data(), first.size() * sizeof(Transform)), 0);
        EXPECT_EQ(player.state, end);
    }
}

// --- inertialization

TEST(Machine, an_inertialized_transition_jumps_in_neither_place_nor_speed_and_ends_in_the_new_state) {
    const Program program = walking_machine(TransitionKind::inertialize);
    Program cut = program;
    for (Transition& t : std::get<MachineNode>(cut.nodes.back().data).transitions) t.seconds = 0;
    float worst[2] = {}, steady = 0;
    int index = 0;
    for (const Program* p : {&program, static_cast<const Program*>(&cut)}) {
        for (int moment = 20; moment < 86; moment += 5) {
            Player player(*p);
            player.ask(k_speed, 1);
            for (int i = 0; i < moment; ++i) player.go(1.0f / 120);
            Vec3 a = player.locals[1].translation;
            player.go(1.0f / 120);
            Vec3 b = player.locals[1].translation;
            for (int i = 0; i < 100; ++i) {
                if (i == 6) player.ask(k_jump, 1);
                player.go(1.0f / 120);
                const Vec3 c = player.locals[1].translation;
                const float change = length(c - 2 * b + a) * 120;  // [m/s] of speed from frame to frame
                if (i < 6)
                    steady = std::max(steady, change);
                else
                    worst[index] = std::max(worst[index], change);
                a = b;
                b = c;
            }
        }
        ++index;
    }
    EXPECT_LT(worst[0], std::max(4 * steady, 1.5f)) << "in a tenth of a second, from a stride to a leap";
    EXPECT_GT(worst[1], 4 * worst[0]) << "a cut is what is avoided";
    Player player(program), direct(program);
    player.ask(k_speed, 1);
    for (int i = 0; i < 60; ++i) player.go();
    EXPECT_EQ(player.frame.leaves().size(), 1u);
    EXPECT_NEAR(player.frame.velocity.z, 1.4f, 1e-5);
}

TEST(Machine, inertialization_hands_over_speed_and_not_only_place) {
    const Program program = walking_machine(TransitionKind::inertialize);
    constexpr float k_fine = 1.0f / 480;
    float worst = 0, fastest = 0;
    for (int moment = 160; moment < 690; moment += 20) {
        Player player(program);
        player.ask(k_speed, 1);
        for (int i = 0; i < moment; ++i) player.go(k_fine);
        player.ask(k_jump, 1);
        const Vec3 a = player.locals[1].translation;
        player.go(k_fine);  // the change begins: still where the old state is
        const Vec3 b = player.locals[1].translation;
        player.go(k_fine);
        const Vec3 c = player.locals[1].translation;
        worst = std::max(worst, length(c - 2 * b + a) / k_fine);
        fastest = std::max(fastest, length(b - a) / k_fine);
    }
    EXPECT_GT(fastest, 2) << "of a swinging foot [m/s]";
    EXPECT_LT(worst, 0.1f * fastest) << "the frame of the change is as smooth as any";
}

TEST(Machine, an_interrupted_inertialization_folds_into_the_next) {
    const Program program = walking_machine(TransitionKind::inertialize);
    Player player(program);
    player.ask(k_speed, 1);
    for (int i = 0; i < 50; ++i) player.go();
    Vec3 before = player.locals[1].translation;
    float worst = 0;
    for (int i = 0; i < 240; ++i) {
        if (i % 7 == 0) player.ask(k_speed, i % 14 == 0 ? 3.0f : 1.0f);
        if (i == 100) player.ask(k_jump, 1);
        player.go();
        worst = std::max(worst, distance(player.locals[1].translation, before));
        before = player.locals[1].translation;
    }
    // A run's swing is the fastest that a foot goes seen from the root: about 12 m/s here.
    EXPECT_LT(worst, 0.25f);
}

// --- alignment

TEST(Machine, an_aligned_clip_arrives_exactly_where_it_shall_and_jumps_nowhere) {
    Program program = small_program();
    program.targets = {"ledge"};
    ClipNode vault = clip_alone(3, false);
    vault.target = 0;
    vault.align_from = 0.1f;
    vault.align_until = 0.7f;
    add_node(program, "/vault", vault, {});
    program = finished(std::move(program));
    for (const float dt : {1.0f / 240, 1.0f / 60, 0.05f}) {
        Player player(program);
        player.root = {{3, 0, -2}, 0.4f};
        player.targets = {{{3.6f, 0.5f, -1.2f}, 0.9f}};
        float time = 0, worst = 0;
        Vec3 before = player.root.position;
        while (time < 0.7f - 0.5f * dt) {
            player.go(dt);
            time += dt;
            worst = std::max(worst, distance(player.root.position, before) / dt);
            before = player.root.position;
        }
        if (std::fabs(time - 0.7f) > 1e-3f) continue;
        EXPECT_LT(distance(player.root.position, player.targets[0].position), 2e-3f);
        EXPECT_NEAR(player.root.yaw, 0.9f, 2e-3f);
        EXPECT_LT(worst, 4) << "smoothly: 1 m/s of its own, and what was missing";
        player.go(0.3f);
        const RootFrame after = player.targets[0] * integrate({0, 0, 1}, 0, 0.3f);
        EXPECT_LT(distance(player.root.position, after.position), 5e-3f) << "and goes on as the clip does";
    }
}

}  // namespace
}  // namespace surefoot
