#include <surefoot/analysis/measure.h>
#include <surefoot/author/probe_forecast.h>
#include <surefoot/author/rank.h>
#include <surefoot/host/parallel.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace surefoot {
namespace {

constexpr double k_error_weight = 2;  // a new clip brings new edges, and what those lack is asked for in its turn

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

long percent_mended(const Placeholder& placeholder) { return std::lround(100 * placeholder.probe_gain); }

bool opens_dimension(const Placeholder& placeholder) {
    return placeholder.rule == "degenerate-space" && placeholder.worth > 0;
}

}  // namespace

double findings_weight(const Project& project, double error) {
    double sum = 0;
    for (const Finding& finding : project.findings)
        sum += finding.severity == Severity::error     ? error
               : finding.rule == "degenerate-space"    ? 10
               : finding.severity == Severity::warning ? 1
                                                       : 0.05;
    return sum;
}

void rank_placeholders(Workbench& bench) {
    const Project& project = bench.project;
    const double findings = findings_weight(project, k_error_weight), wrong = forecast_error(project, project);
    std::vector<Placeholder> ranked = project.placeholders;
    parallel_for(ranked.size(), [&](std::size_t i) {
        Workbench trial = bench;
        std::vector<std::string> unheard;
        trial.add(imagined(ranked[i], trial.project), nullptr);
        if (const Placeholder* other = mirror_of(project, project.placeholders[i]))
            trial.add(imagined(*other, trial.project), nullptr);
        place_and_lint(trial, &project, unheard);
        ranked[i].worth = static_cast<float>(std::max(0.0, findings - findings_weight(trial.project, k_error_weight)));
        const double mended = wrong > 0 ? 1 - forecast_error(project, trial.project) / wrong : 0;
        ranked[i].probe_gain = static_cast<float>(std::max(0.0, mended));
    });
    bench.project.placeholders = std::move(ranked);
}

bool helps_more(const Placeholder& a, const Placeholder& b) {
    // A probe cannot tell what turning would be like where nothing turns yet.
    const bool opens_a = opens_dimension(a), opens_b = opens_dimension(b);
    if (opens_a != opens_b) return opens_a;
    const long mends_a = percent_mended(a), mends_b = percent_mended(b);
    return mends_a != mends_b ? mends_a > mends_b : a.worth > b.worth;
}

const Placeholder* most_wanted(const Project& project) {
    const std::vector<Placeholder>& all = project.placeholders;
    const auto best = std::min_element(all.begin(), all.end(), helps_more);
    return best != all.end() && helps_more(*best, {}) ? &*best : nullptr;
}

std::string describe_worth(const Placeholder& placeholder) {
    const long percent = percent_mended(placeholder), warnings = std::lround(placeholder.worth);
    std::string text;
    if (percent > 0) text = fmt::format("would mend {} % of what the probe found wrong", percent);
    if (warnings > 0)
        text += fmt::format("{} settle as much as {} warning{}", text.empty() ? "would" : " and", warnings,
                            warnings == 1 ? "" : "s");
    if (text.empty() && placeholder.worth > 0) text = "a small gain, less than settling one warning";
    return text;
}

}  // namespace surefoot
