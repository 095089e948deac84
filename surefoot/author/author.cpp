#include <surefoot/author/author.h>
#include <surefoot/author/gather.h>
#include <surefoot/author/lint.h>
#include <surefoot/author/place.h>
#include <surefoot/author/report.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/mannequin.h>

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <optional>
#include <set>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

/// The project as its user left it, if there is one.
std::optional<Project> earlier_project(const fs::path& folder, std::vector<std::string>& warnings) {
    std::error_code ignored;
    if (!fs::exists(folder / "project.json", ignored)) return {};
    return load_project(folder / "project.json", &warnings);
}

/// The clip of the earlier project that this one is again.
const ProjectClip* find_again(const Project& before, const ProjectClip& clip) {
    for (const ProjectClip& old : before.clips)
        if (old.source == clip.source && old.source_first == clip.source_first && old.source_last == clip.source_last)
            return &old;
    const int same_name = before.find_clip(clip.name);
    return same_name >= 0 && before.clips[same_name].source == clip.source ? &before.clips[same_name] : nullptr;
}

void set_style(ProjectClip& clip, const std::vector<StyleOption>& styles) {
    for (const StyleOption& style : styles) {
        if (fnmatch(style.pattern.c_str(), clip.name.c_str(), 0) != 0) continue;
        clip.style = style.name;
        clip.upper_body = style.upper_body;
        return;
    }
}

ProjectClip describe(const Candidate& candidate) {
    ProjectClip clip;
    clip.name = candidate.clip.facts.name;
    clip.file = "clips/" + clip.name + ".glb";
    clip.facts = candidate.clip.facts;
    clip.source = candidate.clip.source;
    clip.source_first = candidate.clip.source_first;
    clip.source_last = candidate.clip.source_last;
    clip.provenance = candidate.provenance;
    return clip;
}

RoleOverrides named_roles(const RoleMap& roles, const Skeleton& skeleton) {
    RoleOverrides result;
    for (int r = 0; r < k_role_count; ++r)
        if (const auto role = static_cast<Role>(r); roles.has(role))
            result.emplace_back(role_name(role), skeleton.names[static_cast<std::size_t>(roles[role])]);
    return result;
}

/// Carries over what the user set, and takes out the clips that they left out. `kept` shrinks with the project's clips.
void apply_user_choices(Project& project, std::vector<Candidate>& kept, const Project& before) {
    project.role_overrides = before.role_overrides;
    project.lint = before.lint;
    project.unknown = before.unknown;
    std::vector<ProjectClip> clips, left_out;
    std::vector<Candidate> remaining;
    for (std::size_t i = 0; i < project.clips.size(); ++i) {
        ProjectClip& clip = project.clips[i];
        const ProjectClip* old = find_again(before, clip);
        if (old) clip.pins = old->pins;
        if (old && clip.style.empty()) {
            clip.style = old->style;
            clip.upper_body = old->upper_body;
        }
        if (old && old->excluded_by_user) {
            clip.excluded = clip.excluded_by_user = true;
            clip.reason = old->reason;
            clip.file.clear();
        }
        const bool out = clip.excluded;
        (out ? left_out : clips).push_back(std::move(clip));
        if (!out) remaining.push_back(std::move(kept[i]));
    }
    std::move(left_out.begin(), left_out.end(), std::back_inserter(clips));
    project.clips = std::move(clips);
    kept = std::move(remaining);
}

std::string clip_glb(const ProjectClip& clip, const Motion& motion, const std::optional<Mesh>& mesh) {
    GltfScene scene;
    scene.motions = {motion};
    scene.motion_extras = {clip_extras_json(clip)};
    scene.mesh = mesh;
    return write_glb(scene);
}

/// Clip files of the earlier project that the new one does not have any more.
void remove_stale_clips(const fs::path& folder, const Project& before, const Project& project) {
    std::set<std::string> wanted;
    for (const ProjectClip& clip : project.clips) wanted.insert(clip.file);
    for (const ProjectClip& clip : before.clips) {
        std::error_code ignored;
        if (!clip.file.empty() && !wanted.count(clip.file)) fs::remove(folder / clip.file, ignored);
    }
}

std::string title_of(const fs::path& folder) {
    fs::path path = folder.lexically_normal();
    if (path.filename().empty()) path = path.parent_path();
    const std::string name = path.filename().string();
    return name.empty() || name == "." ? "Blend space" : name;
}

void write_clips(const fs::path& folder, const Project& project, const std::vector<Candidate>& kept, bool mannequin) {
    std::optional<Mesh> mesh;
    if (mannequin) {
        const AnalyzedClip& first = kept.front().clip;
        mesh = make_mannequin(first.motion, first.roles.roles, first.legs);
    }
    parallel_for(kept.size(), [&](std::size_t i) {
        update_file(folder / project.clips[i].file, clip_glb(project.clips[i], kept[i].clip.motion, mesh));
    });
}

std::vector<AnalyzedClip> clips_of(const std::vector<Candidate>& candidates) {
    std::vector<AnalyzedClip> clips;
    for (const Candidate& candidate : candidates) clips.push_back(candidate.clip);
    return clips;
}

/// Everything after loading.
AuthorResult build(std::vector<LoadedClip> clips, const fs::path& folder, const AuthorOptions& options,
                   AuthorResult result) {
    const std::optional<Project> before = earlier_project(folder, result.warnings);
    RoleOverrides overrides = options.role_overrides;
    if (before) overrides.insert(overrides.begin(), before->role_overrides.begin(), before->role_overrides.end());

    Gathered gathered = gather(std::move(clips), overrides,
                               {options.retarget, options.actor, options.cache ? folder / ".cache" : fs::path()});
    for (std::string& failure : gathered.failed) result.failed.push_back(std::move(failure));
    for (std::string& warning : gathered.warnings) result.warnings.push_back(std::move(warning));

    Project& project = result.project;
    project.name = !options.name.empty() ? options.name : before ? before->name : title_of(folder);
    for (const Candidate& candidate : gathered.kept) {
        project.clips.push_back(describe(candidate));
        set_style(project.clips.back(), options.styles);
    }
    if (before) apply_user_choices(project, gathered.kept, *before);
    if (!options.role_overrides.empty()) project.role_overrides = overrides;
    for (ProjectClip& clip : gathered.left_out) project.clips.push_back(std::move(clip));
    if (gathered.kept.empty()) {
        const std::string why = !project.clips.empty() ? "\"" + project.clips[0].name + "\": " + project.clips[0].reason
                                : !result.failed.empty() ? result.failed[0]
                                                         : std::string("none was given");
        throw Error("no clip can be placed in a blend space (" + why + ")", folder.string(),
                    "give clips that walk, run, turn or stand; `surefoot analyze` says what each one does");
    }
    const AnalyzedClip& first = gathered.kept.front().clip;
    project.roles = named_roles(first.roles.roles, *first.motion.skeleton);

    result.takes = gathered.takes;
    result.takes_with_cycles = gathered.takes_with_cycles;
    result.cycles_found = gathered.cycles;
    for (const Candidate& candidate : gathered.kept) result.cycles_placed += candidate.cut_from_take;

    for (const StyleOption& style : options.styles)
        if (std::none_of(project.clips.begin(), project.clips.end(),
                         [&](const ProjectClip& clip) { return !clip.excluded && clip.style == style.name; }))
            result.warnings.push_back("no clip in use is called \"" + style.pattern + "\": there is no style \"" +
                                      style.name + "\"");
    place_clips(project, options.axes, before ? &*before : nullptr, result.warnings);
    if (options.probe && options.grid > 0) result.unsnapped = options.probe(clips_of(gathered.kept), project.spaces);
    if (options.grid > 0) result.snap = snap_to_grid(project, options.grid, result.warnings);
    if (options.probe) project.probe = options.probe(clips_of(gathered.kept), project.spaces);
    std::vector<PoseTable> poses(project.clips.size());
    parallel_for(gathered.kept.size(), [&](std::size_t i) {
        const AnalyzedClip& clip = gathered.kept[i].clip;
        poses[i] = make_pose_table(clip.motion, clip.facts, clip.roles.roles);
    });
    LintResult found = lint(project, poses);
    project.findings = std::move(found.findings);
    project.placeholders = std::move(found.placeholders);
    for (std::string& warning : found.warnings) result.warnings.push_back(std::move(warning));

    write_clips(folder, project, gathered.kept, options.mannequin);
    result.report_file = folder / "report.html";
    std::vector<const AnalyzedClip*> analyzed;
    for (const Candidate& candidate : gathered.kept) analyzed.push_back(&candidate.clip);
    result.figures = make_clip_figures(project, analyzed);
    update_file(result.report_file, report_html(project, {result.failed, result.warnings, &result.figures}));
    result.project_file = folder / "project.json";
    save_project(result.project_file, project);
    if (before) remove_stale_clips(folder, *before, project);
    return result;
}

}  // namespace

StyleOption StyleOption::parse(const std::string& text, bool upper_body) {
    const std::size_t at = text.find('=');
    if (at == 0 || at == std::string::npos || at + 1 == text.size())
        throw Error("\"" + text + "\" names no style and clips", upper_body ? "--upper-style" : "--style",
                    "write NAME=PATTERN, as drunk='drunk_*'");
    return {text.substr(0, at), text.substr(at + 1), upper_body};
}

AuthorResult author_clips(std::span<const std::string> paths, const fs::path& folder, const AuthorOptions& options) {
    LoadOptions load;
    load.unit_scale = options.unit_scale;
    LoadResult loaded = load_clips(paths, load);
    AuthorResult result;
    for (const LoadFailure& failure : loaded.failed)
        result.failed.push_back(failure.error.find(failure.file.substr(0, failure.file.rfind('#'))) == std::string::npos
                                    ? failure.file + ": " + failure.error
                                    : failure.error);
    if (loaded.clips.empty()) {
        if (result.failed.empty())
            throw Error("there are no clips here", paths.empty() ? "CLIPS" : paths.front(),
                        "give files or folders of .bvh, .glb, .gltf or .fbx");
        const std::size_t others = result.failed.size() - 1;
        throw Error(result.failed.front() + (others > 0 ? fmt::format(" (and {} more could not be read)", others) : ""),
                    {}, {});
    }
    return build(std::move(loaded.clips), folder, options, std::move(result));
}

AuthorResult author_motions(std::vector<Motion> motions, const fs::path& folder, const AuthorOptions& options) {
    std::vector<LoadedClip> clips;
    for (Motion& motion : motions) {
        LoadedClip clip;
        clip.file = motion.name;
        clip.motion = std::move(motion);
        clips.push_back(std::move(clip));
    }
    if (clips.empty()) throw Error("there are no clips", "the set", "give at least one");
    return build(std::move(clips), folder, options, {});
}

}  // namespace surefoot
