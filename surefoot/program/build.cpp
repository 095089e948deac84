// Building and checking a program: the only part of the room that allocates, scratch apart.

#include <surefoot/program/memory.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

template <class Named>
int index_of(const std::vector<Named>& list, std::string_view name) noexcept {
    for (std::size_t i = 0; i < list.size(); ++i) {
        if constexpr (std::is_same_v<Named, std::string>) {
            if (list[i] == name) return static_cast<int>(i);
        } else if (list[i].name == name) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

std::size_t memory_size(const NodeData& data) noexcept {
    struct {
        std::size_t operator()(const ClipNode& clip) const noexcept { return clip.group < 0 ? sizeof(ClipMemory) : 0; }
        std::size_t operator()(const SpaceNode&) const noexcept { return sizeof(SpaceMemory); }
        std::size_t operator()(const LocomotionNode&) const noexcept { return sizeof(SpaceMemory); }
        std::size_t operator()(const GaitNode&) const noexcept { return sizeof(LiveState); }
        std::size_t operator()(const MachineNode&) const noexcept { return sizeof(MachineMemory); }
        std::size_t operator()(const LerpNode&) const noexcept { return 0; }
        std::size_t operator()(const AdditiveNode&) const noexcept { return 0; }
        std::size_t operator()(const LayerNode&) const noexcept { return 0; }
        std::size_t operator()(const MirrorNode&) const noexcept { return 0; }
        std::size_t operator()(const RateNode&) const noexcept { return 0; }
        std::size_t operator()(const FeetNode&) const noexcept { return 0; }
    } size;
    return std::visit(size, data);
}

/// Poses that evaluating a subtree needs at once, one after the other of its children lying on the stack.
int registers_of(const Program& program, int index) {
    const Node& node = program.nodes[static_cast<std::size_t>(index)];
    int most = std::holds_alternative<LocomotionNode>(node.data) ? 2 : 1;  // a masked style lies beside its base
    const int together =
        std::holds_alternative<MachineNode>(node.data) ? k_max_fading : static_cast<int>(node.children.size());
    for (std::size_t i = 0; i < node.children.size(); ++i)
        most = std::max(most, std::min(static_cast<int>(i), together) + registers_of(program, node.children[i]));
    return most;
}

void mark(Program& program, int root, bool follows, int group = -1) {
    for (int i = program.nodes[static_cast<std::size_t>(root)].first; i <= root; ++i) {
        Node& node = program.nodes[static_cast<std::size_t>(i)];
        if (group < 0 || group_of(node.data) == group) node.follows = follows;
    }
}

/// Where a leader is named it alone leads, layered or not.
void mark_leaders(Program& program) {
    for (std::size_t g = 0; g < program.groups.size(); ++g) {
        const std::string& leader = program.groups[g].leader;
        const int group = static_cast<int>(g), root = static_cast<int>(program.nodes.size()) - 1;
        if (leader.empty()) continue;
        mark(program, root, true, group);
        for (int i = 0; i <= root; ++i)
            if (program.nodes[static_cast<std::size_t>(i)].path == leader) mark(program, i, false, group);
    }
}

std::vector<std::int16_t> drifting_joints(const Program& program) {
    std::vector<bool> drifts(program.body.skeleton->rest.size(), false);
    for (const PackedClip& clip : program.body.clips)
        for (const std::int16_t joint : clip.moving) drifts[static_cast<std::size_t>(joint)] = true;
    for (const auto& rig : program.rigs)
        if (rig && problem(*rig).empty() && rig->soles.hips < static_cast<int>(drifts.size()))
            drifts[static_cast<std::size_t>(rig->soles.hips)] = true;
    std::vector<std::int16_t> joints;
    for (std::size_t j = 0; j < drifts.size(); ++j)
        if (drifts[j]) joints.push_back(static_cast<std::int16_t>(j));
    return joints;
}

// --- checking

class Check {
  public:
    explicit Check(const Program& program) : program_(program) {}

    std::string whole() {
        if (!program_.body.skeleton) return "the graph has no skeleton";
        if (std::string text = problem_of_body(); !text.empty()) return text;
        if (program_.parameters.size() > k_max_parameters) return "there are more parameters than 256";
        for (const Parameter& p : program_.parameters)
            if (!(p.low <= p.high) || !(p.initial >= p.low && p.initial <= p.high) || !(p.rate >= 0) || !(p.lasts >= 0))
                return "parameter '" + p.name + "' does not begin between low and high, or has a rate below 0";
        if (program_.groups.size() > k_max_sync_groups) return "there are more sync groups than 16";
        if (program_.nodes.empty()) return "the graph has no nodes";
        if (program_.nodes.size() > k_max_nodes)
            return "the graph has more nodes than 1024, counting a named node once for each of its uses";
        for (const std::vector<float>& mask : program_.masks) {
            if (mask.size() != joints()) return "a mask does not match the joints";
            for (const float share : mask)
                if (!(share >= 0 && share <= 1)) return "a mask has values outside 0 to 1";
        }
        for (const auto& reference : program_.references)
            if (reference.size() != joints()) return "a reference pose does not match the joints";
        for (const SyncGroup& group : program_.groups)
            if (!marks(group.events, 1)) return "the events of sync group '" + group.name + "' are out of order";
        return nodes();
    }

  private:
    std::size_t joints() const { return program_.body.skeleton->rest.size(); }
    bool parameter(int index) const { return index >= -1 && index < static_cast<int>(program_.parameters.size()); }
    bool operand(const Operand& o) const {
        return parameter(o.parameter) && std::isfinite(o.offset) && std::isfinite(o.scale);
    }
    bool group(int index) const { return index >= 0 && index < static_cast<int>(program_.groups.size()); }
    bool clip(int index) const { return index >= 0 && index < static_cast<int>(program_.body.clips.size()); }
    bool mask(int index) const { return index >= 0 && index < static_cast<int>(program_.masks.size()); }
    bool marks(const std::vector<EventMark>& events, float end) const {
        float before = 0;
        for (const EventMark& mark : events) {
            if (mark.event < 0 || mark.event >= static_cast<int>(program_.events.size())) return false;
            if (!(mark.at >= before && mark.at <= end)) return false;
            before = mark.at;
        }
        return true;
    }

    std::string problem_of_body() const {
        const LocomotionGraph& body = program_.body;
        if (!body.facing.empty() || !body.lateral.empty()) {
            if (std::string text = problem(body); !text.empty()) return text;
        } else {
            if (std::string text = problem(*body.skeleton); !text.empty()) return text;
            if (std::string text = problem(body.legs, *body.skeleton); !text.empty()) return text;
            for (const PackedClip& packed : body.clips) {
                if (std::string text = problem(packed); !text.empty()) return text;
                if (packed.joint_count != body.skeleton->joint_count())
                    return "clip '" + packed.name + "' has another number of joints than the skeleton";
            }
        }
        for (const auto& rig : program_.rigs) {
            if (!rig) return "a gait is missing";
            if (std::string text = problem(*rig); !text.empty()) return text;
            if (rig->skeleton->joint_count() != body.skeleton->joint_count())
                return "a live gait is of another skeleton";
        }
        return {};
    }

    /// A leader has members of its group below it.
    std::string leaders() const {
        for (std::size_t g = 0; g < program_.groups.size(); ++g) {
            bool leads = program_.groups[g].leader.empty();
            for (const Node& root : program_.nodes) {
                if (leads || root.path != program_.groups[g].leader) continue;
                const auto* last = &root;
                for (const auto* node = &program_.nodes[static_cast<std::size_t>(root.first)]; node <= last; ++node)
                    leads |= group_of(node->data) == static_cast<int>(g);
            }
            if (!leads)
                return program_.groups[g].leader + ": it shall lead sync group '" + program_.groups[g].name +
                       "', and plays nothing of it";
        }
        return {};
    }

    std::string nodes() {
        std::vector<int> parents(program_.nodes.size(), -1);
        for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
            const Node& node = program_.nodes[i];
            int end = static_cast<int>(i);  // children fill [first, i) from its end to its beginning
            for (std::size_t c = node.children.size(); c-- > 0;) {
                if (node.children[c] != end - 1 || end - 1 < 0)
                    return node.path + ": its children do not lie before it";
                end = program_.nodes[static_cast<std::size_t>(end - 1)].first;
            }
            if (end != node.first) return node.path + ": its children do not lie before it";
            const std::string text = std::visit([&](const auto& data) { return of(data, node); }, node.data);
            if (!text.empty()) return node.path + ": " + text;
        }
        if (program_.nodes.back().first != 0) return program_.nodes.back().path + ": nodes are left that nothing plays";
        if (depth(static_cast<int>(program_.nodes.size()) - 1) > k_max_depth)
            return program_.nodes.back().path + ": nodes lie more than 32 deep";
        return leaders();
    }

    int depth(int index) const {
        int below = 0;
        for (const int child : program_.nodes[static_cast<std::size_t>(index)].children)
            below = std::max(below, depth(child));
        return below + 1;
    }

    static std::string children(const Node& node, std::size_t count) {
        return node.children.size() == count ? std::string() : "it needs " + std::to_string(count) + " nodes below it";
    }

    std::string of(const ClipNode& n, const Node& node) const {
        if (!clip(n.clip)) return "it names a clip that is not there";
        if (!operand(n.rate)) return "its rate is no number or parameter";
        const PackedClip& packed = program_.body.clips[static_cast<std::size_t>(n.clip)];
        if (n.group != -1 && !group(n.group)) return "it names a sync group that is not there";
        if (n.group >= 0 && packed.cycles == 0)
            return "clip '" + packed.name + "' has no steps, and so no place in a sync group";
        if (!marks(n.events, packed.duration())) return "its events are out of order, or beyond the clip's end";
        if (n.target < -1 || n.target >= static_cast<int>(program_.targets.size()))
            return "it names a target that is not there";
        if (n.target >= 0 && (n.group >= 0 || n.loop || !(n.align_from >= 0 && n.align_from < n.align_until) ||
                              !(n.align_until <= packed.duration())))
            return "only a clip that plays once, in no sync group, can be aligned, from a time to a later one within "
                   "it";
        return children(node, 0);
    }
    std::string of(const SpaceNode& n, const Node& node) const {
        if (n.space.empty()) return "the space has no samples";
        if (std::string text = problem(n.space.space); !text.empty()) return "the space is unsound: " + text;
        if (n.space.clips.size() != n.space.space.samples.size() || n.space.velocities.size() != n.space.clips.size() ||
            n.space.turns.size() != n.space.clips.size())
            return "the space has samples without clips";
        for (const std::int32_t index : n.space.clips)
            if (!clip(index)) return "it names a clip that is not there";
        if (!std::all_of(n.at.begin(), n.at.end(), [this](const Operand& o) { return operand(o); }))
            return "an axis reads no number or parameter";
        if (!group(n.group)) return "it has no sync group";
        return children(node, 0);
    }
    std::string of(const LocomotionNode& n, const Node& node) const {
        if (program_.body.facing.empty() && program_.body.lateral.empty())
            return "there is no project whose spaces it could play";
        for (const Operand& o : {n.speed, n.turn, n.lateral, n.slope, n.style_weight})
            if (!operand(o)) return "it reads no number or parameter";
        if (!std::all_of(n.custom.begin(), n.custom.end(), [this](const Operand& o) { return operand(o); }))
            return "an axis reads no number or parameter";
        if (n.style < -1 || n.style >= static_cast<int>(program_.body.styles.size()))
            return "it names a style that is not there";
        if (!group(n.group)) return "it has no sync group";
        return children(node, 0);
    }
    std::string of(const GaitNode& n, const Node& node) const {
        if (n.rig < 0 || n.rig >= static_cast<int>(program_.rigs.size())) return "it names a gait that is not there";
        if (!operand(n.speed) || !operand(n.turn) || !operand(n.manner)) return "it reads no number or parameter";
        if (!(n.glide >= 0)) return "its glide is below 0";
        return children(node, 0);
    }
    std::string of(const LerpNode& n, const Node& node) const {
        return operand(n.weight) ? children(node, 2) : "its weight is no number or parameter";
    }
    std::string of(const AdditiveNode& n, const Node& node) const {
        if (n.mask != -1 && !mask(n.mask)) return "it names a mask that is not there";
        if (n.reference < 0 || n.reference >= static_cast<int>(program_.references.size()))
            return "it names a reference pose that is not there";
        return operand(n.weight) ? children(node, 2) : "its weight is no number or parameter";
    }
    std::string of(const LayerNode& n, const Node& node) const {
        if (!mask(n.mask)) return "it names a mask that is not there";
        return operand(n.weight) ? children(node, 2) : "its weight is no number or parameter";
    }
    std::string of(const MirrorNode& n, const Node& node) const {
        if (program_.mirror.empty()) return "which joint mirrors which is not known";
        if (std::string text = problem(program_.mirror, *program_.body.skeleton); !text.empty()) return text;
        return operand(n.when) ? children(node, 1) : "it reads no number or parameter";
    }
    std::string of(const RateNode& n, const Node& node) const {
        return operand(n.factor) ? children(node, 1) : "its factor is no number or parameter";
    }
    std::string of(const FeetNode& n, const Node& node) const {
        return operand(n.weight) ? children(node, 1) : "its weight is no number or parameter";
    }
    std::string of(const MachineNode& n, const Node& node) const {
        if (n.states.empty() || n.states.size() > k_max_states) return "it has no states, or more than 256";
        const int count = static_cast<int>(n.states.size());
        if (n.initial < 0 || n.initial >= count) return "its first state is not there";
        for (const Transition& t : n.transitions)
            if (const std::string text = of(t, count); !text.empty()) return "transition '" + t.name + "': " + text;
        return children(node, n.states.size());
    }
    std::string of(const Transition& t, int states) const {
        if (t.from < -1 || t.from >= states || t.to < 0 || t.to >= states) return "it names a state that is not there";
        if (t.from == t.to && t.kind == TransitionKind::feather)
            return "a state cannot fade into itself; let it inertialize";
        if (!(t.seconds >= 0 && t.seconds <= 60)) return "it takes 0 to 60 seconds";
        if (!std::isfinite(t.priority)) return "its priority is no number";
        if (t.entry == Entry::phase && !group(t.entry_group))
            return "it enters in phase with a group that is not there";
        for (const Condition& c : t.conditions) {
            if (!std::isfinite(c.value) || !std::isfinite(c.value_to)) return "a condition's value is no number";
            if (c.kind == ConditionKind::compare && (c.subject < 0 || !parameter(c.subject)))
                return "a condition reads a parameter that is not there";
            if (c.kind == ConditionKind::window && !group(c.subject))
                return "a condition reads a sync group that is not there";
        }
        return {};
    }

    const Program& program_;
};

}  // namespace

int Program::parameter(std::string_view wanted) const noexcept { return index_of(parameters, wanted); }
int Program::event(std::string_view wanted) const noexcept { return index_of(events, wanted); }
int Program::target(std::string_view wanted) const noexcept { return index_of(targets, wanted); }
int Program::group(std::string_view wanted) const noexcept { return index_of(groups, wanted); }

int add_node(Program& program, std::string path, NodeData data, const std::vector<int>& children) {
    Node node;
    node.path = std::move(path);
    node.data = std::move(data);
    const auto index = static_cast<std::int16_t>(program.nodes.size());
    for (const int child : children) node.children.push_back(static_cast<std::int16_t>(child));
    node.first = children.empty() ? index : program.nodes[static_cast<std::size_t>(children.front())].first;
    program.nodes.push_back(std::move(node));
    return index;
}

void lay_out(Program& program) {
    std::size_t size = aligned_to_8(group_memory(program, program.groups.size()));
    program.inertializes = false;
    for (Node& node : program.nodes) {
        node.memory = static_cast<std::uint32_t>(size);
        size += aligned_to_8(memory_size(node.data));
        if (std::holds_alternative<AdditiveNode>(node.data) || std::holds_alternative<LayerNode>(node.data))
            mark(program, node.children.back(), true);
        if (const auto* machine = std::get_if<MachineNode>(&node.data))
            for (const Transition& t : machine->transitions)
                program.inertializes |= t.kind == TransitionKind::inertialize;
    }
    mark_leaders(program);
    program.drifting = drifting_joints(program);
    program.holds_feet = program.body.legs.count > 0 && !program.groups.empty();
    if (program.holds_feet) {
        program.feet_memory = static_cast<std::uint32_t>(size);
        size += sizeof(FeetMemory);
    }
    if (program.inertializes) {
        program.inertia_memory = static_cast<std::uint32_t>(size);
        size += sizeof(InertiaMemory) + program.drifting.size() * 6 * sizeof(float) +
                program.body.skeleton->rest.size() * 6 * sizeof(std::int16_t);
    }
    program.state_size = static_cast<std::uint32_t>(aligned_to_8(size));
    program.registers = program.nodes.empty() ? 0 : registers_of(program, static_cast<int>(program.nodes.size()) - 1);
}

std::string definition_problem(const Program& program) { return Check(program).whole(); }

std::string problem(const Program& program) {
    if (std::string text = definition_problem(program); !text.empty()) return text;
    return program.state_size == 0 || program.registers == 0 ? "the graph has not been laid out" : std::string();
}

int find_node(const Program& program, std::string_view path) noexcept {
    for (std::size_t i = 0; i < program.nodes.size(); ++i)
        if (program.nodes[i].path == path) return static_cast<int>(i);
    return -1;
}

}  // namespace surefoot
