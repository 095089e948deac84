// surefoot lint PROJECT: checks the blend spaces of a project and says what the player will see.

#include "command.h"

#include <surefoot/author/lint.h>
#include <surefoot/author/sarif.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/io/load.h>
#include <surefoot/probe/probe.h>

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace surefoot::cli {
namespace {

struct Options {
    std::string project, fail_on = "info", sarif, explain;
    std::vector<std::string> rules, thresholds;
    bool json = false, list = false, probe = false;
    int probe_grid = 0;
};

std::string threshold_text(const LintRule& rule) {
    std::string text;
    for (const RuleThreshold& threshold : rule.thresholds)
        text += fmt::format("{}{}={} {}", text.empty() ? "" : ", ", threshold.name, threshold.value, threshold.unit);
    return text;
}

int list_rules() {
    for (const LintRule& rule : lint_rules())
        fmt::print("{:<22} {:<8} {:<28} {}\n", rule.id, severity_name(rule.severity), rule.title, threshold_text(rule));
    return 0;
}

int explain(const std::string& id) {
    const std::string_view page = lint_page(id);
    if (page.empty())
        throw Error("there is no lint rule \"" + id + "\"", "--explain", "`surefoot lint --list` names them all");
    std::fwrite(page.data(), 1, page.size(), stdout);
    return 0;
}

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

/// The project under the settings of this run, and where it is.
struct Opened {
    Project project;
    std::filesystem::path file, folder;
    std::vector<std::string> warnings;
};

Opened open_project(const Options& options) {
    if (options.project.empty())
        throw Error("no project was given", "lint", "name a project.json or its folder; --list shows the rules");
    Opened opened;
    opened.project = load_project(options.project, &opened.warnings);
    for (const std::string& text : options.rules) set_lint_rule(opened.project.lint, text, "--rule");
    for (const std::string& text : options.thresholds) set_lint_threshold(opened.project.lint, text, "--threshold");
    std::error_code ignored;
    const std::filesystem::path path = options.project;
    const bool is_folder = std::filesystem::is_directory(path, ignored);
    opened.folder = is_folder ? path : path.parent_path();
    opened.file = is_folder ? path / "project.json" : path;
    // What an earlier probe found may not be true any more.
    opened.project.probe = {};
    if (options.probe || options.probe_grid > 0)
        opened.project.probe = probe(bake_character(opened.project, opened.folder), {options.probe_grid});
    return opened;
}

void print_findings(const std::vector<Finding>& findings, const ProbeResult& probe) {
    for (const Finding& finding : findings) {
        fmt::print("{}: {}: {}\n", severity_name(finding.severity), finding.rule, finding.message);
        if (finding.fix) fmt::print("    mend it: {}\n", finding.fix->text);
    }
    if (findings.empty()) fmt::print("no findings\n");
    if (!probe.empty()) fmt::print("\n{}", probe_table(probe));
}

int run(const Options& options) {
    if (options.list) return list_rules();
    if (!options.explain.empty()) return explain(options.explain);
    Opened opened = open_project(options);
    std::vector<std::string>& warnings = opened.warnings;
    const LintResult result = lint(opened.project, load_poses(opened.project, opened.folder, warnings));
    warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
    for (const std::string& warning : warnings) fmt::print(stderr, "surefoot: {}\n", warning);
    if (!options.sarif.empty())
        write_file(options.sarif, sarif_json(result.findings, {opened.file.string(), read_file(opened.file),
                                                               SUREFOOT_VERSION, warnings}));
    if (options.json)
        std::fputs(findings_json(result.findings, opened.project.probe).c_str(), stdout);
    else
        print_findings(result.findings, opened.project.probe);
    return has_findings(result.findings, *severity_from_name(options.fail_on)) ? 1 : 0;
}

}  // namespace

extern const Command k_lint;
const Command k_lint{"lint", "say what will go wrong when a project's clips are blended", [](CLI::App& app) {
                         auto options = std::make_shared<Options>();
                         app.add_option("project", options->project, "project.json or its folder");
                         app.add_flag("--json", options->json, "print the findings as JSON");
                         app.add_flag("--probe", options->probe, "play the spaces on a grid and judge each blend too");
                         app.add_option("--probe-grid", options->probe_grid, "grid points an axis of the probe")
                             ->check(CLI::Range(2, k_finest_probe_grid));
                         app.add_option("--sarif", options->sarif, "write the findings as SARIF 2.1.0 to this file");
                         app.add_option("--rule", options->rules,
                                        "change a rule for this run: RULE=off|info|warning|error")
                             ->allow_extra_args(false);
                         app.add_option("--threshold", options->thresholds, "the same for a threshold: RULE.NAME=VALUE")
                             ->allow_extra_args(false);
                         app.add_flag("--list", options->list, "list the rules with severities and thresholds");
                         app.add_option("--explain", options->explain, "print the page about a rule");
                         app.add_option("--fail-on", options->fail_on, "least severity that makes the exit code 1")
                             ->check(CLI::IsMember({"error", "warning", "info"}))
                             ->capture_default_str();
                         return [options] { return run(*options); };
                     }};

}  // namespace surefoot::cli
