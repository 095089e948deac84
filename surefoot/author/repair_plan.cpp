#include <surefoot/author/lint_context.h>
#include <surefoot/author/place.h>
#include <surefoot/author/repair_planner.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

/// A clip that drifts aside where no axis of its space knows it takes its feet elsewhere than the root goes.
void straighten_travel(const ProjectSpace& space, const ClipFacts& facts, std::map<std::string, double>& path) {
    constexpr float k_drift = 0.2f;  // of the travel; what drifts more is meant to
    const auto has = [&](const char* name) {
        return std::any_of(space.space.axes.begin(), space.space.axes.end(),
                           [&](const Axis& axis) { return axis.name == name; });
    };
    const float forward = std::fabs(facts.forward), lateral = std::fabs(facts.lateral);
    if (has("speed") && !has("lateral") && lateral < k_drift * forward) path["lateral_mps"] = 0;
    if (has("lateral") && !has("speed") && !has("forward") && forward < k_drift * lateral) path["forward_mps"] = 0;
}

/// The clip brought onto the axis takes the place of the one beside it.
void plan_straightening(const Workbench& bench, const ProjectSpace& space, const Finding& finding,
                        std::vector<RepairPlan>& plans) {
    if (!finding.fix || finding.fix->target.size() != space.space.axes.size() || finding.clips.empty()) return;
    const BenchClip* clip = bench.find(finding.clips.front());
    if (!clip) return;
    std::map<std::string, double> path;
    for (std::size_t k = 0; k < space.space.axes.size(); ++k) {
        const std::string& axis = space.space.axes[k].name;
        const double aligned = static_cast<double>(finding.fix->target[k]);
        if (std::fabs(aligned - static_cast<double>(finding.at[k])) < 1e-6) continue;
        if (axis == "turn") path["turn_deg_s"] = aligned;
        if (axis == "lateral") path["lateral_mps"] = aligned;
        if (axis == "forward" || axis == "speed") path["forward_mps"] = aligned;
        if (axis == "speed") path["lateral_mps"] = 0;
    }
    // Where the clip already stands as it should, it is the turn that no axis knows.
    if (path.empty()) path["turn_deg_s"] = 0;
    const std::string& from = finding.clips.front();
    straighten_travel(space, bench.project.clips[static_cast<std::size_t>(bench.project.find_clip(from))].facts, path);
    Planner planner(bench);
    const std::string made = planner.make("steer", {from}, path);
    planner.expect(space.space.axes, finding.fix->target);
    planner.exclude(from, fmt::format("\"{}\" is the same, brought onto the axis", made));
    plans.push_back(planner.done(fmt::format("\"{}\" straightened, as \"{}\"", from, made)));
}

/// An edge along an axis, past a sample on it by a hair: its ends are brought onto the axis.
void plan_ends_onto_axis(const Workbench& bench, const ProjectSpace& space, const Finding& finding,
                         std::vector<RepairPlan>& plans) {
    constexpr double k_beside = 5;  // [%] the paper's tau_chi
    const PercentSpace percent(space);
    Planner planner(bench);
    std::string names;
    for (int i = 0; i < percent.count(); ++i) {
        const ProjectClip& clip =
            bench.project.clips[static_cast<std::size_t>(space.clips[static_cast<std::size_t>(i)])];
        if (std::find(finding.clips.begin(), finding.clips.end(), clip.name) == finding.clips.end()) continue;
        std::map<std::string, double> path;
        std::vector<float> place;
        for (int k = 0; k < percent.dimensions(); ++k) {
            const std::string& axis = space.space.axes[static_cast<std::size_t>(k)].name;
            const double off = std::fabs(percent.at(i, k));
            place.push_back(
                off < k_beside ? 0.0f : space.space.samples[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]);
            if (off == 0 || off >= k_beside) continue;
            if (axis == "turn") path["turn_deg_s"] = 0;
            if (axis == "lateral" || axis == "speed") path["lateral_mps"] = 0;
            if (axis == "forward" || axis == "speed") path["forward_mps"] = 0;
        }
        if (path.empty()) continue;
        const std::string made = planner.make("steer", {clip.name}, path);
        planner.expect(space.space.axes, place);
        planner.exclude(clip.name, fmt::format("\"{}\" is the same, brought onto the axis", made));
        names += (names.empty() ? "\"" : " and \"") + clip.name + "\"";
    }
    if (!names.empty()) plans.push_back(planner.done(names + " brought onto the axis that they nearly lie on"));
}

/// Feet that slide in the clip itself are held to the ground.
void plan_planting(const Workbench& bench, const Finding& finding, std::vector<RepairPlan>& plans) {
    if (finding.clips.size() != 1) return;
    Planner planner(bench);
    const std::string& from = finding.clips.front();
    const std::string made = planner.make("plant", {from}, {});
    planner.exclude(from, fmt::format("\"{}\" is the same with its standing feet held to the ground", made));
    plans.push_back(planner.done(fmt::format("the feet of \"{}\" held to the ground, as \"{}\"", from, made)));
}

/// How far a clip's poses are from those of the others it would be blended with.
double strangeness(const Workbench& bench, const ProjectSpace& space, const std::string& name) {
    const BenchClip* own = bench.find(name);
    double sum = 0;
    int count = 0;
    for (const int c : space.clips) {
        const BenchClip* other = bench.clips[static_cast<std::size_t>(c)].get();
        if (!own || !other || own == other) continue;
        const float apart = pose_distance(own->poses, other->poses);
        if (std::isfinite(apart)) sum += static_cast<double>(apart), ++count;
    }
    return count > 0 ? sum / count : 0;
}

/// One of two is left out: the one that crowds several others, then what lies off the axes, then one whose feet were
/// not held before one with held feet, a made clip before a recorded one, one from another skeleton before one that
/// needed no retargeting, then the one whose poses are farther from the others'.
void plan_keeping_one(const Workbench& bench, const ProjectSpace& space, const Finding& finding,
                      std::vector<RepairPlan>& plans) {
    if (finding.clips.size() != 2) return;
    std::string keep = finding.clips[0], drop = finding.clips[1];
    const auto made = [&](const std::string& name) {
        const int index = bench.project.find_clip(name);
        return index >= 0 && bench.project.clips[static_cast<std::size_t>(index)].made();
    };
    const auto held = [&](const std::string& name) {
        return std::any_of(
            bench.project.repairs.begin(), bench.project.repairs.end(), [&](const ProjectRepair& repair) {
                return std::any_of(repair.steps.begin(), repair.steps.end(),
                                   [&](const RepairStep& step) { return step.kind == "plant" && step.makes == name; });
            });
    };
    const auto was_retargeted = [&](const std::string& name) {
        const int index = bench.project.find_clip(name);
        return index >= 0 && bench.project.clips[static_cast<std::size_t>(index)].retargeted;
    };
    // The main directions are worth more than what lies between them.
    const auto off_axis = [&](const std::string& name) {
        const PercentSpace percent(space);
        double least = 100;
        for (int i = 0; i < percent.count(); ++i)
            if (bench.project.clips[static_cast<std::size_t>(space.clips[static_cast<std::size_t>(i)])].name == name)
                for (int k = 0; percent.dimensions() > 1 && k < percent.dimensions(); ++k)
                    least = std::min(least, std::fabs(percent.at(i, k)));
        return least;
    };
    // Leaving out the one in the middle of a crowd spares the others.
    const auto crowded = [&](const std::string& name) {
        return std::count_if(bench.project.findings.begin(), bench.project.findings.end(), [&](const Finding& other) {
            return other.rule == finding.rule && other.space == finding.space &&
                   std::find(other.clips.begin(), other.clips.end(), name) != other.clips.end();
        });
    };
    const auto more_crowded = crowded(keep) - crowded(drop);
    constexpr double k_matters = 1.5;  // [%]
    const double nearer = off_axis(keep) - off_axis(drop);
    const bool stranger = strangeness(bench, space, keep) > strangeness(bench, space, drop) + 1e-4;
    if (std::abs(more_crowded) > 1                     ? more_crowded > 0
        : std::fabs(nearer) > k_matters                ? nearer > 0
        : held(keep) != held(drop)                     ? held(drop)
        : made(keep) != made(drop)                     ? made(keep)
        : was_retargeted(keep) != was_retargeted(drop) ? was_retargeted(keep)
                                                       : stranger)
        std::swap(keep, drop);
    for (int turn = 0; turn < 2; ++turn, std::swap(keep, drop)) {
        Planner planner(bench);
        planner.exclude(drop,
                        finding.rule == "dissimilar-neighbours"
                            ? fmt::format("it moves in another style than \"{}\" and the rest of the space: for "
                                          "a state of its own",
                                          keep)
                            : fmt::format("it stands beside \"{}\", whose poses fit the other clips better", keep));
        plans.push_back(planner.done(fmt::format("\"{}\" kept and \"{}\" left out", keep, drop)));
    }
}

/// The other diagonal of the two triangles at an edge.
void plan_flip(const Workbench& bench, const ProjectSpace& space, const std::string& a, const std::string& b,
               std::vector<RepairPlan>& plans) {
    if (space.space.dimensions() != 2) return;
    const auto name = [&](std::int32_t sample) {
        return bench.project.clips[static_cast<std::size_t>(space.clips[static_cast<std::size_t>(sample)])].name;
    };
    std::vector<std::string> corners;
    for (const Simplex& simplex : space.space.simplices) {
        bool has_a = false, has_b = false;
        std::string third;
        for (int k = 0; k < 3 && simplex[static_cast<std::size_t>(k)] >= 0; ++k) {
            const std::string corner = name(simplex[static_cast<std::size_t>(k)]);
            has_a |= corner == a, has_b |= corner == b;
            if (corner != a && corner != b) third = corner;
        }
        if (has_a && has_b && !third.empty()) corners.push_back(third);
    }
    if (corners.size() != 2) return;
    std::sort(corners.begin(), corners.end());
    Planner planner(bench);
    planner.lock(space.name, corners[0], corners[1]);
    plans.push_back(planner.done(
        fmt::format("\"{}\" and \"{}\" joined in place of \"{}\" and \"{}\"", corners[0], corners[1], a, b)));
}

/// Crouching among upright clips, or upright among crouching ones: what most of the space does stays.
void plan_posture(const Workbench& bench, const ProjectSpace& space, const Finding& finding,
                  std::vector<RepairPlan>& plans) {
    constexpr float k_other_posture = 0.12f;  // of the hips' height
    std::vector<float> heights;
    for (const int c : space.clips)
        heights.push_back(bench.project.clips[static_cast<std::size_t>(c)].facts.hip_height);
    std::nth_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2), heights.end());
    const float usual = heights[heights.size() / 2];
    for (const std::string& name : finding.clips) {
        const int index = bench.project.find_clip(name);
        if (index < 0) continue;
        const float own = bench.project.clips[static_cast<std::size_t>(index)].facts.hip_height;
        if (std::fabs(own - usual) <= k_other_posture * usual) continue;
        Planner planner(bench);
        planner.exclude(name,
                        fmt::format("its hips are {:.2f} m up, those of the other clips {:.2f} m: a posture for a "
                                    "space of its own",
                                    own, usual));
        plans.push_back(planner.done(fmt::format("\"{}\" left out for its posture", name)));
    }
}

void plan_leaving_out(const Workbench& bench, const Finding& finding, const std::string& reason,
                      std::vector<RepairPlan>& plans) {
    for (const std::string& name : finding.clips) {
        Planner planner(bench);
        planner.exclude(name, reason);
        plans.push_back(planner.done(fmt::format("\"{}\" left out", name)));
    }
}

}  // namespace

std::vector<RepairPlan> repair_plans(const Workbench& bench, const Finding& finding) {
    std::vector<RepairPlan> plans;
    if (finding.rule == "phase-mismatch") {
        plan_leaving_out(bench, finding, "its foot strikes were not found, so it cannot be kept in step", plans);
        return plans;
    }
    if (finding.rule == "skating-clip" || finding.rule == "root-disagrees") plan_planting(bench, finding, plans);
    const ProjectSpace* space = bench.project.find_space(finding.space);
    if (!space) return plans;
    const bool edge = finding.clips.size() == 2;
    if (finding.rule == "degenerate-space") plan_second_dimension(bench, *space, plans);
    if (finding.rule == "acute-triangle" && finding.clips.size() == 3)
        for (std::size_t k = 0; k < 3; ++k)
            plan_flip(bench, *space, finding.clips[k], finding.clips[(k + 1) % 3], plans);
    if (edge && finding.rule == "crossing-axis") plan_ends_onto_axis(bench, *space, finding, plans);
    if (finding.rule == "misaligned") plan_straightening(bench, *space, finding, plans);
    if (finding.rule == "crossing-axis" || finding.rule == "missing-axis-end" || finding.rule == "missing-idle" ||
        finding.rule == "acute-triangle" || finding.rule == "uncovered" || finding.rule == "opposite-directions")
        if (finding.fix && !finding.fix->target.empty()) plan_clip_at(bench, *space, finding, plans);
    if (finding.rule == "too-close" || finding.rule == "duplicate") {
        plan_posture(bench, *space, finding, plans);
        plan_keeping_one(bench, *space, finding, plans);
    }
    if (edge && (finding.rule == "crossing-axis" || finding.rule == "opposite-directions" ||
                 finding.rule == "dissimilar-neighbours"))
        plan_flip(bench, *space, finding.clips[0], finding.clips[1], plans);
    if (finding.rule == "dissimilar-neighbours") plan_posture(bench, *space, finding, plans);
    // Where nothing else helps against an error, one of the two goes.
    if (edge && finding.severity == Severity::error &&
        (finding.rule == "crossing-axis" || finding.rule == "opposite-directions"))
        plan_keeping_one(bench, *space, finding, plans);
    return plans;
}

}  // namespace surefoot
