#include <surefoot/author/place.h>
#include <surefoot/bake/baking.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/io/load.h>

#include <cmath>

namespace surefoot {

namespace {

/// A clip of the project with root motion. Files made by `author` have it; one that was exchanged by hand may not, and
/// is then measured again.
Motion load_project_clip(const ProjectClip& clip, const ReadProjectFile& read, const std::string& where,
                         const RoleOverrides& roles, std::string& warning) {
    const std::string path = where + clip.file;
    std::vector<LoadedClip> loaded = read_clips(read(clip.file), path);
    if (loaded.empty())
        throw Error("the file holds no clip", path, "run 'surefoot author' again to write the project's clips");
    Motion motion = std::move(loaded.front().motion);
    const RootFrame travel = between(motion.root.front(), motion.root.back());
    constexpr float k_moves = 0.1f;  // [m/s]
    const bool stands = planar_length(travel.position) + std::fabs(travel.yaw) < 1e-6f;
    if (stands && std::fabs(clip.facts.speed) > k_moves) {
        warning = "clip '" + clip.name + "' came without root motion; it was measured again";
        motion = analyze_clip(std::move(motion), clip.file, 1, roles).motion;
    }
    return motion;
}

}  // namespace

Character bake_character(const Project& project, const std::filesystem::path& folder, const BakeOptions& options) {
    return bake_character(
        project, [&](const std::string& file) { return read_file(folder / file); }, (folder / "").string(), options);
}

Character bake_character(const Project& project, const ReadProjectFile& read, const std::string& where,
                         const BakeOptions& options) {
    const std::vector<std::int32_t> used = used_clips(project.spaces, project.clips.size());
    std::vector<Motion> motions(used.size());
    std::vector<std::string> warnings(used.size());
    const auto clip_at = [&](std::size_t i) -> const ProjectClip& {
        return project.clips[static_cast<std::size_t>(used[i])];
    };
    parallel_for(used.size(), [&](std::size_t i) {
        motions[i] = load_project_clip(clip_at(i), read, where, project.roles, warnings[i]);
    });
    std::vector<BakeSource> sources;
    for (std::size_t i = 0; i < used.size(); ++i)
        sources.push_back(
            {&motions[i], &clip_at(i).facts, moves_along_facing(project.spaces, used[i], clip_at(i).facts)});
    const std::size_t calm = calmest(sources);
    const AnalyzedClip body = analyze_clip(motions[calm], clip_at(calm).file, 1, project.roles);
    Character character = bake(project.name, sources, project.spaces, used, body, options);
    for (std::string& warning : warnings)
        if (!warning.empty()) character.warnings.push_back(std::move(warning));
    return character;
}

}  // namespace surefoot
