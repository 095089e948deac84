// Feet that stand while weights change (graph/foot_memory.h), whatever nodes these are of. A character has two feet, so
// it has one memory of them: of all sums that move its legs in the phase of one sync group, or without steps.

#include <surefoot/program/step.h>

namespace surefoot {
namespace {

/// Sums that move the legs, as if they were one.
struct Bearing {
    std::array<Leaf, k_max_leaves> leaf;
    std::size_t count = 0;
    Vec3 velocity;
    float turn = 0;
    float legs = 0;

    bool add(std::span<const Leaf> leaves, float share) noexcept {
        if (leaves.size() > leaf.size() - count) return false;
        for (const Leaf& each : leaves) leaf[count++] = {each.clip, each.time, each.weight * share};
        legs += share;
        return true;
    }
    void add_root(Vec3 v, float t, float share) noexcept {
        velocity += v * share;
        turn += t * share;
    }
    /// Refers to `leaf`.
    FootBlend blend(const GroupStep& group) noexcept {
        for (Leaf& each : std::span(leaf).first(count)) each.weight /= legs;
        FootBlend out;
        out.leaves = std::span(leaf).first(count);
        out.phase = group.phase;
        out.cycle = group.cycle;
        out.phase_before = group.phase_before;
        out.cycle_before = group.cycle_before;
        out.phase_rate = group.rate;
        out.velocity = velocity / legs;
        out.turn = turn / legs;
        return out;
    }
};

/// Of what is mirrored the feet are the other ones.
bool bears(const PoseTask& task, int group) noexcept {
    return task.kind == PoseTask::Kind::sample && task.steps && !task.turned && task.legs >= k_least_share &&
           (task.group < 0 || task.group == group);
}

}  // namespace

/// Who stood and begins to go does so with the foot that trails: a phase that nobody saw begins where that one lifts.
void GraphStep::step_off(int group) noexcept {
    if (!program_.holds_feet) return;
    const auto& memory = memory_at<FeetMemory>(state_, program_.feet_memory);
    if ((memory.group >= 0 && memory.group != group) || !stood(program_.body.clips, memory.feet)) return;
    auto& phase = memory_at<GroupMemory>(state_, group_memory(program_, static_cast<std::size_t>(group)));
    Bearing bearing;
    bool steps = false;
    for (int i = 0; i < static_cast<int>(program_.nodes.size()); ++i) {
        const NodeStep& step = at(i);
        if (!step.plays || step.turned || group_of(node(i).data) != group) continue;
        Active alone;
        const std::span<const Active> active = played_by(i, alone);
        std::array<Leaf, k_max_locomotion_leaves> leaf;
        const int count = make_leaves(program_.body.clips, active, 0, phase.phase, phase.cycle, leaf);
        if (!bearing.add(std::span(leaf).first(static_cast<std::size_t>(count)), step.weight)) return;
        for (const Active& each : active) {
            bearing.add_root(each.velocity, each.turn, each.weight * step.weight * step.rate);
            steps |= packed(each.clip).cycles > 0;
        }
    }
    if (!steps || !(bearing.legs > 0)) return;
    GroupStep shared;
    shared.phase = phase.phase;
    phase.phase = starting_phase(program_.body.legs, program_.body.clips, bearing.blend(shared), memory.feet);
}

/// From the last task, whose pose is the character's, to those that it is made of.
void GraphStep::share_legs() noexcept {
    const LegPaths& paths = program_.body.legs;
    const auto foot = static_cast<std::size_t>(paths.joint[static_cast<std::size_t>(paths.side[0].foot)]);
    on_stack(0).legs = 1;
    for (std::size_t i = frame_.task_count_; i-- > 0;) {
        PoseTask& task = frame_.task_[i];
        Partial& to = on_stack(task.to);
        float above = 0;
        switch (task.kind) {
            case PoseTask::Kind::sample:
                task.legs = to.legs;
                continue;
            case PoseTask::Kind::gait:
            case PoseTask::Kind::mirror:
                continue;
            case PoseTask::Kind::blend:
                above = task.weight;
                break;
            case PoseTask::Kind::layer: {
                const auto mask = static_cast<std::size_t>(task.mask);
                above = task.weight * (task.style_mask ? program_.body.styles[mask].mask : program_.masks[mask])[foot];
                break;
            }
            case PoseTask::Kind::add:
                break;
        }
        on_stack(task.to + 1).legs = to.legs * above;
        to.legs *= 1 - above;
    }
}

/// The group that carries the character: the one that did, as long as it does. -1: none does.
int GraphStep::bearing_group(int before) noexcept {
    int first = -1;
    for (const PoseTask& task : frame_.tasks()) {
        if (task.group < 0 || !bears(task, task.group)) continue;
        if (task.group == before) return before;
        if (first < 0) first = task.group;
    }
    return first;
}

void GraphStep::hold_feet(const RootFrame& moved, float dt) noexcept {
    if (!program_.holds_feet) return;
    auto& memory = memory_at<FeetMemory>(state_, program_.feet_memory);
    share_legs();
    const int group = bearing_group(memory.group);
    if (group >= 0 && group != memory.group) {
        if (memory.group >= 0) memory.feet = {};
        memory.group = group;
    }
    Bearing bearing;
    for (const PoseTask& task : frame_.tasks()) {
        if (!bears(task, group)) continue;
        const auto first = static_cast<std::size_t>(task.first_leaf), count = static_cast<std::size_t>(task.leaf_count);
        if (!bearing.add(frame_.leaves().subspan(first, count), task.legs)) {
            bearing.legs = 0;
            break;
        }
        bearing.add_root(task.velocity, task.turn, task.legs);
    }
    if (!(bearing.legs > 0)) {
        memory.feet = {};
        return;
    }
    const GroupStep shared = group >= 0 ? frame_.groups[static_cast<std::size_t>(group)] : GroupStep{};
    surefoot::hold_feet(program_.body.legs, program_.body.clips, bearing.blend(shared), moved, dt, memory.feet);
}

}  // namespace surefoot
