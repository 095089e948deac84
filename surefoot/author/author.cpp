#include <surefoot/author/author.h>
#include <surefoot/author/gather.h>
#include <surefoot/author/rank.h>
#include <surefoot/author/workbench.h>
#include <surefoot/base/error.h>
#include <surefoot/host/parallel.h>

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
const ProjectClip* find_again(const Project& before, const std::string& source, int first, int last,
                              const std::string& name) {
    for (const ProjectClip& old : before.clips)
        if (old.source == source && old.source_first == first && old.source_last == last && !old.made()) return &old;
    const int same_name = before.find_clip(name);
    return same_name >= 0 && before.clips[same_name].source == source ? &before.clips[same_name] : nullptr;
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
    clip.retargeted = candidate.retargeted;
    return clip;
}

RoleOverrides named_roles(const RoleMap& roles, const Skeleton& skeleton) {
    RoleOverrides result;
    for (int r = 0; r < k_role_count; ++r)
        if (const auto role = static_cast<Role>(r); roles.has(role))
            result.emplace_back(role_name(role), skeleton.names[static_cast<std::size_t>(roles[role])]);
    return result;
}

/// Carries over what the user set. Clips that they pinned or left out and that were not given this time stay in the
/// project by name, so that their pins are there when they come back.
void apply_user_choices(Workbench& bench, const Project& before) {
    Project& project = bench.project;
    project.role_overrides = before.role_overrides;
    project.lint = before.lint;
    project.unknown = before.unknown;
    std::set<const ProjectClip*> again;
    for (ProjectClip& clip : project.clips) {
        const ProjectClip* old = find_again(before, clip.source, clip.source_first, clip.source_last, clip.name);
        if (!old) continue;
        again.insert(old);
        clip.pins = old->pins;
        if (clip.style.empty()) {
            clip.style = old->style;
            clip.upper_body = old->upper_body;
        }
        if (!old->excluded_by_user) continue;
        clip.excluded = clip.excluded_by_user = true;
        clip.reason = old->reason;
        clip.file.clear();
    }
    for (const ProjectClip& old : before.clips) {
        if (again.count(&old) || old.made() || (old.pins.empty() && !old.excluded_by_user)) continue;
        if (project.find_clip(old.name) >= 0) continue;
        ProjectClip absent = old;
        absent.excluded = true;
        absent.file.clear();
        absent.repair.clear();
        if (!absent.excluded_by_user) absent.reason = "it was not among the clips given this time";
        bench.add(std::move(absent), nullptr);
    }
}

std::string title_of(const fs::path& folder) {
    fs::path path = folder.lexically_normal();
    if (path.filename().empty()) path = path.parent_path();
    const std::string name = path.filename().string();
    return name.empty() || name == "." ? "Blend space" : name;
}

/// Measured clips and those with a reason to be left out, as a project.
Workbench lay_out(Gathered gathered, const std::vector<StyleOption>& styles, const Project* before,
                  AuthorResult& result) {
    Workbench bench;
    for (std::string& failure : gathered.failed) result.failed.push_back(std::move(failure));
    result.takes = gathered.takes;
    result.takes_with_cycles = gathered.takes_with_cycles;
    result.cycles_found = gathered.cycles;
    std::vector<std::shared_ptr<const BenchClip>> motions(gathered.kept.size());
    std::vector<ProjectClip> clips;
    for (const Candidate& candidate : gathered.kept) {
        clips.push_back(describe(candidate));
        set_style(clips.back(), styles);
        result.cycles_placed += candidate.cut_from_take;
    }
    parallel_for(motions.size(),
                 [&](std::size_t i) { motions[i] = make_bench_clip(std::move(gathered.kept[i].clip)); });
    for (std::size_t i = 0; i < motions.size(); ++i) bench.add(std::move(clips[i]), std::move(motions[i]));
    for (ProjectClip& clip : gathered.left_out) bench.add(std::move(clip), nullptr);
    if (before) apply_user_choices(bench, *before);
    return bench;
}

void warn_of_empty_styles(const Project& project, const std::vector<StyleOption>& styles,
                          std::vector<std::string>& warnings) {
    for (const StyleOption& style : styles)
        if (std::none_of(project.clips.begin(), project.clips.end(),
                         [&](const ProjectClip& clip) { return !clip.excluded && clip.style == style.name; }))
            warnings.push_back("no clip in use is called \"" + style.pattern + "\": there is no style \"" + style.name +
                               "\"");
}

/// Repairs, with a probe of what was before where one is asked for.
RepairReport repair_and_compare(Workbench& bench, const Project* before, const SpaceProbe& probe) {
    std::optional<ProbeResult> first;
    if (probe) first = probe(clips_in_use(bench), bench.project.spaces);
    RepairReport report = repair(bench);
    if (report.made() > 0)
        bench.project.probe_before = std::move(first);
    else if (probe && before)
        bench.project.probe_before = before->probe_before;
    return report;
}

void choose_weights(BlendSpace& space, const AuthorOptions& options) {
    if (options.weighting) space.weighting = *options.weighting;
    if (!options.extrapolate) return;
    space.outside = *options.extrapolate > 0 ? Outside::extrapolate : Outside::clamp;
    if (*options.extrapolate > 0) space.extrapolation_bound = *options.extrapolate;
}

/// Everything between loading and writing. `cache`: a folder, or none. `where` stands in the message that nothing is
/// usable.
Workbench build(std::vector<LoadedClip> clips, const Project* before, const AuthorOptions& options,
                const fs::path& cache, const std::string& where, AuthorResult& result) {
    RoleOverrides overrides = options.role_overrides;
    if (before) overrides.insert(overrides.begin(), before->role_overrides.begin(), before->role_overrides.end());

    const auto left_out = [&](const AnalyzedClip& clip) {
        const ProjectClip* old =
            before ? find_again(*before, clip.source, clip.source_first, clip.source_last, clip.facts.name) : nullptr;
        return old && old->excluded_by_user;
    };
    Gathered gathered = gather(std::move(clips), overrides, {options.retarget, options.actor, cache, left_out});
    for (std::string& warning : gathered.warnings) result.warnings.push_back(std::move(warning));
    Workbench bench = lay_out(std::move(gathered), options.styles, before, result);
    Project& project = bench.project;
    project.name = options.name.empty() && before ? before->name : options.name;
    project.asked_axes = !options.axes.empty() || !before ? options.axes : before->asked_axes;
    if (!options.role_overrides.empty()) project.role_overrides = overrides;
    const auto usable = std::find_if(project.clips.begin(), project.clips.end(),
                                     [](const ProjectClip& clip) { return !clip.excluded; });
    if (usable == project.clips.end()) {
        const std::string why = !project.clips.empty() ? "\"" + project.clips[0].name + "\": " + project.clips[0].reason
                                : !result.failed.empty() ? result.failed[0]
                                                         : std::string("none was given");
        throw Error("no clip can be placed in a blend space (" + why + ")", where,
                    "give clips that walk, run, turn or stand; `surefoot analyze` says what each one does");
    }
    const AnalyzedClip& first = bench.clips[static_cast<std::size_t>(usable - project.clips.begin())]->clip;
    project.roles = named_roles(first.roles.roles, *first.motion.skeleton);
    if (before) replay_repairs(bench, *before, result.warnings);
    place_and_lint(bench, before, result.warnings);
    if (options.weighting || options.extrapolate)
        for (ProjectSpace& space : project.spaces) choose_weights(space.space, options);
    if (options.fix) result.repairs = repair_and_compare(bench, before, options.probe);

    warn_of_empty_styles(project, options.styles, result.warnings);
    if (options.probe && options.grid > 0) result.unsnapped = options.probe(clips_in_use(bench), project.spaces);
    if (options.grid > 0) result.snap = snap_to_grid(project, options.grid, result.warnings);
    if (options.probe) project.probe = options.probe(clips_in_use(bench), project.spaces);
    if (options.probe || options.grid > 0) lint_again(bench, result.warnings);
    rank_placeholders(bench);
    return bench;
}

/// The same from and into a folder.
AuthorResult build_in(const fs::path& folder, std::vector<LoadedClip> clips, AuthorOptions options,
                      AuthorResult result) {
    const std::optional<Project> earlier = earlier_project(folder, result.warnings);
    const Project* before = earlier ? &*earlier : nullptr;
    if (options.name.empty() && !before) options.name = title_of(folder);
    Workbench bench = build(std::move(clips), before, options, options.cache ? folder / ".cache" : fs::path(),
                            folder.string(), result);
    write_project(bench, folder, before, {options.mannequin, false, result.failed, result.warnings});
    result.report_file = folder / "report.html";
    result.project_file = folder / "project.json";
    result.project = std::move(bench.project);
    return result;
}

/// The clips of what was loaded; what could not be read is noted in `result`.
std::vector<LoadedClip> take_loaded(LoadResult loaded, AuthorResult& result) {
    for (const LoadFailure& failure : loaded.failed)
        result.failed.push_back(failure.error.find(failure.file.substr(0, failure.file.rfind('#'))) == std::string::npos
                                    ? failure.file + ": " + failure.error
                                    : failure.error);
    if (loaded.clips.empty()) {
        if (result.failed.empty())
            throw Error("there are no clips here", "CLIPS", "give files or folders of .bvh, .glb, .gltf or .fbx");
        const std::size_t others = result.failed.size() - 1;
        throw Error(result.failed.front() + (others > 0 ? fmt::format(" (and {} more could not be read)", others) : ""),
                    {}, {});
    }
    return std::move(loaded.clips);
}

LoadResult as_loaded(std::vector<Motion> motions) {
    LoadResult loaded;
    for (Motion& motion : motions) {
        LoadedClip clip;
        clip.file = motion.name;
        clip.motion = std::move(motion);
        loaded.clips.push_back(std::move(clip));
    }
    if (loaded.clips.empty()) throw Error("there are no clips", "the set", "give at least one");
    return loaded;
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
    if (loaded.clips.empty() && loaded.failed.empty())
        throw Error("there are no clips here", paths.empty() ? "CLIPS" : paths.front(),
                    "give files or folders of .bvh, .glb, .gltf or .fbx");
    return author_loaded(std::move(loaded), folder, options);
}

AuthorResult author_loaded(LoadResult loaded, const fs::path& folder, const AuthorOptions& options) {
    AuthorResult result;
    std::vector<LoadedClip> clips = take_loaded(std::move(loaded), result);
    return build_in(folder, std::move(clips), options, std::move(result));
}

AuthorResult author_motions(std::vector<Motion> motions, const fs::path& folder, const AuthorOptions& options) {
    return author_loaded(as_loaded(std::move(motions)), folder, options);
}

Workbench author_workbench(LoadResult loaded, const AuthorOptions& options, AuthorResult& result) {
    std::vector<LoadedClip> clips = take_loaded(std::move(loaded), result);
    return build(std::move(clips), nullptr, options, {}, options.name, result);
}

Workbench author_workbench(std::vector<Motion> motions, const AuthorOptions& options, AuthorResult& result) {
    return author_workbench(as_loaded(std::move(motions)), options, result);
}

}  // namespace surefoot
