#include "tests/program/small_graph.h"
#include "tests/support/allocations.h"

#include <cstring>

namespace surefoot {
namespace {

using namespace surefoot::test;

SpaceDefinition speed_space() {
    SpaceDefinition definition;
    definition.space.axes = {{"speed", "m/s", 0, 4}};
    definition.space.samples = {{0.0f}, {1.4f}, {3.5f}};
    definition.clips = {0, 1, 2};
    triangulate(definition.space);
    return definition;
}

/// The small body with spaces over speed, and one node that plays them.
Program locomotion_program() {
    Program program = small_program();
    program.body = make_locomotion_graph(program.body.skeleton, program.body.clips, speed_space(), {});
    const int speed = add_parameter(program, "speed", ParameterKind::number, -1, 5);
    LocomotionNode node;
    node.speed = {0, 1, speed};
    add_node(program, "/nodes/move", node, {});
    return finished(std::move(program));
}

TEST(Program, a_lone_locomotion_node_is_the_locomotion_itself_bit_for_bit) {
    const Program program = locomotion_program();
    Player player(program);
    LocomotionState state;
    std::vector<Transform> locals(3);
    for (int i = 0; i < 400; ++i) {
        const float speed = i < 100 ? 0.7f : i < 250 ? 2.4f : 0.0f;
        player.ask(0, speed);
        player.go();
        const LocomotionFrame frame = update(program.body, state, {speed, 0, 0}, k_dt);
        pose(program.body, frame, locals);
        ASSERT_EQ(std::memcmp(locals.data(), player.locals.data(), 3 * sizeof(Transform)), 0) << i;
        ASSERT_EQ(frame.root_delta, player.frame.root_delta) << i;
    }
}

TEST(Program, a_space_node_obeys_its_parameters) {
    Program program = small_program();
    const int pace = add_parameter(program, "pace", ParameterKind::number, 0, 4);
    const LocomotionGraph joined = make_locomotion_graph(program.body.skeleton, program.body.clips, speed_space(), {});
    SpaceNode node;
    node.space = joined.facing;
    node.at[0] = {0, 1, pace};
    add_node(program, "/nodes/move", node, {});
    program = finished(std::move(program));
    Player player(program);
    player.ask(pace, 2.0f);
    for (int i = 0; i < 600; ++i) player.go();
    EXPECT_NEAR(player.root.position.z, 20, 0.02);
}

TEST(Program, clips_of_one_group_keep_step_and_their_feet_stand) {
    Program program = small_program();
    const int mix = add_parameter(program, "mix", ParameterKind::number, 0, 1);
    const int walk = add_node(program, "/walk", clip_in_group(1), {});
    const int run = add_node(program, "/run", clip_in_group(2), {});
    add_node(program, "/lerp", LerpNode{{0, 1, mix}}, {walk, run});
    program = finished(std::move(program));
    Player player(program);
    player.ask(mix, 0.3f);
    for (int i = 0; i < 300; ++i) player.go();
    EXPECT_NEAR(player.frame.velocity.z, 0.7f * 1.4f + 0.3f * 3.5f, 1e-4);
    EXPECT_EQ(player.frame.tasks().size(), 1u) << "one weighted sum over all leaves";
    EXPECT_EQ(player.frame.leaves().size(), 2u);
    EXPECT_GT(player.frame.groups[0].rate, 1 / 1.1f);
    EXPECT_LT(player.frame.groups[0].rate, 1 / 0.7f);
}

TEST(Program, a_leader_alone_says_how_fast_its_group_goes_while_it_plays) {
    Program program = small_program();
    program.masks.push_back({0, 0, 1});
    program.groups[0].leader = "/walk";
    const int mix = add_parameter(program, "mix", ParameterKind::number, 0, 1);
    const int walk = add_node(program, "/walk", clip_in_group(1), {});
    const int run = add_node(program, "/run", clip_in_group(2), {});
    add_node(program, "/lerp", LerpNode{{0, 1, mix}}, {walk, run});
    program = finished(std::move(program));
    Player player(program);
    player.ask(mix, 0.6f);
    for (int i = 0; i < 60; ++i) player.go();
    EXPECT_NEAR(player.frame.groups[0].rate, 1 / 1.1f, 1e-4);
    player.ask(mix, 1);  // the walk plays no more, and somebody has to
    for (int i = 0; i < 60; ++i) player.go();
    EXPECT_NEAR(player.frame.groups[0].rate, 1 / 0.7f, 1e-4);

    program.groups[0].leader = "/stroll";
    EXPECT_EQ(problem(program), "/stroll: it shall lead sync group 'legs', and plays nothing of it");
    // What is laid over something leads where it is named.
    Program layered = small_program();
    layered.masks.push_back({0, 0, 1});
    layered.groups[0].leader = "/run";
    const int base = add_node(layered, "/walk", clip_in_group(1), {});
    const int over = add_node(layered, "/run", clip_in_group(2), {});
    add_node(layered, "/layer", LayerNode{1.0f, 0}, {base, over});
    layered = finished(std::move(layered));
    Player other(layered);
    for (int i = 0; i < 60; ++i) other.go();
    EXPECT_NEAR(other.frame.groups[0].rate, 1 / 0.7f, 1e-4);
}

TEST(Program, what_has_no_weight_is_culled) {
    Program program = small_program();
    const int mix = add_parameter(program, "mix", ParameterKind::number, 0, 1);
    std::vector<int> layers;
    int last = add_node(program, "/idle", clip_alone(0), {});
    for (int i = 0; i < 20; ++i) {
        const int clip = add_node(program, "/clip" + std::to_string(i), clip_alone(4), {});
        last = add_node(program, "/lerp" + std::to_string(i), LerpNode{i == 0 ? Operand{0, 1, mix} : Operand{0.0f}},
                        {last, clip});
    }
    program = finished(std::move(program));
    Player player(program);
    player.go();
    EXPECT_EQ(player.frame.visited, 21) << "20 lerps and the idle";
    EXPECT_EQ(player.frame.leaves().size(), 1u);
    player.ask(mix, 0.5f);
    player.go();
    EXPECT_EQ(player.frame.visited, 22);
    EXPECT_EQ(player.frame.leaves().size(), 2u);
}

TEST(Program, what_is_culled_stands_still_in_time) {
    Program program = small_program();
    const int mix = add_parameter(program, "mix", ParameterKind::number, 0, 1);
    const int idle = add_node(program, "/idle", clip_alone(0), {});
    const int jump = add_node(program, "/jump", clip_alone(3, false), {});
    add_node(program, "/lerp", LerpNode{{0, 1, mix}}, {idle, jump});
    program = finished(std::move(program));
    Player player(program);
    for (int i = 0; i < 90; ++i) player.go();
    player.ask(mix, 1);
    for (int i = 0; i < 30; ++i) player.go();
    EXPECT_NEAR(player.root.position.z, 0.5f, 1e-3) << "half of the jump, which began when it was first seen";
}

TEST(Program, a_rate_makes_time_and_root_slower) {
    Program program = small_program();
    const int walk = add_node(program, "/walk", clip_in_group(1), {});
    add_node(program, "/slow", RateNode{0.5f}, {walk});
    program = finished(std::move(program));
    Player player(program);
    for (int i = 0; i < 120; ++i) player.go();
    EXPECT_NEAR(player.root.position.z, 1.4f, 1e-3);
    EXPECT_NEAR(player.frame.groups[0].rate, 0.5f / 1.1f, 1e-4);
}

TEST(Program, a_mirror_exchanges_sides_and_keeps_left_strikes_left) {
    Program program = small_program();
    program.body.clips.push_back(gait_clip(*program.body.skeleton, {{0.5f, 0, 1}, 0.4f, 1}, "aside"));
    program.mirror = {{0, 2, 1}, {Quat{}, Quat{}, Quat{}}, {1, 0, 0}};
    const int flipped = add_parameter(program, "flipped", ParameterKind::flag);
    const int clip = add_node(program, "/clip", clip_in_group(5), {});
    add_node(program, "/mirror", MirrorNode{{0, 1, flipped}}, {clip});
    program = finished(std::move(program));
    Player plain(program), mirrored(program);
    mirrored.ask(flipped, 1);
    for (int i = 0; i < 37; ++i) plain.go(), mirrored.go();
    EXPECT_NEAR(mirrored.root.position.x, -plain.root.position.x, 1e-4);
    EXPECT_NEAR(mirrored.root.yaw, -plain.root.yaw, 1e-4);
    // Half a cycle (30 frames) apart, each other's mirror image.
    const Vec3 left = plain.locals[1].translation;
    for (int i = 0; i < 30; ++i) mirrored.go();
    const Vec3 right = mirrored.locals[2].translation;
    EXPECT_NEAR(right.x, -left.x, 2e-3);
    EXPECT_NEAR(right.y, left.y, 2e-3);
    EXPECT_NEAR(right.z, left.z, 2e-3);
}

TEST(Program, layers_and_additions_leave_the_root_to_their_base) {
    Program program = small_program();
    program.masks.push_back({0, 0, 1});
    program.references.push_back(program.body.skeleton->rest);
    const int walk = add_node(program, "/walk", clip_in_group(1), {});
    const int over = add_node(program, "/run", clip_in_group(2), {});
    const int layer = add_node(program, "/layer", LayerNode{1.0f, 0}, {walk, over});
    const int nod = add_node(program, "/nod", clip_alone(3, false), {});
    AdditiveNode additive;
    additive.weight = 0.5f;
    add_node(program, "/add", additive, {layer, nod});
    program = finished(std::move(program));
    Player player(program);
    for (int i = 0; i < 60; ++i) player.go();
    EXPECT_NEAR(player.root.position.z, 1.4f, 1e-3);
    EXPECT_NEAR(player.frame.groups[0].rate, 1 / 1.1f, 1e-4) << "what is laid over has no say in the pace";
    std::vector<Transform> walk_pose(3), run_pose(3), jump_pose(3);
    const GroupStep& step = player.frame.groups[0];
    const auto sampled = [&](int clip, float time, std::vector<Transform>& out) {
        const Leaf leaf{clip, time, 1};
        sample_pose(*program.body.skeleton, program.body.clips, {&leaf, 1}, out);
    };
    sampled(1, time_at(program.body.clips[1], step.phase), walk_pose);
    sampled(2, time_at(program.body.clips[2], step.phase), run_pose);
    sampled(3, 1, jump_pose);
    const auto& rest = program.body.skeleton->rest;
    const Vec3 left = walk_pose[1].translation + (jump_pose[1].translation - rest[1].translation) * 0.5f;
    const Vec3 right = run_pose[2].translation + (jump_pose[2].translation - rest[2].translation) * 0.5f;
    EXPECT_LT(distance(player.locals[1].translation, left), 1e-5);
    EXPECT_LT(distance(player.locals[2].translation, right), 1e-5);
}

TEST(Program, foot_placement_fades_as_its_node_says) {
    Program program = small_program();
    const int mix = add_parameter(program, "mix", ParameterKind::number, 0, 1);
    const int walk = add_node(program, "/walk", clip_in_group(1), {});
    const int jump = add_node(program, "/jump", clip_alone(3, false), {});
    const int air = add_node(program, "/air", FeetNode{0.0f}, {jump});
    add_node(program, "/lerp", LerpNode{{0, 1, mix}}, {walk, air});
    program = finished(std::move(program));
    Player player(program);
    for (const float share : {0.0f, 0.25f, 1.0f}) {
        player.ask(mix, share);
        player.go();
        EXPECT_NEAR(player.frame.feet, 1 - share, 1e-5);
    }
}

TEST(Program, parameters_are_clamped_glide_at_their_rate_and_ignore_what_is_no_number) {
    Program program = small_program();
    const int speed = add_parameter(program, "speed", ParameterKind::number, 0, 4);
    program.parameters[0].rate = 2;
    add_node(program, "/idle", clip_alone(0), {});
    program = finished(std::move(program));
    Player player(program);
    player.ask(speed, 100);
    player.go(0.5f);
    EXPECT_NEAR(get(program, player.state, speed), 1, 1e-5);
    for (int i = 0; i < 10; ++i) player.go(0.5f);
    EXPECT_EQ(get(program, player.state, speed), 4);
    player.ask(speed, std::nanf(""));
    player.ask(99, 1);
    player.ask(-1, 1);
    player.go();
    EXPECT_EQ(get(program, player.state, speed), 4);
}

TEST(Program, a_steady_frame_allocates_nothing) {
    const Program program = locomotion_program();
    Player player(program);
    player.ask(0, 1.0f);
    player.go();
    const long before = allocation_count();
    for (int i = 0; i < 50; ++i) player.go();
    EXPECT_EQ(allocation_count(), before);
}

TEST(Program, whatever_is_wrong_is_told_with_its_path) {
    const auto broken = [](auto&& breaks) {
        Program program = small_program();
        program.masks.push_back({0, 0, 1});
        const int speed = add_parameter(program, "speed");
        const int walk = add_node(program, "/walk", clip_in_group(1), {});
        const int idle = add_node(program, "/idle", clip_alone(0), {});
        MachineNode machine;
        machine.states = {"walk", "idle"};
        machine.transitions = {from_to(0, 1, 0.2f, {when(speed, Comparison::less, 1)})};
        add_node(program, "/machine", machine, {walk, idle});
        breaks(program);
        lay_out(program);
        return problem(program);
    };
    const auto clip = [](Program& p) -> ClipNode& { return std::get<ClipNode>(p.nodes[0].data); };
    const auto machine = [](Program& p) -> MachineNode& { return std::get<MachineNode>(p.nodes[2].data); };
    EXPECT_EQ(broken([](Program&) {}), "");
    EXPECT_EQ(broken([&](Program& p) { clip(p).clip = 99; }), "/walk: it names a clip that is not there");
    EXPECT_EQ(broken([&](Program& p) { clip(p).group = 7; }), "/walk: it names a sync group that is not there");
    EXPECT_EQ(broken([&](Program& p) { clip(p).clip = 0; }),
              "/walk: clip 'idle' has no steps, and so no place in a sync group");
    EXPECT_EQ(broken([&](Program& p) { clip(p).rate = {0, 1, 5}; }), "/walk: its rate is no number or parameter");
    EXPECT_EQ(broken([&](Program& p) { machine(p).initial = 2; }), "/machine: its first state is not there");
    EXPECT_EQ(broken([&](Program& p) { machine(p).transitions[0].to = 5; }),
              "/machine: transition '0-1': it names a state that is not there");
    EXPECT_EQ(broken([&](Program& p) { machine(p).transitions[0].from = 1; }),
              "/machine: transition '0-1': a state cannot fade into itself; let it inertialize");
    EXPECT_EQ(broken([&](Program& p) { machine(p).transitions[0].seconds = -1; }),
              "/machine: transition '0-1': it takes 0 to 60 seconds");
    EXPECT_EQ(broken([&](Program& p) { machine(p).transitions[0].conditions[0].subject = 3; }),
              "/machine: transition '0-1': a condition reads a parameter that is not there");
    EXPECT_EQ(broken([](Program& p) { p.nodes[2].children = {1, 0}; }), "/machine: its children do not lie before it");
    EXPECT_EQ(broken([](Program& p) { p.parameters[0].initial = 11; }),
              "parameter 'speed' does not begin between low and high, or has a rate below 0");
    EXPECT_EQ(broken([](Program& p) { p.nodes.clear(); }), "the graph has no nodes");
    EXPECT_EQ(broken([](Program& p) { p.rigs.push_back(nullptr); }), "a gait is missing");
    const auto no_gait = std::make_shared<const LiveRig>();
    EXPECT_EQ(broken([&](Program& p) { p.rigs.push_back(no_gait); }), "there is no gait");
    EXPECT_EQ(broken([&](Program& p) {
                  BlendSpace space;
                  space.axes = {{"speed", "m/s", 0, 2, false}};
                  space.samples = {{1.4f}};
                  space.simplices = {{0, -1, -1, -1, -1}};
                  space.neighbours = {{-1, -1, -1, -1, -1}};
                  p.body = make_locomotion_graph(p.body.skeleton, p.body.clips, {space, {1}}, {});
                  EXPECT_EQ(problem(p.body), "");
                  p.rigs.push_back(no_gait);
              }),
              "there is no gait")
        << "gaits are looked at whatever spaces there are";
}

}  // namespace
}  // namespace surefoot
