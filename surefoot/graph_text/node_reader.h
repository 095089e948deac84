#pragma once
// The part of a graph file that becomes nodes. Private to graph_text/.

#include <surefoot/program/program.h>

#include <functional>
#include <map>
#include <string>

namespace surefoot {

class JsonNode;

/// Marks from {"NAME": TIME}, ascending; events are made when first named.
std::vector<EventMark> read_marks(Program& program, const JsonNode& events);

/// What nodes name that is not made of nodes.
struct NodeSources {
    std::map<std::string, int> masks;                     ///< index into Program::masks
    std::function<int(const std::string& slot)> clip_of;  ///< index into Program::body.clips, or -1
    std::function<int(const JsonNode& slot)> rig_of;      ///< index into Program::rigs; throws Error
};

/// Compiles the node `root`, given by name or in place, and all below it. What the program has of parameters, groups
/// and targets is there already.
void read_nodes(Program& program, const JsonNode& named, const JsonNode& root, const NodeSources& sources);

}  // namespace surefoot
