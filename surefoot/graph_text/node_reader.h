#pragma once
// The part of a graph file that becomes nodes. Private to graph_text/.

#include <surefoot/author/json_node.h>
#include <surefoot/program/program.h>

#include <functional>
#include <map>

namespace surefoot {

/// Makes nodes of a program, whose parameters, groups, events, targets and masks are there already.
class NodeReader {
  public:
    /// `clip_of` gives the clip in a slot (an index into Program::body.clips), or -1.
    NodeReader(Program& program, JsonNode nodes, std::map<std::string, int> masks,
               std::function<int(const std::string&)> clip_of);

    /// Compiles a node, given by name or in place, and all below it. Returns its index.
    int add(JsonNode reference, int depth = 0);
    /// An event's index, made when first named.
    static std::int16_t event_index(Program& program, const std::string& name);
    /// Marks from {"NAME": TIME}, ascending.
    static std::vector<EventMark> marks(Program& program, const JsonNode& events);

  private:
    int add_data(JsonNode& node, const std::string& path, int depth);
    NodeData clip(JsonNode& node);
    NodeData space(JsonNode& node);
    NodeData locomotion(JsonNode& node);
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
    std::map<std::string, int> masks_;
    std::function<int(const std::string&)> clip_of_;
};

}  // namespace surefoot
