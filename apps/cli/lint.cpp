// surefoot lint PROJECT: checks the blend spaces of a project and says what the player will see.

#include "command.h"

#include <surefoot/author/lint.h>
#include <surefoot/base/error.h>
#include <surefoot/host/parallel.h>
#include <surefoot/io/load.h>
#include <surefoot/probe/probe.h>

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace surefoot::cli {
namespace {

struct Options {
    std::string project, fail_on = "info";
    bool json = false, probe = false;
    int probe_grid = 0;
};

/// Poses of the project's clips, for the rules that compare them; a clip that cannot be read is left without, and said
/// so in `warnings`.
std::vector<PoseTable> load_poses(const Project& project, const std::filesystem::path& folder,
                                  std::vector<std::string>& warnings) {
    std::vector<PoseTable> poses(project.clips.size());
    std::vector<std::string> failed(project.clips.size());
    parallel_for(project.clips.size(), [&](std::size_t i) {
        const ProjectClip& clip = project.clips[i];
        if (clip.excluded || clip.file.empty()) return;
        const std::string file = (folder / clip.file).string();
        const LoadResult loaded = load_clips({&file, 1});
        if (loaded.clips.empty()) {
            failed[i] = loaded.failed.empty() ? file + ": no clip in it" : loaded.failed.front().error;
            return;
        }
        const Motion& motion = loaded.clips.front().motion;
        RoleMap map;
        for (const auto& [role, joint] : project.roles)
            if (const int index = motion.skeleton->find(joint); index != k_no_joint)
                map.set(role_from_name(role), index);
        poses[i] = make_pose_table(motion, clip.facts, map);
    });
    for (const std::string& error : failed)
        if (!error.empty()) warnings.push_back(error + "; its poses are not compared: run surefoot author again");
    return poses;
}

int run(const Options& options) {
    namespace fs = std::filesystem;
    std::vector<std::string> warnings;
    Project project = load_project(options.project, &warnings);
    std::error_code ignored;
    const fs::path path = options.project;
    const fs::path folder = fs::is_directory(path, ignored) ? path : path.parent_path();
    // What an earlier probe found may not be true any more.
    project.probe = {};
    if (options.probe || options.probe_grid > 0)
        project.probe = probe(bake_character(project, folder), {options.probe_grid});
    LintResult result = lint(project, load_poses(project, folder, warnings));
    warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
    for (const std::string& warning : warnings) fmt::print(stderr, "surefoot: {}\n", warning);
    if (options.json) {
        std::fputs(findings_json(result.findings, project.probe).c_str(), stdout);
    } else {
        for (const Finding& finding : result.findings) {
            fmt::print("{}: {}: {}\n", severity_name(finding.severity), finding.rule, finding.message);
            if (finding.fix) fmt::print("    mend it: {}\n", finding.fix->text);
        }
        if (result.findings.empty()) fmt::print("no findings\n");
        if (!project.probe.empty()) fmt::print("\n{}", probe_table(project.probe));
    }
    return has_findings(result.findings, *severity_from_name(options.fail_on)) ? 1 : 0;
}

}  // namespace

extern const Command k_lint;
const Command k_lint{"lint", "say what will go wrong when a project's clips are blended", [](CLI::App& app) {
                         auto options = std::make_shared<Options>();
                         app.add_option("project", options->project, "project.json or its folder")->required();
                         app.add_flag("--json", options->json, "print the findings as JSON");
                         app.add_flag("--probe", options->probe, "play the spaces on a grid and judge each blend too");
                         app.add_option("--probe-grid", options->probe_grid, "grid points an axis of the probe")
                             ->check(CLI::Range(2, k_finest_probe_grid));
                         app.add_option("--fail-on", options->fail_on, "least severity that makes the exit code 1")
                             ->check(CLI::IsMember({"error", "warning", "info"}))
                             ->capture_default_str();
                         return [options] { return run(*options); };
                     }};

}  // namespace surefoot::cli
