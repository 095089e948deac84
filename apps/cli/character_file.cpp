#include "character_file.h"

#include "live_gait.h"

#include <surefoot/author/project.h>
#include <surefoot/bake/character.h>
#include <surefoot/base/error.h>
#include <surefoot/graph_text/graph_file.h>
#include <surefoot/host/files.h>

#include <fmt/format.h>

#include <cstring>
#include <filesystem>

namespace surefoot::cli {

namespace {

void warn(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) fmt::print(stderr, "{}\n", warning);
}

CharacterFile open_pack(const std::string& name) {
    CharacterFile file;
    const std::string text = read_file(name);
    file.bytes.resize(text.size());
    if (!text.empty()) std::memcpy(file.bytes.data(), text.data(), text.size());
    std::string why;
    std::optional<Pack> pack = Pack::open(file.bytes, &why);
    if (!pack) throw Error(why, name, "");
    file.pack = *std::move(pack);
    return file;
}

bool is_graph(const std::filesystem::path& path) {
    return path.extension() == ".json" && std::filesystem::is_regular_file(path) && is_graph_text(read_file(path));
}

}  // namespace

bool is_pack_file(const std::string& name) { return std::filesystem::path(name).extension() == k_pack_extension; }

CharacterFile read_character_file(const std::string& name, const BakeOptions& options) {
    if (is_pack_file(name)) {
        if (options.error > 0)
            throw Error("its clips have been packed already", name, "bake the project or graph that it came from");
        return open_pack(name);
    }
    CharacterFile file;
    if (is_live_gait(name)) {
        LiveGait live = read_live_gait(name);
        file.pack = gait_graph(std::make_shared<const LiveRig>(std::move(live.rig)), live.name, live.speed);
        return file;
    }
    std::vector<std::string> warnings;
    if (is_graph(name)) {
        file.pack = load_graph(name, &warnings, &file.packing, options);
        warn(warnings);
        return file;
    }
    std::filesystem::path path = name;
    if (std::filesystem::is_directory(path)) path /= "project.json";
    const Project project = load_project(path, &warnings);
    Character character = bake_character(project, path.parent_path(), options);
    warn(warnings);
    warn(character.warnings);
    file.pack = to_pack(character);
    file.packing = std::move(character.packing);
    return file;
}

}  // namespace surefoot::cli
