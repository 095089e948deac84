#include "bench_desk.h"

#include <surefoot/author/author.h>
#include <surefoot/author/heat.h>
#include <surefoot/author/lint.h>
#include <surefoot/author/rank.h>
#include <surefoot/base/error.h>
#include <surefoot/io/load.h>
#include <surefoot/preset/default_set.h>
#include <surefoot/probe/probe.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace surefoot::wasm {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t k_most_steps = 100;

std::vector<float> values_of(const BlendSpace& space, const SpacePoint& point) {
    return {point.begin(), point.begin() + space.dimensions()};
}

Json space_json(const Project& project, const ProjectSpace& space) {
    Json out = {{"name", space.name}, {"axes", Json::array()}, {"samples", Json::array()}, {"cells", Json::array()}};
    for (const Axis& axis : space.space.axes)
        out["axes"].push_back({{"name", axis.name}, {"unit", axis.unit}, {"low", axis.low}, {"high", axis.high}});
    for (std::size_t s = 0; s < space.clips.size(); ++s)
        out["samples"].push_back({{"clip", project.clips[static_cast<std::size_t>(space.clips[s])].name},
                                  {"at", values_of(space.space, space.space.samples[s])}});
    for (const Simplex& simplex : space.space.simplices) {
        Json corners = Json::array();
        for (const std::int32_t corner : simplex)
            if (corner >= 0) corners.push_back(corner);
        out["cells"].push_back(std::move(corners));
    }
    return out;
}

/// What a threshold is now: the user's number or the default.
double threshold_of(const LintSettings& settings, const LintRule& rule, const RuleThreshold& threshold) {
    const auto setting = settings.find(rule.id);
    if (setting == settings.end()) return threshold.value;
    const auto value = setting->second.thresholds.find(threshold.name);
    return value == setting->second.thresholds.end() ? threshold.value : value->second;
}

Json rule_json(const LintSettings& settings, const LintRule& rule) {
    Json thresholds = Json::array();
    for (const RuleThreshold& threshold : rule.thresholds)
        thresholds.push_back({{"name", threshold.name},
                              {"unit", threshold.unit},
                              {"help", threshold.help},
                              {"initial", threshold.value},
                              {"value", threshold_of(settings, rule, threshold)}});
    return {{"id", rule.id}, {"title", rule.title}, {"help", rule.help}, {"thresholds", std::move(thresholds)}};
}

/// `mend` is the fix's id where a fix is known, which may still turn out not to help.
Json finding_json(const Finding& finding) {
    return {{"rule", finding.rule},       {"severity", severity_name(finding.severity)},
            {"message", finding.message}, {"space", finding.space},
            {"clips", finding.clips},     {"at", finding.at},
            {"id", fix_id(finding)},      {"mend", finding.fix ? Json(finding.fix->text) : Json(nullptr)}};
}

Json placeholder_json(const Placeholder& placeholder) {
    return {{"space", placeholder.space}, {"needed", placeholder.kind == PlaceholderKind::needed},
            {"axes", placeholder.axes},   {"at", placeholder.target},
            {"rule", placeholder.rule},   {"text", placeholder.text}};
}

Json repair_json(const ProjectRepair& repair) {
    return {{"id", repair.id}, {"rule", repair.rule}, {"text", repair.text}};
}

Json left_out_json(const ProjectClip& clip, bool at_hand) {
    return {{"clip", clip.name}, {"reason", clip.reason}, {"byUser", clip.excluded_by_user}, {"atHand", at_hand}};
}

Json attempt_json(const RepairAttempt& attempt) {
    return {{"id", attempt.fix_id}, {"rule", attempt.finding.rule}, {"done", attempt.done}, {"text", attempt.text}};
}

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

BenchDesk::BenchDesk(Workbench bench) : bench_(std::move(bench)), given_(bench_.project.lint) {}

BenchDesk BenchDesk::of_default() {
    AuthorOptions options;
    options.name = "Default character";
    AuthorResult result;
    return BenchDesk(author_workbench(make_default_set().clips, options, result));
}

BenchDesk BenchDesk::of_project(const Files& files, bool on_disk) {
    const ReadProjectFile read = [&](const std::string& file) -> std::string {
        const auto found = files.find(file);
        if (found == files.end())
            throw Error("the file is missing", file, "choose the folder that 'surefoot author -o' wrote");
        return found->second;
    };
    std::vector<std::string> warnings;
    Project project = parse_project(read("project.json"), "project.json", &warnings);
    BenchDesk desk(load_workbench(std::move(project), read, warnings));
    // As it is now: a person may have changed the project since it was linted and probed.
    desk.bench_.project.probe = {};
    lint_again(desk.bench_, warnings);
    if (on_disk) desk.saved();
    desk.warnings_ = std::move(warnings);
    return desk;
}

BenchDesk BenchDesk::of_clips(const Files& files, const std::string& name) {
    AuthorOptions options;
    options.name = name;
    AuthorResult result;
    BenchDesk desk(author_workbench(load_clips_in_memory(files), options, result));
    desk.failed_ = std::move(result.failed);
    desk.warnings_ = std::move(result.warnings);
    return desk;
}

std::string BenchDesk::describe() const {
    const Project& project = bench_.project;
    Json out = {{"name", project.name},
                {"spaces", Json::array()},
                {"rules", Json::array()},
                {"findings", Json::array()},
                {"placeholders", Json::array()},
                {"repairs", Json::array()},
                {"leftOut", Json::array()},
                {"failed", failed_},
                {"warnings", warnings_},
                {"probed", !project.probe.empty()},
                {"undo", past_.empty() ? Json(nullptr) : Json(past_.back().label)},
                {"redo", future_.empty() ? Json(nullptr) : Json(future_.back().label)},
                {"unsaved", !(project == saved_.project)}};
    for (const ProjectSpace& space : project.spaces) out["spaces"].push_back(space_json(project, space));
    for (const LintRule& rule : lint_rules()) out["rules"].push_back(rule_json(project.lint, rule));
    for (const Finding& finding : project.findings) out["findings"].push_back(finding_json(finding));
    for (const Placeholder& each : project.placeholders) out["placeholders"].push_back(placeholder_json(each));
    for (const ProjectRepair& repair : project.repairs) out["repairs"].push_back(repair_json(repair));
    for (std::size_t i = 0; i < project.clips.size(); ++i)
        if (project.clips[i].excluded)
            out["leftOut"].push_back(left_out_json(project.clips[i], bench_.clips[i] != nullptr));
    return dumped(out);
}

std::string BenchDesk::pack() const {
    const Character character = bake_character(clips_in_use(bench_), bench_.project.spaces, bench_.project.name);
    const std::vector<std::byte> bytes = pack_bytes(to_pack(character));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void BenchDesk::keep(const std::string& label) {
    future_.clear();
    if (!past_.empty() && past_.back().label == label) return;
    past_.push_back({bench_, label});
    if (past_.size() > k_most_steps) past_.erase(past_.begin());
}

void BenchDesk::set_threshold(const std::string& text) {
    LintSettings settings = text.empty() ? given_ : bench_.project.lint;
    if (!text.empty()) set_lint_threshold(settings, text, "");
    keep(text.empty() ? "thresholds" : text.substr(0, text.find('=')));
    bench_.project.lint = std::move(settings);
    std::vector<std::string> unheard;
    lint_again(bench_, unheard);
}

Workbench BenchDesk::unprobed() const {
    Workbench next = bench_;
    if (next.project.probe.empty()) return next;
    next.project.probe = {};
    std::vector<std::string> unheard;
    lint_again(next, unheard);
    return next;
}

void BenchDesk::change(Workbench next, const std::string& label) {
    rank_placeholders(next);
    past_.push_back({std::exchange(bench_, std::move(next)), label});
    if (past_.size() > k_most_steps) past_.erase(past_.begin());
    future_.clear();
}

std::string BenchDesk::fix(const std::string& id) {
    Workbench next = unprobed();
    const RepairReport report = repair(next, {id.empty() ? std::vector<std::string>{} : std::vector{id}});
    Json out = Json::array();
    std::string label;
    for (const RepairAttempt& attempt : report.attempts) {
        out.push_back(attempt_json(attempt));
        if (attempt.done && label.empty()) label = attempt.text;
    }
    if (report.made() > 0)
        change(std::move(next), report.made() == 1 ? label : std::to_string(report.made()) + " repairs");
    return dumped(out);
}

void BenchDesk::take_back(const std::string& repair) {
    Workbench next = unprobed();
    std::vector<std::string> unheard;
    undo_repairs(next, repair, unheard);
    change(std::move(next), "taking back a repair");
}

void BenchDesk::leave_out(const std::string& clip, bool out) {
    Workbench next = unprobed();
    const int index = next.project.find_clip(clip);
    if (index < 0 || !next.clips[static_cast<std::size_t>(index)])
        throw Error("there is no such clip at hand", clip, "give its file again");
    ProjectClip& changed = next.project.clips[static_cast<std::size_t>(index)];
    if (changed.excluded == out) return;
    changed.excluded = changed.excluded_by_user = out;
    changed.reason = out ? "left out by hand" : "";
    const bool any = std::any_of(next.project.clips.begin(), next.project.clips.end(),
                                 [](const ProjectClip& each) { return !each.excluded; });
    if (!any) throw Error("a space needs at least one clip", clip, "");
    std::vector<std::string> unheard;
    place_and_lint(next, &bench_.project, unheard);
    change(std::move(next), (out ? "leaving out " : "taking in ") + clip);
}

void BenchDesk::probe(int grid) {
    Workbench next = bench_;
    const Character character = bake_character(clips_in_use(next), next.project.spaces, next.project.name);
    next.project.probe = surefoot::probe(character, {grid});
    std::vector<std::string> unheard;
    lint_again(next, unheard);
    rank_placeholders(next);
    bench_ = std::move(next);
}

bool BenchDesk::move(std::vector<Step>& from, std::vector<Step>& to) {
    if (from.empty()) return false;
    Step step = std::move(from.back());
    from.pop_back();
    to.push_back({std::exchange(bench_, std::move(step.bench)), std::move(step.label)});
    return true;
}

bool BenchDesk::undo() { return move(past_, future_); }
bool BenchDesk::redo() { return move(future_, past_); }

std::string BenchDesk::heat() const {
    Json out = Json::array();
    for (const ProbeSpace& space : bench_.project.probe.spaces)
        for (const Heat& heat : heats()) {
            Json cells = Json::array();
            for (const ProbeCell& cell : space.cells)
                cells.push_back({{"at", cell.at},
                                 {"value", is_measured(cell, heat) ? Json(heat.badness(cell)) : Json(nullptr)},
                                 {"text", describe_cell(space, cell)}});
            Json steps = Json::array();
            for (const ProbeAxis& axis : space.axes)
                steps.push_back(axis.points > 1 ? (axis.high - axis.low) / static_cast<float>(axis.points - 1) : 0);
            out.push_back({{"space", space.name},
                           {"title", heat.title},
                           {"unit", heat.unit},
                           {"least", heat.least},
                           {"full", full_scale(heat, space)},
                           {"decimals", heat.decimals},
                           {"scale", heat_scale()},
                           {"steps", std::move(steps)},
                           {"cells", std::move(cells)}});
        }
    return dumped(out);
}

Files BenchDesk::files(bool all) const {
    const auto is_new = [&](const ProjectClip& clip) {
        return all || !saved_.find(clip.name) || saved_.find(clip.name) != bench_.find(clip.name);
    };
    Files files;
    give_project(bench_, {true, false, failed_, warnings_}, is_new,
                 [&](const std::string& file, const std::string& bytes) { files[file] = bytes; });
    return files;
}

std::vector<std::string> BenchDesk::gone() const {
    std::set<std::string> wanted;
    for (const ProjectClip& clip : bench_.project.clips) wanted.insert(clip.file);
    std::vector<std::string> gone;
    for (const ProjectClip& clip : saved_.project.clips)
        if (!clip.file.empty() && !wanted.count(clip.file)) gone.push_back(clip.file);
    return gone;
}

void BenchDesk::saved() { saved_ = bench_; }

}  // namespace surefoot::wasm
