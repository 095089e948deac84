#include <surefoot/author/lint_context.h>
#include <surefoot/author/make_clip.h>
#include <surefoot/author/place.h>
#include <surefoot/author/rank.h>
#include <surefoot/author/repair.h>
#include <surefoot/author/repair_plan.h>
#include <surefoot/base/error.h>
#include <surefoot/base/hash.h>
#include <surefoot/space/lock_edge.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace surefoot {
namespace {

constexpr float k_more_skate = 0.03f;  // [m/s] that a made clip may slide more than its worst source
constexpr double k_off_target = 5;     // [%] of an axis' range by which a made clip may miss its place
constexpr double k_error_weight = 50;  // an error is worth any number of warnings
constexpr float k_held_skate = 0.03f;  // [m/s] of a clip: feet that slide more are held ...
constexpr float k_held_gain = 0.6f;    // ... if what is left of it is this share at most

ProjectClip made_clip(const ProjectRepair& repair, const RepairStep& step, const Workbench& bench,
                      const ClipFacts& facts) {
    ProjectClip clip;
    clip.name = step.makes;
    clip.file = "clips/" + step.makes + ".glb";
    clip.facts = facts;
    clip.repair = repair.id;
    // The whole story: what was done to the first source, then this.
    const int from = bench.project.find_clip(step.clips.front());
    if (from >= 0) {
        const ProjectClip& source = bench.project.clips[static_cast<std::size_t>(from)];
        clip.provenance = source.provenance;
        clip.style = source.style;
        clip.upper_body = source.upper_body;
    }
    clip.provenance.push_back(describe_step(step));
    return clip;
}

/// One step on the bench; nothing is placed. Throws Error where it cannot be done.
void apply_step(Workbench& bench, const ProjectRepair& repair, const RepairStep& step) {
    if (makes_clip(step.kind)) {
        std::vector<const AnalyzedClip*> inputs;
        for (const std::string& name : step.clips) {
            const BenchClip* clip = bench.find(name);
            if (!clip) throw Error("the clip \"" + name + "\" is not there any more", "repair " + repair.id, "");
            inputs.push_back(&clip->clip);
        }
        if (bench.project.find_clip(step.makes) >= 0)
            throw Error("there is another clip named \"" + step.makes + "\"", "repair " + repair.id, "");
        AnalyzedClip made = make_clip(step, inputs);
        ProjectClip clip = made_clip(repair, step, bench, made.facts);
        bench.add(std::move(clip), make_bench_clip(std::move(made)));
    } else if (step.kind == "exclude") {
        const int index = step.clips.empty() ? -1 : bench.project.find_clip(step.clips.front());
        if (index < 0) throw Error("the clip to leave out is not there any more", "repair " + repair.id, "");
        ProjectClip& clip = bench.project.clips[static_cast<std::size_t>(index)];
        if (clip.excluded) return;
        clip.excluded = true;
        clip.reason = step.reason;
        if (clip.repair.empty()) clip.repair = repair.id;
    } else if (step.kind != "lock-edge") {
        throw Error("this version knows no repair \"" + step.kind + "\"", "repair " + repair.id, "");
    }
}

/// Lays the edge once its space stands.
bool lock_planned_edge(Project& project, const RepairStep& step) {
    for (ProjectSpace& space : project.spaces) {
        if (space.name != step.space) continue;
        std::int32_t ends[2] = {-1, -1};
        for (std::size_t i = 0; i < space.clips.size(); ++i)
            for (std::size_t e = 0; e < 2; ++e)
                if (project.clips[static_cast<std::size_t>(space.clips[i])].name == step.clips[e])
                    ends[e] = static_cast<std::int32_t>(i);
        if (ends[0] < 0 || ends[1] < 0) return false;
        if (!lock_edge(space.space, ends[0], ends[1], space.locked_edges)) return false;
        space.locked_edges.push_back({ends[0], ends[1]});
        return true;
    }
    return false;
}

int count_at_least(const Project& project, Severity least) {
    return static_cast<int>(std::count_if(project.findings.begin(), project.findings.end(),
                                          [&](const Finding& f) { return f.severity >= least; }));
}

bool is_there(const Project& project, const Finding& finding) {
    const std::string id = fix_id(finding);
    return std::any_of(project.findings.begin(), project.findings.end(),
                       [&](const Finding& f) { return fix_id(f) == id; });
}

/// A rule that has more errors than before; empty where none has.
std::string rule_with_more_errors(const Project& before, const Project& after) {
    std::map<std::string, int> errors;
    for (const Finding& f : after.findings) errors[f.rule] += f.severity == Severity::error;
    for (const Finding& f : before.findings) errors[f.rule] -= f.severity == Severity::error;
    for (const auto& [rule, more] : errors)
        if (more > 0) return rule;
    return {};
}

std::string lost_dimension(const Project& before, const Project& after) {
    for (const ProjectSpace& space : before.spaces) {
        const ProjectSpace* now = after.find_space(space.name);
        const auto rank = [](const ProjectSpace& s) {
            int corners = 0;
            if (!s.space.simplices.empty())
                while (corners <= s.space.dimensions() && s.space.simplices[0][static_cast<std::size_t>(corners)] >= 0)
                    ++corners;
            return corners;
        };
        if (!now || rank(*now) < rank(space)) return space.name;
    }
    return {};
}

/// Of the made clips that are placed, the one that slides more than its sources do; empty where none does.
std::string sliding_clip(const Workbench& bench, const ProjectRepair& repair) {
    for (const RepairStep& step : repair.steps) {
        if (!makes_clip(step.kind)) continue;
        const int made = bench.project.find_clip(step.makes);
        if (bench.project.clips[static_cast<std::size_t>(made)].excluded) continue;  // an ingredient
        float allowed = 0;
        for (const std::string& name : step.clips) allowed = std::max(allowed, bench.find(name)->clip.facts.skate);
        const float skate = bench.find(step.makes)->clip.facts.skate;
        if (skate > allowed + k_more_skate)
            return fmt::format("\"{}\" would slide at {:.0f} cm/s, its sources at {:.0f}", step.makes, 100 * skate,
                               100 * allowed);
    }
    return {};
}

/// Of the made clips, the one that does not do what it was made for: what steps promise is in their numbers
/// ("expect_AXIS"). Empty where all do.
std::string missed_target(const Workbench& bench, const ProjectRepair& repair) {
    for (const RepairStep& step : repair.steps) {
        if (!makes_clip(step.kind)) continue;
        const int index = bench.project.find_clip(step.makes);
        const ProjectClip& clip = bench.project.clips[static_cast<std::size_t>(index)];
        for (const ProjectSpace& space : bench.project.spaces) {
            const PercentSpace percent(space);
            for (int k = 0; k < percent.dimensions(); ++k) {
                const std::string& axis = space.space.axes[static_cast<std::size_t>(k)].name;
                const auto expected = step.numbers.find("expect_" + axis);
                if (expected == step.numbers.end()) continue;
                const double is = static_cast<double>(axis_value(clip.facts, axis));
                if (std::fabs(percent.percent(is - expected->second, k)) > k_off_target)
                    return fmt::format("\"{}\" came out at {} {:.2f}, not {:.2f}", step.makes, axis, is,
                                       expected->second);
            }
        }
    }
    return {};
}

std::string next_id(const Project& project) {
    int highest = 0;
    for (const ProjectRepair& repair : project.repairs) {
        int value = 0;
        for (const char c : repair.id)
            value = c >= '0' && c <= '9' && value < 100000000 ? value * 10 + (c - '0') : value;
        highest = std::max(highest, value);
    }
    return std::to_string(highest + 1);
}

enum class Gain { fewer_findings, no_more_findings };

/// The bench with the plan carried out; `why` says why not where it does not hold what was asked.
std::optional<Workbench> try_plan(const Workbench& bench, const Finding& finding, const RepairPlan& plan,
                                  std::string& why, Gain gain = Gain::fewer_findings) {
    ProjectRepair repair{next_id(bench.project), finding.rule, finding.space, finding.clips, plan.text, plan.steps};
    Workbench trial = bench;
    std::vector<std::string> unheard;
    try {
        for (const RepairStep& step : repair.steps) apply_step(trial, repair, step);
        place_and_lint(trial, &bench.project, unheard);
        bool locked = false;
        for (const RepairStep& step : repair.steps)
            if (step.kind == "lock-edge") {
                if (!lock_planned_edge(trial.project, step)) {
                    why = "the edge cannot be laid so: it crosses a locked edge or a third clip lies on it";
                    return {};
                }
                locked = true;
            }
        if (locked) lint_again(trial, unheard);
    } catch (const Error& error) {
        why = error.problem();
        return {};
    }
    if (why = sliding_clip(trial, repair); !why.empty()) return {};
    if (why = missed_target(trial, repair); !why.empty()) return {};
    if (const std::string rule = rule_with_more_errors(bench.project, trial.project); !rule.empty()) {
        why = "it would add an error (" + rule + ")";
        return {};
    }
    if (const std::string space = lost_dimension(bench.project, trial.project); !space.empty()) {
        why = "space \"" + space + "\" would lose a dimension";
        return {};
    }
    if (is_there(trial.project, finding)) {
        why = "the finding would still be there";
        return {};
    }
    const double now = findings_weight(trial.project, k_error_weight);
    const double was = findings_weight(bench.project, k_error_weight);
    // What a space lacks shows only once it has its dimensions: opening one is judged by weight alone.
    const bool more = finding.rule != "degenerate-space" && count_at_least(trial.project, Severity::warning) >
                                                                count_at_least(bench.project, Severity::warning);
    if ((gain == Gain::fewer_findings ? now >= was : now > was) || more) {
        why = "it would bring as many findings as it mends";
        return {};
    }
    trial.project.repairs.push_back(std::move(repair));
    return trial;
}

bool selected(const RepairOptions& options, const Finding& finding) {
    if (options.only.empty()) return true;
    const std::string id = fix_id(finding);
    return std::any_of(options.only.begin(), options.only.end(),
                       [&](const std::string& only) { return only == finding.rule || only == id; });
}

/// Errors first; then what makes clips fewer, before any is straightened or mirrored in vain.
std::vector<Finding> in_order(std::vector<Finding> findings) {
    const auto rank = [](const Finding& finding) {
        if (finding.severity == Severity::error) return 0;
        int n = 1;
        for (const char* rule :
             {"duplicate", "too-close", "skating-clip", "root-disagrees", "misaligned", "degenerate-space"}) {
            if (finding.rule == rule) return n;
            ++n;
        }
        return n + (finding.severity == Severity::info);
    };
    std::stable_sort(findings.begin(), findings.end(),
                     [&](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
    return findings;
}

/// Repairs one finding where it can be. The attempt says how it went.
RepairAttempt attempt(Workbench& bench, const Finding& finding) {
    RepairAttempt result{fix_id(finding), finding, false, ""};
    const std::vector<RepairPlan> plans = repair_plans(bench, finding);
    std::string first_reason;
    for (const RepairPlan& plan : plans) {
        std::string why;
        if (std::optional<Workbench> mended = try_plan(bench, finding, plan, why)) {
            bench = std::move(*mended);
            result.done = true;
            result.text = plan.text;
            return result;
        }
        if (first_reason.empty()) first_reason = plan.text + ": " + why;
    }
    result.text = first_reason.empty()
                      ? "the clips at hand hold nothing to mend it with"
                      : "not done: " + first_reason +
                            (plans.size() > 1 ? fmt::format(" ({} other ways were tried)", plans.size() - 1) : "");
    return result;
}

/// Captured feet slide a little everywhere, less than lint minds; blended, each clip's own slip adds to the turn and
/// the skate of the blend. Made clips are left alone: what they are made of was held.
void hold_feet(Workbench& bench, const RepairOptions& options, RepairReport& report) {
    const std::vector<ProjectClip> clips = bench.project.clips;
    for (const ProjectClip& clip : clips) {
        if (clip.excluded || clip.made() || !clip.facts.cyclic || clip.facts.skate < k_held_skate) continue;
        Finding sliding;
        sliding.rule = "skating-clip", sliding.severity = Severity::info, sliding.clips = {clip.name};
        sliding.message = fmt::format("planted feet slide at {:.1f} cm/s", 100 * clip.facts.skate);
        if (!selected(options, sliding)) continue;
        for (const RepairPlan& plan : repair_plans(bench, sliding)) {
            std::string why;
            std::optional<Workbench> held = try_plan(bench, sliding, plan, why, Gain::no_more_findings);
            const BenchClip* made = held ? held->find(plan.steps.front().makes) : nullptr;
            if (!made || made->clip.facts.skate > k_held_gain * clip.facts.skate) continue;
            bench = std::move(*held);
            report.attempts.push_back({fix_id(sliding), sliding, true, plan.text});
            break;
        }
    }
}

}  // namespace

int RepairReport::made() const {
    return static_cast<int>(
        std::count_if(attempts.begin(), attempts.end(), [](const RepairAttempt& a) { return a.done; }));
}

std::string fix_id(const Finding& finding) {
    std::string key = finding.rule + "\n" + finding.space;
    for (const std::string& clip : finding.clips) key += "\n" + clip;
    // Findings about clips are known by their clips; a place may move by a hair from run to run.
    if (finding.clips.empty())
        for (const float value : finding.at) key += fmt::format("\n{:.2f}", value);
    return fmt::format("{:08x}", static_cast<std::uint32_t>(hash_bytes(key) >> 32u));
}

std::map<std::string, int> count_findings(const Project& project) {
    std::map<std::string, int> counts;
    for (const Finding& finding : project.findings)
        ++counts[std::string(severity_name(finding.severity)) + " " + finding.rule];
    return counts;
}

RepairReport repair(Workbench& bench, const RepairOptions& options) {
    RepairReport report;
    report.before = count_findings(bench.project);
    hold_feet(bench, options, report);
    std::map<std::string, RepairAttempt> refused;
    for (bool again = true; again;) {
        again = false;
        refused.clear();
        for (const Finding& finding : in_order(bench.project.findings)) {
            // Suggestions are for people to follow; what each of them would cost in clips is theirs to say.
            const bool suggestion = finding.severity == Severity::info && options.only.empty();
            if (suggestion || !selected(options, finding) || refused.count(fix_id(finding))) continue;
            RepairAttempt result = attempt(bench, finding);
            if (result.done) {
                report.attempts.push_back(std::move(result));
                again = true;
                break;
            }
            refused.emplace(result.fix_id, std::move(result));
        }
    }
    for (const Finding& finding : bench.project.findings)
        if (const auto found = refused.find(fix_id(finding)); found != refused.end())
            report.attempts.push_back(found->second);
    report.after = count_findings(bench.project);
    return report;
}

void replay_repairs(Workbench& bench, const Project& before, std::vector<std::string>& warnings) {
    for (const ProjectRepair& repair : before.repairs) {
        Workbench trial = bench;
        try {
            for (const RepairStep& step : repair.steps) apply_step(trial, repair, step);
        } catch (const Error& error) {
            warnings.push_back("repair " + repair.id + " (" + repair.text +
                               ") could not be made again: " + error.problem());
            continue;
        }
        for (const RepairStep& step : repair.steps) {  // what the user set about the made clip
            const int now = trial.project.find_clip(step.makes), old = before.find_clip(step.makes);
            if (step.makes.empty() || now < 0 || old < 0) continue;
            ProjectClip& clip = trial.project.clips[static_cast<std::size_t>(now)];
            const ProjectClip& was = before.clips[static_cast<std::size_t>(old)];
            clip.pins = was.pins;
            if (!was.excluded_by_user) continue;
            clip.excluded = clip.excluded_by_user = true;
            clip.reason = was.reason;
        }
        trial.project.repairs.push_back(repair);
        bench = std::move(trial);
    }
}

namespace {

/// Takes back what a repair did, but for the clips it made: their names go to `gone`.
void take_back(Project& project, const ProjectRepair& repair, std::set<std::string>& gone) {
    for (const RepairStep& step : repair.steps) {
        if (!step.makes.empty()) gone.insert(step.makes);
        const int index = step.clips.empty() ? -1 : project.find_clip(step.clips.front());
        if (step.kind == "exclude" && index >= 0) {
            ProjectClip& clip = project.clips[static_cast<std::size_t>(index)];
            if (clip.excluded_by_user) continue;
            clip.excluded = false;
            clip.reason.clear();
            if (clip.repair == repair.id && !clip.made()) clip.repair.clear();
        }
        if (step.kind != "lock-edge") continue;
        for (ProjectSpace& space : project.spaces)
            if (space.name == step.space)
                std::erase_if(space.locked_edges, [&](const std::array<int, 2>& edge) {
                    const auto name = [&](int end) {
                        return project.clips[static_cast<std::size_t>(space.clips[static_cast<std::size_t>(end)])].name;
                    };
                    return name(edge[0]) == step.clips[0] && name(edge[1]) == step.clips[1];
                });
    }
}

}  // namespace

std::vector<std::string> undo_repairs(Workbench& bench, const std::string& id, std::vector<std::string>& warnings) {
    Project& project = bench.project;
    if (!id.empty() && std::none_of(project.repairs.begin(), project.repairs.end(),
                                    [&](const ProjectRepair& repair) { return repair.id == id; }))
        throw Error("there is no repair \"" + id + "\" in the project", "--undo",
                    "surefoot fix PROJECT --list says which there are");
    std::set<std::string> gone;
    std::vector<std::string> undone;
    std::vector<ProjectRepair> kept;
    for (ProjectRepair& repair : project.repairs) {
        const bool builds_on = std::any_of(repair.steps.begin(), repair.steps.end(), [&](const RepairStep& step) {
            return std::any_of(step.clips.begin(), step.clips.end(),
                               [&](const std::string& clip) { return gone.count(clip) > 0; });
        });
        if (!id.empty() && repair.id != id && !builds_on) {
            kept.push_back(std::move(repair));
            continue;
        }
        take_back(project, repair, gone);
        undone.push_back(repair.id);
    }
    project.repairs = std::move(kept);
    const Project before = project;  // its spaces still name their clips by index
    std::vector<ProjectClip> clips;
    std::vector<std::shared_ptr<const BenchClip>> motions;
    for (std::size_t i = 0; i < project.clips.size(); ++i) {
        if (gone.count(project.clips[i].name)) continue;
        clips.push_back(std::move(project.clips[i]));
        motions.push_back(std::move(bench.clips[i]));
    }
    project.clips = std::move(clips);
    bench.clips = std::move(motions);
    place_and_lint(bench, &before, warnings);
    return undone;
}

}  // namespace surefoot
