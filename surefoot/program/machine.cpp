#include <surefoot/program/memory.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_far = 1e9f;  // [s]

bool compares(Comparison comparison, float a, float b) noexcept {
    switch (comparison) {
        case Comparison::less:
            return a < b;
        case Comparison::less_equal:
            return a <= b;
        case Comparison::greater:
            return a > b;
        case Comparison::greater_equal:
            return a >= b;
        case Comparison::equal:
            return a == b;
        case Comparison::not_equal:
            return a != b;
    }
    return false;
}

bool in_window(float phase, float from, float to) noexcept {
    return from <= to ? phase >= from && phase < to : phase >= from || phase < to;
}

class Machine {
  public:
    Machine(const Program& program, std::span<std::byte> state, int node) noexcept
        : program_(program),
          state_(state),
          node_(program.nodes[static_cast<std::size_t>(node)]),
          machine_(*std::get_if<MachineNode>(&node_.data)),
          memory_(memory_at<MachineMemory>(state, node_.memory)) {}

    /// Takes the transition that runs first, if one may. Returns it, or null.
    const Transition* decide() noexcept {
        const Transition* best = nullptr;
        for (const Transition& candidate : machine_.transitions)
            if (may_run(candidate) && (best == nullptr || candidate.priority > best->priority) && holds(candidate))
                best = &candidate;
        if (best != nullptr) take(*best);
        return best;
    }

    void advance(float dt) noexcept {
        memory_.in_state += dt;
        if (memory_.transition < 0) return;
        memory_.elapsed += dt;
        if (memory_.elapsed < running().seconds) return;
        memory_.transition = -1;
        memory_.fading_count = 0;
        memory_.target_from = 1;
    }

  private:
    const Transition& running() const noexcept {
        return machine_.transitions[static_cast<std::size_t>(memory_.transition)];
    }

    bool may_run(const Transition& t) const noexcept {
        if (t.to == memory_.current ? t.from != t.to : t.from >= 0 && t.from != memory_.current) return false;
        if (memory_.transition < 0) return true;
        const Interruption by = running().interrupted_by;
        if (by == Interruption::nobody || (by == Interruption::higher && !(t.priority > running().priority)))
            return false;
        // With every place taken it waits until what fades has gone: dropping one would be seen.
        return t.kind == TransitionKind::inertialize || memory_.fading_count < k_max_fading;
    }

    bool holds(const Transition& t) const noexcept {
        return std::all_of(t.conditions.begin(), t.conditions.end(),
                           [this](const Condition& condition) { return holds(condition); });
    }
    bool holds(const Condition& c) const noexcept {
        const std::span<const std::byte> state = state_;
        const auto subject = static_cast<std::size_t>(std::max<std::int16_t>(c.subject, 0));
        switch (c.kind) {
            case ConditionKind::compare:
                return compares(c.comparison, memory_at<ParameterMemory>(state, parameter_memory(subject)).value,
                                c.value);
            case ConditionKind::elapsed:
                return memory_.in_state >= c.value;
            case ConditionKind::remaining:
                return remaining_seconds(program_, state, child(memory_.current)) <= c.value;
            case ConditionKind::window:
                return in_window(memory_at<GroupMemory>(state, group_memory(program_, subject)).phase, c.value,
                                 c.value_to);
        }
        return false;
    }

    int child(int state) const noexcept { return node_.children[static_cast<std::size_t>(state)]; }

    void take(const Transition& t) noexcept {
        const StateWeights now = state_weights(machine_, memory_);
        memory_.fading_count = 0;
        memory_.target_from = t.kind == TransitionKind::inertialize ? 1.0f : 0.0f;
        bool plays = false;
        for (int i = 0; i < now.count; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (t.kind == TransitionKind::inertialize) continue;
            if (now.state[at] == t.to)
                memory_.target_from = now.weight[at], plays = true;
            else
                memory_.fading[static_cast<std::size_t>(memory_.fading_count++)] = {now.weight[at], now.state[at], 0};
        }
        memory_.current = t.to;
        memory_.transition = static_cast<std::int16_t>(&t - machine_.transitions.data());
        memory_.elapsed = memory_.in_state = 0;
        if (!plays) enter(t);
        spend_triggers(t);
    }

    void enter(const Transition& t) noexcept {
        if (t.entry == Entry::keep) return;
        const int root = child(t.to);
        reset_subtree(program_, state_, root);
        if (t.entry != Entry::phase) return;
        const auto& group = memory_at<GroupMemory>(
            state_, group_memory(program_, static_cast<std::size_t>(std::max<std::int16_t>(t.entry_group, 0))));
        for (int i = program_.nodes[static_cast<std::size_t>(root)].first; i <= root; ++i) {
            const Node& node = program_.nodes[static_cast<std::size_t>(i)];
            const ClipNode* clip = std::get_if<ClipNode>(&node.data);
            if (clip == nullptr || clip->group >= 0) continue;
            const PackedClip& packed = program_.body.clips[static_cast<std::size_t>(clip->clip)];
            if (packed.cycles == 0) continue;
            memory_at<ClipMemory>(state_, node.memory) = {time_at(packed, phase_in(packed, group.phase, group.cycle)),
                                                          0};
        }
    }

    void spend_triggers(const Transition& t) noexcept {
        for (const Condition& c : t.conditions) {
            if (c.kind != ConditionKind::compare) continue;
            const auto subject = static_cast<std::size_t>(c.subject);
            if (program_.parameters[subject].kind == ParameterKind::trigger)
                memory_at<ParameterMemory>(state_, parameter_memory(subject)) = {};
        }
    }

    const Program& program_;
    std::span<std::byte> state_;
    const Node& node_;
    const MachineNode& machine_;
    MachineMemory& memory_;
};

}  // namespace

float ease(Curve curve, float share) noexcept {
    const float t = std::clamp(share, 0.0f, 1.0f), u = 1 - t;
    switch (curve) {
        case Curve::linear:
            return t;
        case Curve::smoothstep:
            return t * t * (3 - 2 * t);
        case Curve::cubic_in:
            return t * t * t;
        case Curve::cubic_out:
            return 1 - u * u * u;
        case Curve::cubic_in_out:
            return t < 0.5f ? 4 * t * t * t : 1 - 4 * u * u * u;
    }
    return t;
}

StateWeights state_weights(const MachineNode& machine, const MachineMemory& memory) noexcept {
    StateWeights weights;
    float share = 1;
    if (memory.transition >= 0) {
        const Transition& t = machine.transitions[static_cast<std::size_t>(memory.transition)];
        share = t.seconds > 0 ? ease(t.curve, memory.elapsed / t.seconds) : 1.0f;
    }
    const auto add = [&](std::int16_t state, float weight) noexcept {
        if (weight < k_least_share) return;
        weights.state[static_cast<std::size_t>(weights.count)] = state;
        weights.weight[static_cast<std::size_t>(weights.count++)] = weight;
    };
    add(memory.current, memory.target_from + (1 - memory.target_from) * share);
    for (int i = 0; i < memory.fading_count; ++i) {
        const auto& fading = memory.fading[static_cast<std::size_t>(i)];
        add(fading.state, fading.from * (1 - share));
    }
    return weights;
}

float run_machine(const Program& program, std::span<std::byte> state, int node, float dt, bool decide) noexcept {
    Machine machine(program, state, node);
    const Transition* taken = decide ? machine.decide() : nullptr;
    machine.advance(dt);
    return taken != nullptr && taken->kind == TransitionKind::inertialize ? taken->seconds : -1.0f;
}

float remaining_seconds(const Program& program, std::span<const std::byte> state, int index) noexcept {
    const Node& node = program.nodes[static_cast<std::size_t>(index)];
    const auto below = [&](std::size_t child) noexcept {
        return remaining_seconds(program, state, node.children[child]);
    };
    if (const auto* clip = std::get_if<ClipNode>(&node.data)) {
        const PackedClip& packed = program.body.clips[static_cast<std::size_t>(clip->clip)];
        if (clip->group < 0) {
            const float rate = rate_of(state, clip->rate);
            const float left = packed.duration() - memory_at<ClipMemory>(state, node.memory).time;
            return rate > 0 ? left / rate : (left > 0 ? k_far : 0.0f);
        }
        const auto& group = memory_at<GroupMemory>(state, group_memory(program, static_cast<std::size_t>(clip->group)));
        return packed.duration() - time_at(packed, phase_in(packed, group.phase, group.cycle));
    }
    if (const auto* lerp = std::get_if<LerpNode>(&node.data)) return below(share_of(state, lerp->weight) > 0.5f);
    if (const auto* rate = std::get_if<RateNode>(&node.data)) {
        const float factor = rate_of(state, rate->factor);
        return factor > 0 ? below(0) / factor : k_far;
    }
    if (std::holds_alternative<MachineNode>(node.data))
        return below(static_cast<std::size_t>(memory_at<MachineMemory>(state, node.memory).current));
    float least = k_far;  // of a layer or an addition, too: a gesture ends though the walk under it does not
    for (std::size_t i = 0; i < node.children.size(); ++i) least = std::min(least, below(i));
    return least;
}

}  // namespace surefoot
