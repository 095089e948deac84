#pragma once
// What will go wrong when the clips of a space are blended, and what would mend it.
//
// The five problems of Delicado & Pelechano 2019, §3.2 (crossing axis, acute angles, misalignment, too close,
// uncovered), and more that single clips bring along. Distances in a space are in percent of each axis' range, 0
// included: the paper's grid is 100 x 100.

#include <surefoot/author/pose_distance.h>
#include <surefoot/author/project.h>

#include <span>
#include <string>
#include <vector>

namespace surefoot {

struct RuleThreshold {
    const char* name;  ///< key under "thresholds" in the project file
    double value;      ///< default
    const char* unit;
    const char* help;
};

struct LintRule {
    const char* id;  ///< stable
    const char* title;
    Severity severity;
    std::vector<RuleThreshold> thresholds;
    const char* help;  ///< what the player sees where the rule is broken
};

/// All rules, in the order in which findings are listed.
const std::vector<LintRule>& lint_rules();

/// The rule of that id, or null.
const LintRule* find_lint_rule(std::string_view id) noexcept;

/// The page about a rule in docs/lint, as Markdown: what it is, what the player sees, how to mend it. Empty for an id
/// that is not known.
std::string_view lint_page(std::string_view id) noexcept;

/// Changes a setting as the command line words it: "crossing-axis=off" (or a severity, which also turns it on) and
/// "too-close.distance=6". Throws Error, listing what there is, for a rule, severity or threshold that is not known,
/// and for a value that is no number or below 0. `option` names where the text comes from.
void set_lint_rule(LintSettings& settings, std::string_view text, const std::string& option);
void set_lint_threshold(LintSettings& settings, std::string_view text, const std::string& option);

struct LintResult {
    std::vector<Finding> findings;  ///< worst first, then by rule, space and clips
    std::vector<Placeholder> placeholders;
    std::vector<std::string> warnings;  ///< settings that name no rule or threshold
};

/// Checks the spaces and clips of a project under its own settings. `poses` holds a table for each clip of the project
/// (empty tables where a clip is not at hand); without them the rules about poses are silent. The rules about blends
/// judge `project.probe`, which must be of the spaces as they are (probe/probe.h).
LintResult lint(const Project& project, std::span<const PoseTable> poses = {});

/// The worst severity among findings, if there are any at least as bad as `least`.
bool has_findings(std::span<const Finding> findings, Severity least);

}  // namespace surefoot
