// surefoot fix PROJECT: makes the clips that findings ask for, mends what else can be mended, and takes it back.

#include "command.h"
#include "repairs.h"

#include <surefoot/author/lint.h>
#include <surefoot/author/rank.h>
#include <surefoot/base/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace surefoot::cli {
namespace {

struct Options {
    std::string project, undo;
    std::vector<std::string> only;
    bool undo_all = false, dry_run = false, list = false, no_mannequin = false, json = false;
};

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) fmt::print(stderr, "surefoot: {}\n", warning);
}

void list_repairs(const Project& project) {
    if (project.repairs.empty()) fmt::print("no repairs were made\n");
    for (const ProjectRepair& repair : project.repairs) fmt::print("{}: {}: {}\n", repair.id, repair.rule, repair.text);
}

int run(const Options& options) {
    namespace fs = std::filesystem;
    std::vector<std::string> warnings;
    Workbench bench = load_workbench(options.project, warnings);
    const Project before = bench.project;
    std::error_code ignored;
    const fs::path path = options.project, folder = fs::is_directory(path, ignored) ? path : path.parent_path();
    if (options.list) {
        print_warnings(warnings);
        list_repairs(before);
        return 0;
    }
    bool changed = false;
    if (options.undo_all || !options.undo.empty()) {
        const auto undone = undo_repairs(bench, options.undo_all ? "" : options.undo, warnings);
        for (const ProjectRepair& repair : before.repairs)
            if (std::find(undone.begin(), undone.end(), repair.id) != undone.end())
                fmt::print("taken back: {}: {}\n", repair.id, repair.text);
        changed = !undone.empty();
    } else {
        // Findings as they are now: a person may have changed the project since, and a probe's figures may be old.
        bench.project.probe = {};
        lint_again(bench, warnings);
        const RepairReport report = repair(bench, {options.only});
        changed = report.made() > 0;
        if (!options.json) print_repairs(report);
    }
    print_warnings(warnings);
    if (options.json) std::fputs(findings_json(bench.project.findings).c_str(), stdout);
    if (options.dry_run) {
        if (!options.json) fmt::print("dry run: nothing was written\n");
    } else if (changed) {
        rank_placeholders(bench);
        write_project(bench, folder, &before, {!options.no_mannequin, true, {}, warnings});
    }
    return has_findings(bench.project.findings, Severity::error) ? 1 : 0;
}

}  // namespace

void print_repairs(const RepairReport& report) {
    fmt::print("\nrepairs ({}):\n", report.made());
    for (const RepairAttempt& attempt : report.attempts)
        fmt::print("  {} {} {}: {}\n", attempt.done ? "done" : "left", attempt.fix_id, attempt.finding.rule,
                   attempt.text);
    std::map<std::string, std::array<int, 2>> rules;
    for (const auto& [rule, count] : report.before) rules[rule][0] = count;
    for (const auto& [rule, count] : report.after) rules[rule][1] = count;
    if (!rules.empty()) fmt::print("findings before and after:\n");
    for (const auto& [rule, counts] : rules) fmt::print("  {:<32} {:>3} -> {}\n", rule, counts[0], counts[1]);
}

extern const Command k_fix;
const Command k_fix{"fix",
                    "make the clips that a project lacks, and mend what else can be mended; every repair can be undone",
                    [](CLI::App& app) {
                        auto options = std::make_shared<Options>();
                        app.add_option("project", options->project, "project.json or its folder")->required();
                        const auto only = app.add_option("--only", options->only, "a rule or a fix's id (repeatable)");
                        only->allow_extra_args(false);
                        const auto undo = app.add_option("--undo", options->undo, "take back the repair of that id");
                        const auto undo_all = app.add_flag("--undo-all", options->undo_all, "take back all repairs");
                        undo->excludes(only)->excludes(undo_all);
                        undo_all->excludes(only);
                        app.add_flag("--list", options->list, "say which repairs were made");
                        app.add_flag("--dry-run", options->dry_run, "say what would be done and write nothing");
                        app.add_flag("--no-mannequin", options->no_mannequin, "write made clips without a body");
                        app.add_flag("--json", options->json, "print the findings that are left as JSON");
                        return [options] { return run(*options); };
                    }};

}  // namespace surefoot::cli
