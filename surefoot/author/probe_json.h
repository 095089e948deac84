#pragma once
// A probe's result in the project file. Private to the room: brings in all of nlohmann/json.

#include <surefoot/author/json_node.h>
#include <surefoot/author/probe_result.h>

namespace surefoot {

/// See probe_json of probe_result.h.
Json to_json(const ProbeResult& result, const ProbeResult* before);

/// Reads what to_json wrote; the summary is not read, it follows from the cells. `before` is filled where the file has
/// one. Throws Error at the node that is wrong.
ProbeResult read_probe(JsonNode node, std::optional<ProbeResult>& before);

}  // namespace surefoot
