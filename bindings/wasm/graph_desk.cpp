#include "graph_desk.h"

#include <surefoot/author/json_node.h>
#include <surefoot/base/error.h>
#include <surefoot/graph_text/graph_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace surefoot::wasm {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t k_most_happened = 256;  // that are kept for who does not ask
constexpr const char* k_types[] = {"clip",  "space",  "locomotion", "gait", "lerp",   "additive",
                                   "layer", "mirror", "rate",       "feet", "machine"};
constexpr const char* k_kinds[] = {"number", "flag", "trigger"};
constexpr const char* k_curves[] = {"linear", "smoothstep", "cubic_in", "cubic_out", "cubic_in_out"};
constexpr const char* k_comparisons[] = {"<", "<=", ">", ">=", "=", "≠"};
static_assert(std::size(k_types) == std::variant_size_v<NodeData>);

template <class Names, class Value>
std::string named(const Names& names, Value value) {
    return names[static_cast<std::size_t>(value)];
}

std::string number(float value) { return short_number(value).dump(); }

std::string condition_text(const Program& program, const Condition& condition) {
    const auto subject = static_cast<std::size_t>(std::max<std::int16_t>(condition.subject, 0));
    switch (condition.kind) {
        case ConditionKind::compare:
            if (program.parameters[subject].kind == ParameterKind::trigger)
                return program.parameters[subject].name + " is pulled";
            return program.parameters[subject].name + " " + named(k_comparisons, condition.comparison) + " " +
                   number(condition.value);
        case ConditionKind::elapsed:
            return "after " + number(condition.value) + " s";
        case ConditionKind::remaining:
            return number(condition.value) + " s before its end";
        case ConditionKind::window:
            return "phase of " + program.groups[subject].name + " from " + number(condition.value) + " to " +
                   number(condition.value_to);
    }
    return {};
}

Json transition_json(const Program& program, const Node& node, const Transition& transition) {
    std::string when;
    for (const Condition& condition : transition.conditions)
        when += (when.empty() ? "" : ", ") + condition_text(program, condition);
    return {{"name", transition.name},
            {"pointer", node.path + "/transitions/" + transition.name},
            {"from", transition.from},
            {"to", transition.to},
            {"seconds", short_number(transition.seconds)},
            {"curve", named(k_curves, transition.curve)},
            {"kind", transition.kind == TransitionKind::feather ? "feather" : "inertialize"},
            {"when", std::move(when)}};
}

/// What of it matters most, in a word.
std::string detail_of(const Program& program, const NodeData& data) {
    const auto operand = [&](const char* what, const Operand& value) {
        const std::string text = value.parameter < 0
                                     ? number(value.offset)
                                     : program.parameters[static_cast<std::size_t>(value.parameter)].name;
        return what[0] == 0 ? text : std::string(what) + " " + text;
    };
    if (const auto* clip = std::get_if<ClipNode>(&data))
        return program.body.clips[static_cast<std::size_t>(clip->clip)].name;
    if (const auto* space = std::get_if<SpaceNode>(&data)) return std::to_string(space->space.clips.size()) + " clips";
    if (const auto* locomotion = std::get_if<LocomotionNode>(&data))
        return operand("", locomotion->speed) + ", " + operand("", locomotion->turn);
    if (const auto* gait = std::get_if<GaitNode>(&data)) return operand("", gait->speed);
    if (const auto* lerp = std::get_if<LerpNode>(&data)) return operand("weight", lerp->weight);
    if (const auto* additive = std::get_if<AdditiveNode>(&data)) return operand("weight", additive->weight);
    if (const auto* layer = std::get_if<LayerNode>(&data)) return operand("weight", layer->weight);
    if (const auto* mirror = std::get_if<MirrorNode>(&data)) return operand("when", mirror->when);
    if (const auto* rate = std::get_if<RateNode>(&data)) return operand("×", rate->factor);
    if (const auto* feet = std::get_if<FeetNode>(&data)) return operand("weight", feet->weight);
    return {};
}

Json parameter_json(const Parameter& parameter) {
    return {{"name", parameter.name},
            {"unit", parameter.unit},
            {"kind", named(k_kinds, parameter.kind)},
            {"initial", short_number(parameter.initial)},
            {"low", short_number(parameter.low)},
            {"high", short_number(parameter.high)},
            {"rate", short_number(parameter.rate)}};
}

Json machine_json(const Program& program, int index) {
    const Node& node = program.nodes[static_cast<std::size_t>(index)];
    const auto& machine = std::get<MachineNode>(node.data);
    Json out = {{"node", index}, {"path", node.path}, {"states", Json::array()}, {"transitions", Json::array()}};
    for (std::size_t s = 0; s < machine.states.size(); ++s)
        out["states"].push_back({{"name", machine.states[s]}, {"node", node.children[s]}});
    for (const Transition& transition : machine.transitions)
        out["transitions"].push_back(transition_json(program, node, transition));
    return out;
}

/// How each curve goes from 0 to 1.
Json curves_json() {
    constexpr int k_parts = 24;
    Json out = Json::array();
    for (std::size_t c = 0; c < std::size(k_curves); ++c) {
        Json values = Json::array();
        for (int i = 0; i <= k_parts; ++i)
            values.push_back(ease(static_cast<Curve>(c), static_cast<float>(i) / static_cast<float>(k_parts)));
        out.push_back({{"name", k_curves[c]}, {"values", std::move(values)}});
    }
    return out;
}

/// A character that plays `a` can go on with `b`: its state means the same there.
bool same_shape(const Program& a, const Program& b) {
    if (a.state_size != b.state_size || a.nodes.size() != b.nodes.size() || a.registers != b.registers ||
        a.inertializes != b.inertializes || a.inertia_memory != b.inertia_memory || a.drifting != b.drifting ||
        a.parameters.size() != b.parameters.size() || a.groups.size() != b.groups.size() ||
        a.rigs.size() != b.rigs.size() || a.body.clips.size() != b.body.clips.size() || a.events != b.events)
        return false;
    for (std::size_t i = 0; i < a.parameters.size(); ++i)
        if (a.parameters[i].name != b.parameters[i].name || a.parameters[i].kind != b.parameters[i].kind) return false;
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        const Node &one = a.nodes[i], &other = b.nodes[i];
        if (one.data.index() != other.data.index() || one.children != other.children || one.memory != other.memory)
            return false;
        const auto* machine = std::get_if<MachineNode>(&one.data);
        if (machine == nullptr) continue;
        const auto& there = std::get<MachineNode>(other.data);
        if (machine->states != there.states || machine->transitions.size() != there.transitions.size()) return false;
    }
    return true;
}

}  // namespace

void GraphDesk::read(std::string_view text) {
    std::vector<std::string> warnings;
    Pack read = read_graph(text, "graph", character_, &warnings);
    warnings_ = std::move(warnings);
    if (pack_ && same_shape(pack_->program, read.program)) {
        pack_->program = std::move(read.program);
        return;
    }
    walker_.reset();
    pack_ = std::make_unique<Pack>(std::move(read));
    begin();
}

void GraphDesk::begin() {
    const Program& program = pack_->program;
    time_ = 0;
    happened_.clear();
    weights_.assign(program.nodes.size(), 0);
    speed_ = program.parameter("speed");
    turn_ = program.parameter("turn");
    const auto initial = [&](int parameter) {
        return parameter < 0 ? 0.0f : program.parameters[static_cast<std::size_t>(parameter)].initial;
    };
    asked_ = {};
    asked_.speed = initial(speed_);
    asked_.turn = initial(turn_);
    walker_ = make_watched_graph_walker(
        *pack_, [this](float dt, const GraphFrame& frame, const GraphScratch& scratch) { watch(dt, frame, scratch); });
}

void GraphDesk::watch(float dt, const GraphFrame& frame, const GraphScratch& scratch) {
    time_ += static_cast<double>(dt);
    for (std::size_t i = 0; i < weights_.size(); ++i) weights_[i] = node_weight(scratch, static_cast<int>(i));
    for (const GraphEvent& event : frame.events())
        if (happened_.size() < k_most_happened) happened_.push_back({time_ - static_cast<double>(event.ago), event});
}

void GraphDesk::set(int parameter, float value) noexcept {
    if (!walker_ || parameter < 0 || static_cast<std::size_t>(parameter) >= pack_->program.parameters.size()) return;
    if (parameter == speed_)
        asked_.speed = value;
    else if (parameter == turn_)
        asked_.turn = value;
    else
        walker_->ask({parameter, value});
}

std::string GraphDesk::describe() const {
    if (!pack_) throw Error("there is no graph yet", "", "read one first");
    const Program& program = pack_->program;
    Json out = {{"name", program.name},      {"parameters", Json::array()}, {"nodes", Json::array()},
                {"machines", Json::array()}, {"events", program.events},    {"warnings", warnings_}};
    out["curves"] = curves_json();
    for (const Parameter& parameter : program.parameters) out["parameters"].push_back(parameter_json(parameter));
    for (std::size_t i = 0; i < program.nodes.size(); ++i) {
        const Node& node = program.nodes[i];
        out["nodes"].push_back({{"path", node.path},
                                {"type", k_types[node.data.index()]},
                                {"detail", detail_of(program, node.data)},
                                {"children", node.children}});
        if (std::holds_alternative<MachineNode>(node.data))
            out["machines"].push_back(machine_json(program, static_cast<int>(i)));
    }
    return out.dump();
}

std::string GraphDesk::live() {
    if (!pack_) throw Error("there is no graph yet", "", "read one first");
    const Program& program = pack_->program;
    Json out = {{"time", time_},
                {"parameters", Json::array()},
                {"weights", weights_},
                {"machines", Json::array()},
                {"events", Json::array()}};
    for (std::size_t i = 0; i < program.parameters.size(); ++i)
        out["parameters"].push_back(get(program, walker_->state(), static_cast<int>(i)));
    for (std::size_t i = 0; i < program.nodes.size(); ++i) {
        const MachineStatus status = machine_status(program, walker_->state(), static_cast<int>(i));
        if (status.state < 0) continue;
        out["machines"].push_back(
            {{"state", status.state}, {"transition", status.transition}, {"elapsed", status.elapsed}});
    }
    for (const Happened& each : happened_)
        out["events"].push_back({{"event", each.event.event}, {"time", each.time}, {"weight", each.event.weight}});
    happened_.clear();
    return out.dump();
}

}  // namespace surefoot::wasm
