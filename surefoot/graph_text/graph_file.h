#pragma once
// Graph files: JSON in, a character with a program out (pack_file/pack.h, program/program.h). docs/graphs.md is their
// manual.
//
// Three tiers: a file may extend another (RFC 7396: objects are merged by key, null takes a key away), so a state graph
// can be shared, its blend trees exchanged node by node, and the clips of a character by slot.

#include <surefoot/bake/character.h>
#include <surefoot/pack_file/pack.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

inline constexpr int k_graph_version = 1;

/// Reads a graph with all that it extends, the project that it names and the clips in its slots. Files are relative to
/// the graph file that names them. Throws Error with the file and the path to the node. Keys that are not known are
/// reported in `warnings`, how well clips were packed in `packing`, in the order of the program's.
Pack load_graph(const std::filesystem::path& file, std::vector<std::string>* warnings = nullptr,
                std::vector<PackReport>* packing = nullptr, const BakeOptions& options = {});

/// The same of a graph's text alone, for a character that is there already, whatever project the text names. `where`
/// names the text in messages. Throws Error for what needs a folder: another graph, files in slots.
Pack read_graph(std::string_view text, const std::string& where, Character character,
                std::vector<std::string>* warnings = nullptr);

/// The graph of one node: a live gait, steered by the parameters "speed" [m/s], "turn" [deg/s] and, where it has
/// several manners, "manner". `own_speed` [m/s] is that of a gait of one clip.
Pack gait_graph(const std::shared_ptr<const LiveRig>& rig, const std::string& name, float own_speed);

/// True where a JSON text is a graph's.
bool is_graph_text(std::string_view text);

}  // namespace surefoot
