#include <surefoot/analysis/footing.h>
#include <surefoot/author/lint.h>
#include <surefoot/author/place.h>
#include <surefoot/author/report.h>
#include <surefoot/author/workbench.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>
#include <surefoot/mannequin/mannequin.h>

#include <algorithm>
#include <optional>
#include <set>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

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

/// One a clip of the project; null where its motion is not at hand.
std::vector<const AnalyzedClip*> analyzed_clips(const Workbench& bench) {
    std::vector<const AnalyzedClip*> clips;
    for (const auto& clip : bench.clips) clips.push_back(clip ? &clip->clip : nullptr);
    return clips;
}

/// The clips of the spaces first, then those with a reason to be out of them, each in order of name.
void arrange(Workbench& bench) {
    std::vector<std::size_t> order(bench.clips.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const ProjectClip &x = bench.project.clips[a], &y = bench.project.clips[b];
        return x.excluded != y.excluded ? y.excluded : x.name < y.name;
    });
    std::vector<ProjectClip> clips;
    std::vector<std::shared_ptr<const BenchClip>> motions;
    for (const std::size_t i : order) {
        clips.push_back(std::move(bench.project.clips[i]));
        motions.push_back(std::move(bench.clips[i]));
    }
    bench.project.clips = std::move(clips);
    bench.clips = std::move(motions);
}

/// One clip of a project. Its facts are the project's: what a person corrected there counts.
std::shared_ptr<const BenchClip> load_clip(const Project& project, const ProjectClip& clip, const ReadProjectFile& read,
                                           const std::string& where, std::string& warning) {
    const std::string file = where + clip.file;
    std::vector<LoadedClip> loaded;
    try {
        loaded = read_clips(read(clip.file), file);
    } catch (const std::exception& error) {
        warning = error.what();
        return nullptr;
    }
    if (loaded.empty()) {
        warning = file + ": no clip in it";
        return nullptr;
    }
    AnalyzedClip result;
    result.motion = std::move(loaded.front().motion);
    result.motion.name = clip.name;
    for (const auto& [role, joint] : project.roles)
        if (const int index = result.motion.skeleton->find(joint); index != k_no_joint)
            result.roles.roles.set(role_from_name(role), index);
    if (!result.roles.roles.has_legs()) {
        warning = file + ": its skeleton is not that of the project";
        return nullptr;
    }
    result.legs = find_footing(result.motion, result.roles.roles, make_tracks(result.motion, result.roles.roles)).legs;
    result.facts = clip.facts;
    result.source = clip.source;
    result.source_first = clip.source_first;
    result.source_last = clip.source_last;
    return make_bench_clip(std::move(result));
}

}  // namespace

std::shared_ptr<const BenchClip> make_bench_clip(AnalyzedClip clip) {
    auto result = std::make_shared<BenchClip>();
    result->poses = make_pose_table(clip.motion, clip.facts, clip.roles.roles);
    result->clip = std::move(clip);
    return result;
}

void Workbench::add(ProjectClip clip, std::shared_ptr<const BenchClip> motion) {
    project.clips.push_back(std::move(clip));
    clips.push_back(std::move(motion));
}

const BenchClip* Workbench::find(std::string_view name) const noexcept {
    const int index = project.find_clip(name);
    return index < 0 ? nullptr : clips[static_cast<std::size_t>(index)].get();
}

std::vector<AnalyzedClip> clips_in_use(const Workbench& bench) {
    std::vector<AnalyzedClip> clips;
    for (std::size_t i = 0; i < bench.clips.size() && !bench.project.clips[i].excluded; ++i) {
        if (!bench.clips[i])
            throw Error("the clip could not be read", bench.project.clips[i].file, "run surefoot author again");
        clips.push_back(bench.clips[i]->clip);
    }
    return clips;
}

void place_and_lint(Workbench& bench, const Project* before, std::vector<std::string>& warnings) {
    arrange(bench);
    place_clips(bench.project, bench.project.asked_axes, before, warnings);
    lint_again(bench, warnings);
}

void lint_again(Workbench& bench, std::vector<std::string>& warnings) {
    Project& project = bench.project;
    std::vector<PoseTable> poses(project.clips.size());
    for (std::size_t i = 0; i < poses.size(); ++i)
        if (bench.clips[i] && !project.clips[i].excluded) poses[i] = bench.clips[i]->poses;
    LintResult found = lint(project, poses);
    project.findings = std::move(found.findings);
    project.placeholders = std::move(found.placeholders);
    for (std::string& warning : found.warnings) warnings.push_back(std::move(warning));
}

Workbench load_workbench(const fs::path& path, std::vector<std::string>& warnings) {
    Project project = load_project(path, &warnings);
    std::error_code ignored;
    const fs::path folder = fs::is_directory(path, ignored) ? path : path.parent_path();
    return load_workbench(
        std::move(project), [&](const std::string& file) { return read_file(folder / file); }, warnings,
        (folder / "").string());
}

Workbench load_workbench(Project given, const ReadProjectFile& read, std::vector<std::string>& warnings,
                         const std::string& where) {
    Workbench bench;
    bench.project = std::move(given);
    const Project& project = bench.project;
    bench.clips.resize(project.clips.size());
    std::vector<std::string> failed(project.clips.size());
    parallel_for(project.clips.size(), [&](std::size_t i) {
        if (!project.clips[i].file.empty())
            bench.clips[i] = load_clip(project, project.clips[i], read, where, failed[i]);
    });
    for (const std::string& error : failed)
        if (!error.empty()) warnings.push_back(error + "; run surefoot author again");
    return bench;
}

void give_project(const Workbench& bench, const WriteOptions& options,
                  const std::function<bool(const ProjectClip&)>& wanted, const PutProjectFile& put) {
    const Project& project = bench.project;
    const auto any = std::find_if(bench.clips.begin(), bench.clips.end(), [](const auto& clip) { return clip; });
    std::optional<Mesh> mesh;
    if (options.mannequin && any != bench.clips.end()) {
        const AnalyzedClip& first = (*any)->clip;
        mesh = make_mannequin(first.motion, first.roles.roles, first.legs);
    }
    parallel_for(project.clips.size(), [&](std::size_t i) {
        const ProjectClip& clip = project.clips[i];
        if (clip.file.empty() || !bench.clips[i] || !wanted(clip)) return;
        put(clip.file, clip_glb(clip, bench.clips[i]->clip.motion, mesh));
    });
    const ClipFigures figures = make_clip_figures(project, analyzed_clips(bench));
    put("report.html", report_html(project, {options.failed, options.warnings, &figures}));
    put("project.json", project_json(project));
}

void write_project(const Workbench& bench, const fs::path& folder, const Project* before, const WriteOptions& options) {
    const Project& project = bench.project;
    const auto wanted = [&](const ProjectClip& clip) {
        std::error_code ignored;
        return !options.only_new || !before || before->find_clip(clip.name) < 0 ||
               !fs::exists(folder / clip.file, ignored);
    };
    give_project(bench, options, wanted,
                 [&](const std::string& file, const std::string& bytes) { update_file(folder / file, bytes); });
    if (before) remove_stale_clips(folder, *before, project);
}

}  // namespace surefoot
