#include <surefoot/analysis/measure.h>
#include <surefoot/author/rank.h>
#include <surefoot/host/parallel.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace surefoot {
namespace {

std::optional<float> asked(const Placeholder& placeholder, std::string_view axis) {
    for (std::size_t k = 0; k < placeholder.axes.size() && k < placeholder.target.size(); ++k)
        if (placeholder.axes[k] == axis) return placeholder.target[k];
    return {};
}

/// Such a clip as a good one would be: it steps, loops and does not slide.
ProjectClip imagined(const Placeholder& placeholder, const Project& project) {
    ProjectClip clip;
    clip.name = "(" + placeholder.text + ")";
    while (project.find_clip(clip.name) >= 0) clip.name += "'";
    clip.file = "clips/none.glb";
    ClipFacts& facts = clip.facts;
    for (const ProjectClip& other : project.clips)
        if (!other.excluded && other.facts.cadence > 0) {
            facts = other.facts;  // its size and rhythm
            break;
        }
    facts.name = clip.name;
    facts.cyclic = true;
    facts.skate = facts.loop_error = facts.seam_speed = 0;
    facts.root_disagreement_speed = facts.root_disagreement_turn = 0;
    const auto speed = asked(placeholder, "speed"), forward = asked(placeholder, "forward");
    set_travel(facts, speed ? *speed : forward.value_or(0), asked(placeholder, "lateral").value_or(0));
    facts.turn = asked(placeholder, "turn").value_or(0);
    facts.slope = asked(placeholder, "slope").value_or(0);
    return clip;
}

/// The placeholder that the mirror image of this one's clip would fill.
const Placeholder* mirror_of(const Project& project, const Placeholder& placeholder) {
    for (const Placeholder& other : project.placeholders) {
        if (&other == &placeholder || other.space != placeholder.space || other.axes != placeholder.axes) continue;
        bool same = true, sided = false;
        for (std::size_t k = 0; k < other.target.size(); ++k) {
            const bool has_sides = other.axes[k] == "turn" || other.axes[k] == "lateral";
            const float image = has_sides ? -placeholder.target[k] : placeholder.target[k];
            sided |= has_sides && placeholder.target[k] != 0;
            same &= std::fabs(other.target[k] - image) < 1e-3f + 0.05f * std::fabs(image);
        }
        if (same && sided) return &other;
    }
    return nullptr;
}

}  // namespace

double findings_weight(const Project& project) {
    double sum = 0;
    for (const Finding& finding : project.findings)
        sum += finding.severity == Severity::error     ? 2
               : finding.rule == "degenerate-space"    ? 10
               : finding.severity == Severity::warning ? 1
                                                       : 0.05;
    return sum;
}

void rank_placeholders(Workbench& bench, const BenchScore& score) {
    const BenchScore by = score ? score : [](const Workbench& b) { return findings_weight(b.project); };
    const double before = by(bench);
    std::vector<Placeholder>& placeholders = bench.project.placeholders;
    std::vector<double> worth(placeholders.size(), 0.0);
    parallel_for(placeholders.size(), [&](std::size_t i) {
        Workbench trial = bench;
        std::vector<std::string> unheard;
        trial.add(imagined(placeholders[i], trial.project), nullptr);
        if (const Placeholder* other = mirror_of(bench.project, placeholders[i]))
            trial.add(imagined(*other, trial.project), nullptr);
        place_and_lint(trial, &bench.project, unheard);
        worth[i] = before - by(trial);
    });
    for (std::size_t i = 0; i < placeholders.size(); ++i)
        placeholders[i].worth = static_cast<float>(std::max(0.0, worth[i]));
}

const Placeholder* most_wanted(const Project& project) {
    const Placeholder* best = nullptr;
    for (const Placeholder& placeholder : project.placeholders)
        if (placeholder.worth > (best ? best->worth : 0.0f)) best = &placeholder;
    return best;
}

std::string describe_worth(const Placeholder& placeholder) {
    if (!(placeholder.worth > 0)) return {};
    const long warnings = std::lround(placeholder.worth);
    if (placeholder.worth < 1) return "a small gain, less than settling one warning";
    return fmt::format("would settle as much as {} warning{}", warnings, warnings == 1 ? "" : "s");
}

}  // namespace surefoot
