#pragma once
// Characters as the command line names them: a project, a graph beside one, a live gait, or a pack of any.

#include <surefoot/bake/character.h>
#include <surefoot/pack_file/pack.h>

#include <cstddef>
#include <string>
#include <vector>

namespace surefoot::cli {

struct CharacterFile {
    std::vector<std::byte> bytes;     ///< of a pack: what it points into
    Pack pack;                        ///< of a project: without a program
    std::vector<PackReport> packing;  ///< by clip; a pack does not know any more
};

/// A folder of a project or its project.json, a graph file, a pack, or a live gait (live_gait.h), which becomes a graph
/// of one node. Warnings go to standard error. Throws Error. What has been packed already cannot take `options`.
CharacterFile read_character_file(const std::string& name, const BakeOptions& options = {});

/// True for what has the extension of packs.
bool is_pack_file(const std::string& name);
inline constexpr const char* k_pack_extension = ".sfpack";

}  // namespace surefoot::cli
