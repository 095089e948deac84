#include <surefoot/program/inertia.h>
#include <surefoot/program/step.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace surefoot {
namespace {

constexpr float k_longest_step = 1.0f / 30;  // [s] so that events and transitions come on time in long frames, too
constexpr int k_most_steps = 300;

std::size_t most_leaves(const Program& program) {
    std::size_t count = 0;
    for (const Node& node : program.nodes) {
        if (std::holds_alternative<ClipNode>(node.data)) count += 1;
        if (std::holds_alternative<SpaceNode>(node.data)) count += k_max_blend_weights;
        if (std::holds_alternative<LocomotionNode>(node.data)) count += k_max_locomotion_leaves + k_max_blend_weights;
    }
    return count;
}

std::size_t most_tasks(const Program& program) {
    std::size_t count = 0;
    for (const Node& node : program.nodes)
        count += std::holds_alternative<MachineNode>(node.data) ? k_max_fading + 1 : 3;
    return count;
}

std::size_t joints_of(const Program& program) { return program.body.skeleton->rest.size(); }

/// Adds what `above` differs from the reference.
void add_pose(const Program& program, const PoseTask& task, std::span<Transform> base,
              std::span<const Transform> above) noexcept {
    const auto& reference = program.references[static_cast<std::size_t>(task.reference)];
    const float* mask = task.mask < 0 ? nullptr : program.masks[static_cast<std::size_t>(task.mask)].data();
    for (std::size_t j = 0; j < base.size(); ++j) {
        const float share = task.weight * (mask == nullptr ? 1.0f : mask[j]);
        if (!(share > 0)) continue;
        const Quat difference = conjugate(reference[j].rotation) * above[j].rotation;
        base[j].rotation = normalized(base[j].rotation * nlerp(Quat{}, difference, share));
        base[j].translation += (above[j].translation - reference[j].translation) * share;
    }
}

/// How far a task's feet are held. What is mirrored is not: its feet are the other ones.
std::array<FootOffset, 2> hold_of(const Program& program, std::span<const std::byte> state,
                                  const PoseTask& task) noexcept {
    if (!program.holds_feet || !task.steps || task.turned) return {};
    const auto& memory = memory_at<FeetMemory>(state, program.feet_memory);
    if (task.group >= 0 && task.group != memory.group) return {};
    return memory.feet.hold;
}

void sample_task(const Program& program, std::span<const std::byte> state, const GraphFrame& frame,
                 const PoseTask& task, std::span<Transform> out) noexcept {
    const LocomotionGraph& body = program.body;
    const std::span<const Leaf> leaves =
        frame.leaves().subspan(static_cast<std::size_t>(task.first_leaf), static_cast<std::size_t>(task.leaf_count));
    sample_pose(*body.skeleton, body.clips, leaves, out);
    const std::array<FootOffset, 2> hold = hold_of(program, state, task);
    if (!task.blends && !is_held(hold)) return;
    GroupStep step = task.group >= 0 ? frame.groups[static_cast<std::size_t>(task.group)] : GroupStep{};
    if (task.turned) {
        turn_phase(step.phase, step.cycle);
        turn_phase(step.phase_before, step.cycle_before);
    }
    blend_feet(body.legs, body.clips,
               {leaves, step.phase, step.cycle, step.phase_before, step.cycle_before, step.rate, task.velocity,
                task.turn, hold},
               out);
}

/// The tree's own pose, before inertialization.
void evaluate_tasks(const Program& program, std::span<const std::byte> state, const GraphFrame& frame,
                    GraphScratch::Parts& parts, std::span<Transform> locals) noexcept {
    const std::size_t joints = joints_of(program);
    const auto reg = [&](int index) noexcept -> std::span<Transform> {
        return index == 0 ? locals.first(joints)
                          : std::span(parts.registers).subspan(static_cast<std::size_t>(index - 1) * joints, joints);
    };
    for (const PoseTask& task : frame.tasks()) {
        const std::span<Transform> to = reg(task.to);
        switch (task.kind) {
            case PoseTask::Kind::sample:
                sample_task(program, state, frame, task, to);
                break;
            case PoseTask::Kind::gait: {
                const Node& node = program.nodes[static_cast<std::size_t>(task.node)];
                const auto rig = static_cast<std::size_t>(std::get_if<GaitNode>(&node.data)->rig);
                pose(*program.rigs[rig], memory_at<LiveState>(state, node.memory), parts.rigs[rig], to);
                break;
            }
            case PoseTask::Kind::blend:
                lay_over(to, reg(task.to + 1), task.weight, nullptr);
                break;
            case PoseTask::Kind::layer: {
                const auto index = static_cast<std::size_t>(task.mask);
                const auto& mask = task.style_mask ? program.body.styles[index].mask : program.masks[index];
                lay_over(to, reg(task.to + 1), task.weight, mask.data());
                break;
            }
            case PoseTask::Kind::add:
                add_pose(program, task, to, reg(task.to + 1));
                break;
            case PoseTask::Kind::mirror: {
                const std::span<Transform> memory = parts.mirrored;
                mirror_pose(*program.body.skeleton, program.mirror, to, memory.first(joints), memory.subspan(joints));
                std::copy_n(memory.begin(), joints, to.begin());
                break;
            }
        }
    }
}

/// Where an inertialized transition began in the step that `frame` has just made: what the old states' pose and
/// movement were ahead of the new ones'. `parts.before` is the state before the step.
void begin_inertia(const Program& program, std::span<std::byte> state, const GraphInput& input, float dt, float seconds,
                   GraphScratch& scratch, const GraphFrame& frame) noexcept {
    GraphScratch::Parts& parts = scratch.parts();
    auto& inertia = memory_at<InertiaMemory>(state, program.inertia_memory);
    inertia = {};
    evaluate_tasks(program, state, frame, parts, parts.to);
    const auto run_copy = [&](std::span<const std::byte> from, float time, std::span<Transform> locals) noexcept {
        std::memcpy(parts.copy.data(), from.data(), from.size());
        GraphStep step(program, parts.copy, scratch, parts.spare);
        step.begin();
        step.run(input, time, 0, false);
        pose(program, parts.copy, parts.spare, scratch, locals);
    };
    run_copy(state, dt, parts.to_after);
    run_copy(parts.before, 0, parts.from_before);
    run_copy(parts.before, dt, parts.from);
    carry(program, state, seconds, dt,
          {parts.from, parts.from_before, parts.to, parts.to_after, parts.spare.velocity - frame.velocity,
           parts.spare.turn - frame.turn});
}

}  // namespace

GraphFrame::GraphFrame(const Program& program) : task_(most_tasks(program)), leaf_(most_leaves(program)) {}

GraphScratch::Parts::Parts(const Program& program)
    : nodes(program.nodes.size()),
      stack(static_cast<std::size_t>(program.registers)),
      registers(joints_of(program) * static_cast<std::size_t>(std::max(program.registers - 1, 0))),
      mirrored(3 * joints_of(program)),
      spare(program) {
    for (const Node& node : program.nodes) {
        const bool mixes_clips =
            std::holds_alternative<SpaceNode>(node.data) || std::holds_alternative<LocomotionNode>(node.data);
        mix_of.push_back(mixes_clips ? static_cast<std::int16_t>(mixes.size()) : std::int16_t{-1});
        if (mixes_clips) mixes.emplace_back();
    }
    for (const auto& rig : program.rigs) rigs.emplace_back(*rig);
    if (!program.inertializes) return;
    before.resize(program.state_size);
    copy.resize(program.state_size);
    for (std::vector<Transform>* locals : {&from, &from_before, &to, &to_after}) locals->resize(joints_of(program));
}

GraphScratch::GraphScratch(const Program& program) : parts_(std::make_unique<Parts>(program)) {}
GraphScratch::~GraphScratch() = default;
GraphScratch::GraphScratch(GraphScratch&&) noexcept = default;
GraphScratch& GraphScratch::operator=(GraphScratch&&) noexcept = default;

void reset_subtree(const Program& program, std::span<std::byte> state, int root) noexcept {
    for (int i = program.nodes[static_cast<std::size_t>(root)].first; i <= root; ++i) {
        const Node& node = program.nodes[static_cast<std::size_t>(i)];
        if (const auto* clip = std::get_if<ClipNode>(&node.data)) {
            if (clip->group < 0) memory_at<ClipMemory>(state, node.memory) = {};
        } else if (std::holds_alternative<SpaceNode>(node.data) || std::holds_alternative<LocomotionNode>(node.data)) {
            memory_at<SpaceMemory>(state, node.memory) = {};
        } else if (const auto* machine = std::get_if<MachineNode>(&node.data)) {
            auto& memory = memory_at<MachineMemory>(state, node.memory) = {};
            memory.current = machine->initial;
        } else if (const auto* gait = std::get_if<GaitNode>(&node.data)) {
            LiveRequest request;
            request.speed = value_of(state, gait->speed);
            request.turn = value_of(state, gait->turn);
            memory_at<LiveState>(state, node.memory) =
                start(*program.rigs[static_cast<std::size_t>(gait->rig)], request);
        }
    }
}

void start(const Program& program, std::span<std::byte> state) noexcept {
    assert(state.size() >= program.state_size && reinterpret_cast<std::uintptr_t>(state.data()) % 8 == 0);
    std::memset(state.data(), 0, program.state_size);
    if (program.holds_feet) memory_at<FeetMemory>(state, program.feet_memory) = {};
    for (std::size_t i = 0; i < program.parameters.size(); ++i) {
        const float value = program.parameters[i].initial;
        memory_at<ParameterMemory>(state, parameter_memory(i)) = {value, value, 0};
    }
    reset_subtree(program, state, static_cast<int>(program.nodes.size()) - 1);
}

void set(const Program& program, std::span<std::byte> state, int parameter, float value) noexcept {
    if (parameter < 0 || static_cast<std::size_t>(parameter) >= program.parameters.size() || !(value == value)) return;
    const Parameter& p = program.parameters[static_cast<std::size_t>(parameter)];
    auto& memory = memory_at<ParameterMemory>(state, parameter_memory(static_cast<std::size_t>(parameter)));
    memory.asked = p.kind == ParameterKind::number ? std::clamp(value, p.low, p.high) : (value > 0 ? 1.0f : 0.0f);
    memory.age = 0;
}

float get(const Program& program, std::span<const std::byte> state, int parameter) noexcept {
    if (parameter < 0 || static_cast<std::size_t>(parameter) >= program.parameters.size()) return 0;
    return memory_at<ParameterMemory>(state, parameter_memory(static_cast<std::size_t>(parameter))).value;
}

void GraphStep::begin() noexcept {
    frame_.root_delta = {};
    frame_.event_count_ = 0;
    frame_.events_lost = 0;
}

float GraphStep::run(const GraphInput& input, float dt, float left, bool decide) noexcept {
    const std::size_t first_event = frame_.event_count_;
    advance_parameters(dt);
    const float inertialize = pass_down(dt, decide);
    run_groups(dt, left);
    run_leaves(input, dt, left);
    sort_events(first_event);
    pass_up();
    if (program_.inertializes && inertialize < 0) {
        auto& inertia = memory_at<InertiaMemory>(state_, program_.inertia_memory);
        inertia.elapsed = std::min(inertia.elapsed + dt, inertia.seconds);
        const float share = carried_share(inertia);
        frame_.velocity += inertia.velocity * share;
        frame_.turn += inertia.turn * share;
    }
    const RootFrame moved = integrate(frame_.velocity, frame_.turn, dt);
    frame_.root_delta = frame_.root_delta * moved;
    hold_feet(moved, dt);
    return inertialize;
}

void update(const Program& program, std::span<std::byte> state, const GraphInput& input, GraphScratch& scratch,
            GraphFrame& frame) noexcept {
    const float dt = input.dt > 0 ? input.dt : 0.0f;
    int steps = 1;
    if (input.decide) steps = std::clamp(static_cast<int>(std::ceil(dt / k_longest_step - 0.01f)), 1, k_most_steps);
    const float step_time = dt / static_cast<float>(steps);
    GraphScratch::Parts& parts = scratch.parts();
    GraphStep step(program, state, scratch, frame);
    step.begin();
    for (int i = 0; i < steps; ++i) {
        const bool may_inertialize = program.inertializes && input.decide;
        if (may_inertialize) std::memcpy(parts.before.data(), state.data(), program.state_size);
        const RootFrame before = frame.root_delta;
        const float left = static_cast<float>(steps - 1 - i) * step_time;
        const float seconds = step.run(input, step_time, left, input.decide);
        if (!(seconds >= 0 && may_inertialize)) continue;
        begin_inertia(program, state, input, step_time, seconds, scratch, frame);
        // In this step the root still moves as it did.
        const auto& inertia = memory_at<InertiaMemory>(std::span<const std::byte>(state), program.inertia_memory);
        frame.velocity += inertia.velocity;
        frame.turn += inertia.turn;
        frame.root_delta = before * integrate(frame.velocity, frame.turn, step_time);
    }
}

void pose(const Program& program, std::span<const std::byte> state, const GraphFrame& frame, GraphScratch& scratch,
          std::span<Transform> locals) noexcept {
    evaluate_tasks(program, state, frame, scratch.parts(), locals);
    if (program.inertializes) apply_inertia(program, state, locals);
}

std::string_view machine_state(const Program& program, std::span<const std::byte> state, int node) noexcept {
    if (node < 0 || static_cast<std::size_t>(node) >= program.nodes.size()) return {};
    const Node& at = program.nodes[static_cast<std::size_t>(node)];
    const auto* machine = std::get_if<MachineNode>(&at.data);
    if (machine == nullptr) return {};
    return machine->states[static_cast<std::size_t>(memory_at<MachineMemory>(state, at.memory).current)];
}

MachineStatus machine_status(const Program& program, std::span<const std::byte> state, int node) noexcept {
    if (node < 0 || static_cast<std::size_t>(node) >= program.nodes.size()) return {};
    const Node& at = program.nodes[static_cast<std::size_t>(node)];
    if (!std::holds_alternative<MachineNode>(at.data)) return {};
    const auto& memory = memory_at<MachineMemory>(state, at.memory);
    return {memory.current, memory.transition, memory.elapsed, memory.in_state};
}

float node_weight(const GraphScratch& scratch, int node) noexcept {
    const std::vector<NodeStep>& nodes = scratch.parts().nodes;
    if (node < 0 || static_cast<std::size_t>(node) >= nodes.size()) return 0;
    const NodeStep& step = nodes[static_cast<std::size_t>(node)];
    return step.plays ? step.weight : 0.0f;
}

}  // namespace surefoot
