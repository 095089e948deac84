#pragma once
// A probe's result in the project file. Private to the room.

#include <surefoot/author/probe_result.h>

#include <nlohmann/json_fwd.hpp>

namespace surefoot {

class JsonNode;

/// See probe_json of probe_result.h.
nlohmann::ordered_json to_json(const ProbeResult& result, const ProbeResult* before);

/// Reads what to_json wrote; the summary is not read, it follows from the cells. `before` is filled where the file has
/// one. Throws Error at the node that is wrong.
ProbeResult read_probe(JsonNode node, std::optional<ProbeResult>& before);

}  // namespace surefoot
