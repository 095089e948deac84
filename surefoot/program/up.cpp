// The pass from the leaves to the root: leaves and pose tasks, and what the root does.

#include <surefoot/program/step.h>

#include <algorithm>

namespace surefoot {

PoseTask& GraphStep::add_task(PoseTask::Kind kind, int to) noexcept {
    PoseTask& task = frame_.task_[frame_.task_count_++];
    task = {};
    task.kind = kind;
    task.to = static_cast<std::int16_t>(to);
    return task;
}

float GraphStep::phase_of(int group, bool turned, std::uint32_t& cycle) const noexcept {
    if (group < 0) return 0;
    const GroupStep& step = frame_.groups[static_cast<std::size_t>(group)];
    float phase = step.phase;
    cycle = step.cycle;
    if (turned) turn_phase(phase, cycle);
    return phase;
}

void GraphStep::push_sum(int i, int group, std::span<const Active> active, double clock, Vec3 velocity,
                         float turn) noexcept {
    Partial& partial = on_stack(depth_++) = {};
    partial.group = group;
    partial.turned = at(i).turned;
    partial.velocity = velocity;
    partial.turn = turn;
    partial.first = static_cast<int>(frame_.leaf_count_);
    std::uint32_t cycle = 0;
    const float phase = phase_of(group, partial.turned, cycle);
    partial.count = make_leaves(program_.body.clips, active, clock, phase, cycle,
                                std::span(frame_.leaf_).subspan(frame_.leaf_count_));
    frame_.leaf_count_ += static_cast<std::size_t>(partial.count);
}

void GraphStep::push_clip(int i, const ClipNode& clip) noexcept {
    const NodeStep& step = at(i);
    if (clip.group >= 0) {
        const Active active{clip.clip, 1, step.velocity, step.turn};
        push_sum(i, clip.group, {&active, 1}, 0, step.velocity, step.turn);
        return;
    }
    Partial& partial = on_stack(depth_++) = {};
    partial.group = clip.loop && packed(clip.clip).cycles == 0 ? Partial::k_neutral : Partial::k_own;
    partial.velocity = step.velocity;
    partial.turn = step.turn;
    partial.first = static_cast<int>(frame_.leaf_count_);
    partial.count = 1;
    frame_.leaf_[frame_.leaf_count_++] = {clip.clip, memory_at<ClipMemory>(state_, node(i).memory).time, 1};
}

void GraphStep::push_locomotion(int i, const LocomotionNode& locomotion) noexcept {
    const NodeStep& step = at(i);
    const auto& memory = memory_at<SpaceMemory>(state_, node(i).memory);
    push_sum(i, locomotion.group, mix_at(i).all(), memory.clock, step.velocity, step.turn);
    const LocomotionRequest request = request_of(locomotion);
    const LocomotionStyle* style = style_of(program_.body, request);
    if (style == nullptr) return;
    const int base = depth_ - 1;
    if (style->mask.empty()) {
        on_stack(base).styled = true;
        return;
    }
    evaluate(base);
    const Mix layer = style_layer(*style, mix_at(i).velocity, mix_at(i).turn);
    push_sum(i, locomotion.group, layer.all(), memory.clock, {}, 0);
    on_stack(depth_ - 1).group = Partial::k_own;  // no feet: it moves no legs
    evaluate(depth_ - 1);
    --depth_;
    PoseTask& task = add_task(PoseTask::Kind::layer, base);
    task.style_mask = true;
    task.mask = locomotion.style;
    task.weight = request.style_weight;
}

void GraphStep::evaluate(int position) noexcept {
    Partial& partial = on_stack(position);
    if (!partial.sum) return;
    partial.sum = false;
    PoseTask& task = add_task(PoseTask::Kind::sample, position);
    task.first_leaf = partial.first;
    task.leaf_count = partial.count;
    task.velocity = partial.velocity;
    task.turn = partial.turn;
    task.turned = partial.turned;
    task.group = static_cast<std::int16_t>(partial.group);
    task.steps = partial.group != Partial::k_own;
    task.blends = task.steps && (partial.count > 1 || partial.styled);  // a lone clip plays as recorded
}

bool GraphStep::mergeable(int first, int count, int& group) noexcept {
    int leaves = 0;
    group = Partial::k_neutral;
    for (int k = first; k < first + count; ++k) {
        const Partial& partial = on_stack(k);
        if (!partial.sum || partial.group == Partial::k_own) return false;
        if (partial.group >= 0 && group >= 0 && partial.group != group) return false;
        group = std::max(group, partial.group);
        leaves += partial.count;
    }
    return leaves <= k_max_leaves;
}

void GraphStep::merge(int count, const float* weights) noexcept {
    if (count < 2) return;
    const int first = depth_ - count;
    float total = 0;
    for (int k = 0; k < count; ++k) total += weights[k];
    Partial merged = on_stack(first);
    merged.velocity = {};
    merged.turn = merged.feet = 0;
    for (int k = 0; k < count; ++k) {
        const Partial& partial = on_stack(first + k);
        merged.velocity += partial.velocity * (weights[k] / total);
        merged.turn += partial.turn * (weights[k] / total);
        merged.feet += partial.feet * (weights[k] / total);
        merged.styled |= partial.styled;
    }
    int group = 0;
    if (mergeable(first, count, group)) {
        merged.group = group;
        merged.count = 0;
        for (int k = 0; k < count; ++k) {
            const Partial& partial = on_stack(first + k);
            merged.count += partial.count;
            merged.turned |= partial.turned;
            for (int l = partial.first; l < partial.first + partial.count; ++l)
                frame_.leaf_[static_cast<std::size_t>(l)].weight *= weights[k] / total;
        }
    } else {
        for (int k = 0; k < count; ++k) evaluate(first + k);
        merged.sum = false;
        for (int k = count - 2; k >= 0; --k) {  // from the top down, each onto the one below it
            float above = 0;
            for (int l = k + 1; l < count; ++l) above += weights[l];
            PoseTask& task = add_task(PoseTask::Kind::blend, first + k);
            task.weight = above / (above + weights[k]);
        }
    }
    on_stack(first) = merged;
    depth_ = first + 1;
}

int GraphStep::children_played(int i, float* weights) noexcept {
    int count = 0;
    for (const int child : node(i).children)
        if (at(child).plays) weights[count++] = at(child).weight;
    return count;
}

void GraphStep::emit(int i) noexcept {
    const NodeStep& step = at(i);
    const NodeData& data = node(i).data;
    const auto top = [&]() -> Partial& { return on_stack(depth_ - 1); };
    /// The second child onto the first, if it plays.
    const auto put_over = [&](PoseTask::Kind kind, float weight) -> PoseTask* {
        if (!at(node(i).children[1]).plays) return nullptr;
        evaluate(depth_ - 2);
        evaluate(depth_ - 1);
        --depth_;
        PoseTask& task = add_task(kind, depth_ - 1);
        task.weight = weight;
        return &task;
    };
    if (const auto* clip = std::get_if<ClipNode>(&data)) {
        push_clip(i, *clip);
    } else if (const auto* space = std::get_if<SpaceNode>(&data)) {
        push_sum(i, space->group, mix_at(i).all(), memory_at<SpaceMemory>(state_, node(i).memory).clock, step.velocity,
                 step.turn);
    } else if (const auto* locomotion = std::get_if<LocomotionNode>(&data)) {
        push_locomotion(i, *locomotion);
    } else if (std::holds_alternative<GaitNode>(data)) {
        Partial& partial = on_stack(depth_++) = {};
        partial.sum = false;
        partial.velocity = step.velocity;
        partial.turn = step.turn;
        add_task(PoseTask::Kind::gait, depth_ - 1).node = static_cast<std::int16_t>(i);
    } else if (std::holds_alternative<LerpNode>(data) || std::holds_alternative<MachineNode>(data)) {
        std::array<float, k_max_fading + 1> weights{};
        merge(children_played(i, weights.data()), weights.data());
    } else if (const auto* layer = std::get_if<LayerNode>(&data)) {
        if (PoseTask* task = put_over(PoseTask::Kind::layer, share_of(state_, layer->weight))) task->mask = layer->mask;
    } else if (const auto* additive = std::get_if<AdditiveNode>(&data)) {
        if (PoseTask* task = put_over(PoseTask::Kind::add, share_of(state_, additive->weight))) {
            task->mask = additive->mask;
            task->reference = additive->reference;
        }
    } else if (std::holds_alternative<MirrorNode>(data)) {
        if (at(node(i).children[0]).turned == step.turned) return;
        evaluate(depth_ - 1);
        add_task(PoseTask::Kind::mirror, depth_ - 1);
        top().velocity = reflected(top().velocity);
        top().turn = -top().turn;
        top().turned = step.turned;
    } else if (const auto* feet = std::get_if<FeetNode>(&data)) {
        top().feet *= share_of(state_, feet->weight);
    }
}

void GraphStep::pass_up() noexcept {
    frame_.task_count_ = frame_.leaf_count_ = 0;
    depth_ = 0;
    for (int i = 0; i < static_cast<int>(program_.nodes.size()); ++i)
        if (at(i).plays) emit(i);
    evaluate(0);
    const Partial& whole = on_stack(0);
    frame_.velocity = whole.velocity;
    frame_.turn = whole.turn;
    frame_.feet = whole.feet;
}

}  // namespace surefoot
