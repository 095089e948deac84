#pragma once
// Graphs over the feet-only body of treadmill_clips.h, and a character that runs one.

#include <surefoot/program/evaluate.h>
#include <surefoot/space/triangulate.h>

#include "tests/support/treadmill_clips.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace surefoot::test {

inline constexpr float k_dt = 1.0f / 60;

/// Clips: 0 idle, 1 walk (1.4 m/s), 2 run (3.5 m/s), 3 jump (one second, 1 m ahead, no cycle), 4 nod (as idle, 0.5 s).
inline Program small_program() {
    Program program;
    program.name = "small";
    const auto skeleton = feet_skeleton();
    program.body.skeleton = skeleton;
    program.body.clips.push_back(idle_clip(*skeleton));
    program.body.clips.push_back(gait_clip(*skeleton, {{0, 0, 1.4f}, 0, 1.1f}, "walk"));
    program.body.clips.push_back(gait_clip(*skeleton, {{0, 0, 3.5f}, 0, 0.7f, 0.35f}, "run"));
    Gait leap{{0, 0, 1}, 0, 1};
    leap.frames = 31;
    PackedClip jump = gait_clip(*skeleton, leap, "jump");
    jump.cyclic = false;
    jump.cycles = 0;
    jump.phase_map.clear();
    jump.translations.edit([&](std::vector<Vec3>& places) {
        for (int f = 0; f < jump.frame_count; ++f) {
            const float u = static_cast<float>(f) / 30;
            for (int foot = 0; foot < 2; ++foot)
                places[static_cast<std::size_t>(2 * f + foot)].y = -0.9f + 1.6f * u * (1 - u);
        }
    });
    program.body.clips.push_back(jump);
    program.body.clips.push_back(idle_clip(*skeleton, 0.5f, false));
    program.groups.push_back({"legs", {}});
    return program;
}

inline int add_parameter(Program& program, const std::string& name, ParameterKind kind = ParameterKind::number,
                         float low = 0, float high = 10) {
    Parameter parameter;
    parameter.name = name;
    parameter.kind = kind;
    if (kind == ParameterKind::number) parameter.low = low, parameter.high = high;
    program.parameters.push_back(parameter);
    return static_cast<int>(program.parameters.size()) - 1;
}

inline ClipNode clip_in_group(int clip) {
    ClipNode node;
    node.clip = clip;
    node.group = 0;
    return node;
}
inline ClipNode clip_alone(int clip, bool loop = true) {
    ClipNode node;
    node.clip = clip;
    node.loop = loop;
    return node;
}
inline Condition when(int parameter, Comparison comparison, float value) {
    Condition condition;
    condition.subject = static_cast<std::int16_t>(parameter);
    condition.comparison = comparison;
    condition.value = value;
    return condition;
}
inline Transition from_to(int from, int to, float seconds, std::vector<Condition> conditions) {
    Transition t;
    t.name = std::to_string(from) + "-" + std::to_string(to);
    t.from = static_cast<std::int16_t>(from);
    t.to = static_cast<std::int16_t>(to);
    t.seconds = seconds;
    t.conditions = std::move(conditions);
    return t;
}

inline Program finished(Program program) {
    lay_out(program);
    EXPECT_EQ(problem(program), "");
    return program;
}

/// A character in the world.
struct Player {
    explicit Player(const Program& program_)
        : program(program_),
          scratch(program_),
          frame(program_),
          state(program_.state_size),
          locals(program_.body.skeleton->rest.size()) {
        start(program, state);
    }
    void go(float dt = k_dt) {
        GraphInput input;
        input.dt = dt;
        input.root = root;
        input.targets = targets;
        update(program, state, input, scratch, frame);
        root = root * frame.root_delta;
        pose(program, state, frame, scratch, locals);
    }
    void ask(int parameter, float value) { set(program, state, parameter, value); }
    /// In the world.
    Vec3 foot(int side) const {
        return transform_point(to_transform(root) * locals[0], locals[static_cast<std::size_t>(1 + side)].translation);
    }

    const Program& program;
    GraphScratch scratch;
    GraphFrame frame;
    std::vector<std::byte> state;
    std::vector<Transform> locals;
    std::vector<RootFrame> targets;
    RootFrame root;
};

}  // namespace surefoot::test
