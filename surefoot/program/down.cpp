// The pass from the root to the leaves: who plays, and how much of what.

#include <surefoot/program/step.h>

#include <algorithm>

namespace surefoot {

void GraphStep::advance_parameters(float dt) noexcept {
    for (std::size_t i = 0; i < program_.parameters.size(); ++i) {
        const Parameter& parameter = program_.parameters[i];
        auto& memory = memory_at<ParameterMemory>(state_, parameter_memory(i));
        const float way = memory.asked - memory.value, most = parameter.rate * dt;
        if (parameter.rate == 0 || (way <= most && way >= -most))
            memory.value = memory.asked;
        else
            memory.value += way > 0 ? most : -most;
        if (parameter.kind != ParameterKind::trigger || !(memory.asked > 0)) continue;
        if (parameter.lasts > 0 && memory.age >= parameter.lasts) memory = {};
        memory.age += dt;
    }
}

void GraphStep::pass_to(int child, const NodeStep& parent, float share) noexcept {
    NodeStep& to = at(child);
    to.plays = share >= k_least_share;
    to.weight = parent.weight * share;
    to.rate = parent.rate;
    to.turned = parent.turned;
}

LocomotionRequest GraphStep::request_of(const LocomotionNode& locomotion) const noexcept {
    LocomotionRequest request;
    request.speed = value(locomotion.speed);
    request.turn = value(locomotion.turn);
    request.lateral = value(locomotion.lateral);
    request.slope = value(locomotion.slope);
    for (std::size_t i = 0; i < request.custom.size(); ++i) request.custom[i] = value(locomotion.custom[i]);
    request.style = locomotion.style;
    request.style_weight = share_of(state_, locomotion.style_weight);
    return request;
}

void GraphStep::mix_locomotion(int i, const LocomotionNode& locomotion) noexcept {
    auto& memory = memory_at<SpaceMemory>(state_, node(i).memory);
    Mix& mix = mix_at(i) = {};
    const LocomotionRequest request = request_of(locomotion);
    add_locomotion(mix, program_.body, memory.facing_hint, memory.lateral_hint, request);
    const LocomotionStyle* style = style_of(program_.body, request);
    if (style != nullptr && style->mask.empty()) mix_in_style(mix, *style, request.style_weight);
}

void GraphStep::mix_space(int i, const SpaceNode& space) noexcept {
    auto& memory = memory_at<SpaceMemory>(state_, node(i).memory);
    Mix& mix = mix_at(i) = {};
    SpacePoint point{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(space.space.space.dimensions()); ++d)
        point[d] = value(space.at[d]);
    add_space(mix, space.space, memory.facing_hint, point, 0, 1);
    if (space.space.has_turn) return;  // else what its clips turn by
    mix.turn = 0;
    for (const Active& active : mix.all()) mix.turn += active.weight * active.turn;
}

float GraphStep::pass_down(float dt, bool decide) noexcept {
    const int root = static_cast<int>(program_.nodes.size()) - 1;
    for (NodeStep& step : parts_.nodes) step.plays = false;
    at(root) = {true, false, 1, 1, {}, 0};
    float inertialize = -1;
    frame_.visited = 0;
    for (int i = root; i >= 0; --i) {
        const NodeStep& step = at(i);
        if (!step.plays) {
            i = node(i).first;  // the whole subtree is culled
            continue;
        }
        ++frame_.visited;
        const auto child = [&](std::size_t k) noexcept { return static_cast<int>(node(i).children[k]); };
        const NodeData& data = node(i).data;
        if (const auto* lerp = std::get_if<LerpNode>(&data)) {
            const float weight = share_of(state_, lerp->weight);
            pass_to(child(0), step, 1 - weight);
            pass_to(child(1), step, weight);
        } else if (const auto* layer = std::get_if<LayerNode>(&data)) {
            pass_to(child(0), step, 1);
            pass_to(child(1), step, share_of(state_, layer->weight));
        } else if (const auto* additive = std::get_if<AdditiveNode>(&data)) {
            pass_to(child(0), step, 1);
            pass_to(child(1), step, share_of(state_, additive->weight));
        } else if (const auto* mirror = std::get_if<MirrorNode>(&data)) {
            pass_to(child(0), step, 1);
            if (value(mirror->when) > 0.5f) at(child(0)).turned = !step.turned;
        } else if (const auto* rate = std::get_if<RateNode>(&data)) {
            pass_to(child(0), step, 1);
            at(child(0)).rate *= rate_of(state_, rate->factor);
        } else if (std::holds_alternative<FeetNode>(data)) {
            pass_to(child(0), step, 1);
        } else if (const auto* machine = std::get_if<MachineNode>(&data)) {
            inertialize = std::max(inertialize, run_machine(program_, state_, i, dt * step.rate, decide));
            const StateWeights weights = state_weights(*machine, memory_at<MachineMemory>(state_, node(i).memory));
            for (int k = 0; k < weights.count; ++k)
                pass_to(child(static_cast<std::size_t>(weights.state[static_cast<std::size_t>(k)])), step,
                        weights.weight[static_cast<std::size_t>(k)]);
        } else if (const auto* space = std::get_if<SpaceNode>(&data)) {
            mix_space(i, *space);
        } else if (const auto* locomotion = std::get_if<LocomotionNode>(&data)) {
            mix_locomotion(i, *locomotion);
        }
    }
    return inertialize;
}

}  // namespace surefoot
