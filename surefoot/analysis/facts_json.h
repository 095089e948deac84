#pragma once
// Facts of a clip as JSON: the one place that knows the keys, for `surefoot analyze --json` and for project files.
// Numbers carry seven significant digits, so writing what was read gives the same text.

#include <surefoot/analysis/clip_facts.h>

#include <nlohmann/json_fwd.hpp>

namespace surefoot {

enum class FactsDetail {
    listed,  ///< the keys of `analyze --json`; a fact that the clip does not have is null
    full     ///< every field of ClipFacts, so that facts_from_json gives the same facts back
};

nlohmann::ordered_json facts_to_json(const ClipFacts& facts, FactsDetail detail);

/// Reads either form; a missing or null key leaves the field's default. Throws Error, naming the key, where a value has
/// the wrong type. `where` names the file for that message.
ClipFacts facts_from_json(const nlohmann::ordered_json& json, const std::string& where);

}  // namespace surefoot
