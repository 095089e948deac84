#pragma once
// The part of a graph file that becomes nodes. Private to graph_text/.

#include <surefoot/program/program.h>

#include <functional>
#include <map>

namespace surefoot {

class JsonNode;

/// Marks from {"NAME": TIME}, ascending; events are made when first named.
std::vector<EventMark> read_marks(Program& program, const JsonNode& events);

/// Compiles the node `root`, given by name or in place, and all below it. What the program has of parameters, groups,
/// targets and masks is there already. `clip_of` gives the clip in a slot (an index into Program::body.clips), or -1.
void read_nodes(Program& program, const JsonNode& named, const JsonNode& root, const std::map<std::string, int>& masks,
                const std::function<int(const std::string&)>& clip_of);

}  // namespace surefoot
