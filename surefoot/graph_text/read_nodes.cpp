#include <surefoot/author/json_node.h>
#include <surefoot/graph_text/names.h>
#include <surefoot/graph_text/node_reader.h>
#include <surefoot/space/triangulate.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace surefoot {

namespace {

std::string names_of(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "there are none yet" : "there are: " + text;
}

template <class Named>
std::vector<std::string> names_in(const std::vector<Named>& list) {
    std::vector<std::string> names;
    for (const Named& named : list) names.push_back(named.name);
    return names;
}

std::int16_t event_index(Program& program, const std::string& name) {
    if (program.event(name) < 0) program.events.push_back(name);
    return static_cast<std::int16_t>(program.event(name));
}

class NodeReader {
  public:
    NodeReader(Program& program, const JsonNode& named, const NodeSources& sources);

    /// Returns the node's index.
    int add(JsonNode reference, int depth = 0);

  private:
    int add_data(JsonNode& node, const std::string& path, int depth);
    NodeData clip(JsonNode& node);
    NodeData space(JsonNode& node);
    NodeData locomotion(JsonNode& node);
    NodeData gait(JsonNode& node);
    NodeData additive(JsonNode& node);
    MachineNode machine(JsonNode& node, std::vector<int>& children, int depth);
    Transition transition(const std::string& name, JsonNode node, const MachineNode& machine);
    Condition condition(JsonNode node);

    Operand operand(const JsonNode& node);
    Operand operand_or(JsonNode& node, const char* key, float otherwise);
    int parameter(const JsonNode& name);
    std::int16_t group(const JsonNode& name);
    std::int16_t group_or_legs(JsonNode& node);
    std::int16_t mask(const JsonNode& name);
    int slot(const JsonNode& name);

    Program& program_;
    std::map<std::string, JsonNode> named_;
    const NodeSources& sources_;
};

NodeReader::NodeReader(Program& program, const JsonNode& named, const NodeSources& sources)
    : program_(program), sources_(sources) {
    for (const auto& [name, node] : named.entries()) named_.emplace(name, node);
}

int NodeReader::parameter(const JsonNode& name) {
    const int index = program_.parameter(name.text());
    if (index < 0) name.fail("there is no parameter '" + name.text() + "'", names_of(names_in(program_.parameters)));
    return index;
}

std::int16_t NodeReader::group(const JsonNode& name) {
    const int index = program_.group(name.text());
    if (index < 0) name.fail("there is no sync group '" + name.text() + "'", names_of(names_in(program_.groups)));
    return static_cast<std::int16_t>(index);
}

/// Spaces keep their clips in step, in a group that is called legs where none is named.
std::int16_t NodeReader::group_or_legs(JsonNode& node) {
    if (node.has("group")) return group(node.at("group"));
    if (program_.group("legs") < 0) program_.groups.push_back({"legs", {}});
    return static_cast<std::int16_t>(program_.group("legs"));
}

std::int16_t NodeReader::mask(const JsonNode& name) {
    const auto found = sources_.masks.find(name.text());
    if (found == sources_.masks.end()) {
        std::vector<std::string> names;
        for (const auto& [key, index] : sources_.masks) names.push_back(key);
        name.fail("there is no mask '" + name.text() + "'", names_of(names));
    }
    return static_cast<std::int16_t>(found->second);
}

int NodeReader::slot(const JsonNode& name) {
    const int clip = sources_.clip_of(name.text());
    if (clip < 0)
        name.fail("there is no clip '" + name.text() + "'", "name a slot of \"clips\", or a clip of the project");
    return clip;
}

Operand NodeReader::operand(const JsonNode& node) {
    if (node.json().is_number()) return node.real();
    if (node.json().is_string()) return {0, 1, parameter(node)};
    JsonNode object = node;
    Operand operand{0, 1, parameter(object.at("parameter"))};
    if (object.has("scale")) operand.scale = object.at("scale").real();
    if (object.has("offset")) operand.offset = object.at("offset").real();
    object.finish();
    return operand;
}

Operand NodeReader::operand_or(JsonNode& node, const char* key, float otherwise) {
    return node.has(key) ? operand(node.at(key)) : Operand(otherwise);
}

NodeData NodeReader::clip(JsonNode& node) {
    ClipNode clip;
    clip.clip = slot(node.at("clip"));
    if (node.has("loop")) clip.loop = node.at("loop").flag();
    clip.rate = operand_or(node, "rate", 1);
    if (node.has("group")) clip.group = group(node.at("group"));
    if (node.has("events")) clip.events = read_marks(program_, node.at("events"));
    if (node.has("align")) {
        JsonNode align = node.at("align");
        const JsonNode target = align.at("target");
        const int index = program_.target(target.text());
        if (index < 0) target.fail("there is no target '" + target.text() + "'", names_of(program_.targets));
        clip.target = static_cast<std::int16_t>(index);
        clip.align_from = align.at("from_s").real();
        clip.align_until = align.at("until_s").real();
        align.finish();
    }
    return clip;
}

NodeData NodeReader::space(JsonNode& node) {
    SpaceDefinition definition;
    SpaceNode result;
    const std::vector<JsonNode> axes = node.at("axes").items();
    if (axes.empty() || axes.size() > k_max_dimensions) node.at("axes").fail("a space has 1 to 4 axes");
    for (JsonNode axis : axes) {
        Axis& made = definition.space.axes.emplace_back();
        made.name = axis.at("name").text();
        if (axis.has("unit")) made.unit = axis.at("unit").text();
        made.low = axis.at("low").real();
        made.high = axis.at("high").real();
        if (!(made.low < made.high)) axis.fail("low is not below high");
        result.at[definition.space.axes.size() - 1] =
            axis.has("value") ? operand(axis.at("value")) : operand(axis.at("name"));
        axis.finish();
    }
    for (JsonNode sample : node.at("samples").items()) {
        const std::vector<float> at = sample.at("at").reals();
        if (at.size() != axes.size()) sample.at("at").fail("it needs one number for each axis");
        SpacePoint& point = definition.space.samples.emplace_back();
        std::copy(at.begin(), at.end(), point.begin());
        definition.clips.push_back(slot(sample.at("clip")));
        sample.finish();
    }
    if (definition.space.samples.empty()) node.at("samples").fail("a space has samples");
    triangulate(definition.space);
    result.space = join_clips(std::move(definition), program_.body.clips);
    result.group = group_or_legs(node);
    return result;
}

NodeData NodeReader::locomotion(JsonNode& node) {
    LocomotionNode result;
    result.speed = operand_or(node, "speed", 0);
    result.turn = operand_or(node, "turn", 0);
    result.lateral = operand_or(node, "lateral", 0);
    result.slope = operand_or(node, "slope", 0);
    result.style_weight = operand_or(node, "style_weight", 1);
    if (node.has("custom"))
        for (const auto& [name, value] : node.at("custom").entries()) {
            const int index = program_.body.custom_slot(name);
            if (index < 0) value.fail("the project has no axis '" + name + "'", names_of(program_.body.custom_names));
            result.custom[static_cast<std::size_t>(index)] = operand(value);
        }
    if (node.has("style")) {
        const JsonNode name = node.at("style");
        const auto& styles = program_.body.styles;
        const auto found = std::find_if(styles.begin(), styles.end(),
                                        [&](const LocomotionStyle& style) { return style.name == name.text(); });
        if (found == styles.end())
            name.fail("the project has no style '" + name.text() + "'", names_of(names_in(styles)));
        result.style = static_cast<std::int16_t>(found - styles.begin());
    }
    result.group = group_or_legs(node);
    return result;
}

NodeData NodeReader::gait(JsonNode& node) {
    GaitNode result;
    result.rig = static_cast<std::int16_t>(sources_.rig_of(node.at("gait")));
    result.speed = operand_or(node, "speed", 0);
    result.turn = operand_or(node, "turn", 0);
    result.manner = operand_or(node, "manner", 0);
    if (node.has("glide_s")) result.glide = node.at("glide_s").real();
    return result;
}

NodeData NodeReader::additive(JsonNode& node) {
    AdditiveNode result;
    result.weight = operand_or(node, "weight", 1);
    if (node.has("mask")) result.mask = mask(node.at("mask"));
    // What the addition is measured against: the first frame of a clip.
    const Leaf first{slot(node.at("reference")), 0, 1};
    std::vector<Transform> locals(program_.body.skeleton->rest.size());
    sample_pose(*program_.body.skeleton, program_.body.clips, {&first, 1}, locals);
    result.reference = static_cast<std::int16_t>(program_.references.size());
    program_.references.push_back(std::move(locals));
    return result;
}

Condition NodeReader::condition(JsonNode node) {
    Condition condition;
    if (node.has("trigger")) {
        const JsonNode name = node.at("trigger");
        condition.subject = static_cast<std::int16_t>(parameter(name));
        if (program_.parameters[static_cast<std::size_t>(condition.subject)].kind != ParameterKind::trigger)
            name.fail("the parameter '" + name.text() + "' is no trigger", "give it \"type\": \"trigger\"");
    } else if (node.has("elapsed_s")) {
        condition.kind = ConditionKind::elapsed;
        condition.value = node.at("elapsed_s").real();
    } else if (node.has("remaining_s")) {
        condition.kind = ConditionKind::remaining;
        condition.value = node.at("remaining_s").real();
    } else if (node.has("phase_of")) {
        condition.kind = ConditionKind::window;
        condition.subject = group(node.at("phase_of"));
        condition.value = node.at("from").real();
        condition.value_to = node.at("to").real();
    } else {
        condition.subject = static_cast<std::int16_t>(parameter(node.at("parameter")));
        int found = 0;
        for (const auto& [word, comparison] : k_comparisons) {
            const std::string key(word);
            if (!node.has(key.c_str())) continue;
            ++found;
            condition.comparison = comparison;
            condition.value = node.at(key.c_str()).real();
        }
        if (found != 1)
            node.fail("a condition compares with one value", R"(write it as {"parameter": "speed", ">": 1})");
    }
    node.finish();
    return condition;
}

Transition NodeReader::transition(const std::string& name, JsonNode node, const MachineNode& machine) {
    const auto state_of = [&](const JsonNode& state) {
        const auto found = std::find(machine.states.begin(), machine.states.end(), state.text());
        if (found == machine.states.end())
            state.fail("there is no state '" + state.text() + "'", names_of(machine.states));
        return static_cast<std::int16_t>(found - machine.states.begin());
    };
    Transition t;
    t.name = name;
    if (const JsonNode from = node.at("from"); from.text() != "any") t.from = state_of(from);
    t.to = state_of(node.at("to"));
    if (node.has("seconds")) t.seconds = node.at("seconds").real();
    if (node.has("curve")) t.curve = node.at("curve").word(k_curves);
    if (node.has("kind")) t.kind = node.at("kind").word(k_kinds);
    if (node.has("interrupted_by")) t.interrupted_by = node.at("interrupted_by").word(k_interruptions);
    if (node.has("priority")) t.priority = node.at("priority").real();
    if (node.has("enter")) {
        JsonNode enter = node.at("enter");
        if (enter.json().is_object()) {
            t.entry = Entry::phase;
            t.entry_group = group(enter.at("phase_of"));
            enter.finish();
        } else {
            t.entry = enter.word(k_entries);
        }
    }
    for (const JsonNode& when : node.at("when").items()) t.conditions.push_back(condition(when));
    if (t.conditions.empty()) node.at("when").fail("a transition without conditions would run at once");
    node.finish();
    return t;
}

MachineNode NodeReader::machine(JsonNode& node, std::vector<int>& children, int depth) {
    MachineNode machine;
    for (const auto& [name, state] : node.at("states").entries()) {
        if (name == "any") state.fail("'any' is no name for a state: transitions use it for all of them");
        machine.states.push_back(name);
        children.push_back(add(state, depth + 1));
    }
    if (machine.states.empty()) node.at("states").fail("a machine has states");
    if (node.has("initial")) {
        const JsonNode initial = node.at("initial");
        const auto found = std::find(machine.states.begin(), machine.states.end(), initial.text());
        if (found == machine.states.end())
            initial.fail("there is no state '" + initial.text() + "'", names_of(machine.states));
        machine.initial = static_cast<std::int16_t>(found - machine.states.begin());
    }
    if (node.has("transitions"))
        for (const auto& [name, entry] : node.at("transitions").entries())
            machine.transitions.push_back(transition(name, entry, machine));
    return machine;
}

int NodeReader::add(JsonNode reference, int depth) {
    if (depth > k_max_depth || program_.nodes.size() >= k_max_nodes)
        reference.fail("nodes lie more than 32 deep, or are more than 1024 with all their uses",
                       "does a node lead back to itself?");
    if (!reference.json().is_string()) return add_data(reference, reference.path(), depth);
    const auto found = named_.find(reference.text());
    if (found == named_.end()) {
        std::vector<std::string> names;
        for (const auto& [name, node] : named_) names.push_back(name);
        reference.fail("there is no node '" + reference.text() + "'", names_of(names));
    }
    JsonNode node = found->second;
    return add_data(node, node.path(), depth);
}

int NodeReader::add_data(JsonNode& node, const std::string& path, int depth) {
    const JsonNode type_node = node.at("type");
    const std::string type = type_node.text();
    std::vector<int> children;
    NodeData data;
    const auto below = [&](const char* key) { children.push_back(add(node.at(key), depth + 1)); };
    if (type == "clip") {
        data = clip(node);
    } else if (type == "space") {
        data = space(node);
    } else if (type == "locomotion") {
        data = locomotion(node);
    } else if (type == "gait") {
        data = gait(node);
    } else if (type == "lerp") {
        below("from");
        below("to");
        data = LerpNode{operand(node.at("weight"))};
    } else if (type == "additive") {
        below("base");
        below("add");
        data = additive(node);
    } else if (type == "layer") {
        below("base");
        below("over");
        data = LayerNode{operand_or(node, "weight", 1), mask(node.at("mask"))};
    } else if (type == "mirror") {
        below("of");
        data = MirrorNode{operand_or(node, "when", 1)};
    } else if (type == "rate") {
        below("of");
        data = RateNode{operand(node.at("factor"))};
    } else if (type == "feet") {
        below("of");
        data = FeetNode{operand(node.at("weight"))};
    } else if (type == "machine") {
        data = machine(node, children, depth);
    } else {
        type_node.fail("there are no nodes of type '" + type + "'",
                       "one of: clip, space, locomotion, gait, lerp, additive, layer, mirror, rate, feet, machine");
    }
    node.finish();
    return add_node(program_, path, std::move(data), children);
}

}  // namespace

std::vector<EventMark> read_marks(Program& program, const JsonNode& events) {
    std::vector<EventMark> marks;
    for (const auto& [name, time] : events.entries()) marks.push_back({event_index(program, name), time.real()});
    std::stable_sort(marks.begin(), marks.end(), [](const EventMark& a, const EventMark& b) { return a.at < b.at; });
    return marks;
}

void read_nodes(Program& program, const JsonNode& named, const JsonNode& root, const NodeSources& sources) {
    NodeReader(program, named, sources).add(root);
}

}  // namespace surefoot
