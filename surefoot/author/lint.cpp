#include <surefoot/author/lint_context.h>
#include <surefoot/author/place.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

namespace surefoot {

const std::vector<LintRule>& lint_rules() {
    // Defaults: DESIGN §6; tau_chi = 5 and tau_d = 8 are those of Delicado & Pelechano, §3.2.1 and §3.2.4.
    static const std::vector<LintRule> rules{
        {"degenerate-space",
         "Too few directions",
         Severity::error,
         {},
         "The clips lie in one place or on one line, so the character cannot be steered in the other direction."},
        {"missing-idle",
         "No idle",
         Severity::warning,
         {{"distance", 5, "%", "how far from the origin an idle may be"}},
         "With no clip that stands still the character cannot stop: it walks on the spot."},
        {"crossing-axis",
         "Crossing an axis",
         Severity::error,
         {{"distance", 5, "%", "how far from the axis both ends of an edge must be"}},
         "An edge blends opposite clips across an axis: in the middle the feet shuffle or cross."},
        {"opposite-directions",
         "Opposite directions",
         Severity::error,
         {{"angle", 120, "deg", "difference of travel directions"}},
         "Clips that travel apart are blended: their steps cancel and the feet slide."},
        {"missing-axis-end",
         "Missing axis end",
         Severity::warning,
         {{"distance", 5, "%", "how far from the end a clip may be"}},
         "No clip marks the end of an axis, so the main directions are mixed from slanted clips."},
        {"acute-triangle",
         "Acute triangle",
         Severity::warning,
         {{"angle", 15, "deg", "smallest angle that is still good"}},
         "A small move of the stick switches the blend from one clip to another: the character twitches."},
        {"misaligned",
         "Misaligned",
         Severity::warning,
         {{"near", 0.5, "%", "closer than this counts as on the axis"},
          {"far", 5, "%", "farther is no accident"},
          {"turn", 5, "deg/s", "of a clip in a space that knows no turn"}},
         "A clip meant to go straight does not quite: placed on the axis by hand it would drift off course."},
        {"too-close",
         "Too close",
         Severity::warning,
         {{"distance", 8, "%", "two samples nearer than this"},
          {"conflict", 15, "cm", "mean pose distance from which two close clips conflict"}},
         "Two clips do nearly the same: where they differ in style, the character flickers between the two."},
        {"duplicate",
         "Duplicate",
         Severity::warning,
         {{"distance", 0.5, "%", "how near"}, {"pose", 2, "cm", "mean pose distance"}},
         "The same clip twice: it costs memory and adds nothing."},
        {"uncovered",
         "Uncovered area",
         Severity::info,
         {{"distance", 10, "%", "how far from the nearest clips"}},
         "Asked for this motion, the character does the nearest thing it can."},
        {"dissimilar-neighbours",
         "Dissimilar neighbours",
         Severity::warning,
         {{"pose", 25, "cm", "mean pose distance along an edge"}},
         "Neighbouring clips move so differently that the poses between them look like neither."},
        {"phase-mismatch",
         "Steps that match no others",
         Severity::error,
         {},
         "A clip that moves has no foot strikes, or not left and right in turn: it plays out of step, and legs cross."},
        {"loop-pop",
         "Loop pops",
         Severity::warning,
         {{"seam", 3, "cm", "jump of a joint"}, {"speed", 30, "cm/s", "jump of a joint's speed"}},
         "Each time the clip starts over, the body jumps."},
        {"skating-clip",
         "Skating clip",
         Severity::warning,
         {{"skate", 10, "cm/s", "mean speed of planted feet"}},
         "The feet slide in the clip itself, before any blending."},
        {"root-disagrees",
         "Root against feet",
         Severity::warning,
         {{"speed", 10, "%", "of the clip's speed"}, {"turn", 10, "deg/s", ""}},
         "The root moves at another speed than the planted feet say: the feet slide by the difference."},
        {"unit-suspect",
         "Unlikely size",
         Severity::warning,
         {{"low", 0.3, "m", "lowest hips"}, {"high", 2, "m", "highest hips"}},
         "The character's size is not a person's: speeds and steps will be off by the same factor."},
        {"probe-speed",
         "Blend goes at another speed",
         Severity::warning,
         {{"error", 10, "%", "of the speed asked for (0.5 m/s at least), beside what the clips do themselves"}},
         "Asked for a speed, the feet walk at another one: they slide over the ground by the difference."},
        {"probe-turn",
         "Blend turns otherwise",
         Severity::warning,
         {{"error", 10, "deg/s", "against what was asked, beside what the clips do themselves"}},
         "The body turns while the feet do not follow: they twist on the ground."},
        {"probe-skate",
         "Blend skates",
         Severity::warning,
         {{"ratio", 1.5, "times", "the skate of the clips that are blended"},
          {"more", 3, "cm/s", "than those, at least"}},
         "Between the clips planted feet slide, though in each clip alone they stand."},
        {"probe-knee",
         "Blend jerks a knee",
         Severity::warning,
         {{"ratio", 2, "times", "the clips' own peak of angular acceleration"},
          {"more", 2000, "deg/s^2", "than those, at least"}},
         "A knee snaps or trembles in the blend, though in each clip alone it moves smoothly."},
        {"probe-legs-cross",
         "Legs pass through each other",
         Severity::warning,
         {{"depth", 1, "cm", "how deep, and how much closer than in any of the clips"}},
         "The shanks or feet go through each other in the blend."},
    };
    return rules;
}

SideWords side_words(std::string_view axis) {
    if (axis == "turn") return {"turning right", "turning left", "going straight"};
    if (axis == "speed" || axis == "forward") return {"going backward", "going forward", "staying on the spot"};
    if (axis == "lateral") return {"stepping right", "stepping left", "going straight"};
    if (axis == "slope") return {"going downhill", "going uphill", "level ground"};
    return {"below zero", "above zero", "zero"};
}

std::string describe_clip(std::span<const Axis> axes, std::span<const float> values) {
    bool still = true;
    for (std::size_t k = 0; k < axes.size(); ++k)
        for (const char* motion : {"speed", "forward", "lateral", "turn"})
            still &= axes[k].name != motion || values[k] == 0;
    if (still) return "a clip that stands still";
    const std::string place = describe_place(axes, values);
    return (place[0] >= '0' && place[0] <= '9' ? "a clip that goes " : "a clip ") + place;
}

PercentSpace::PercentSpace(const ProjectSpace& space) : space_(&space) {
    for (int k = 0; k < dimensions(); ++k) {
        const Axis& axis = space.space.axes[k];
        range_[k] = std::max(axis.high, 0.0f) - static_cast<double>(std::min(axis.low, 0.0f));
    }
}

double PercentSpace::distance(const SpacePoint& a, const SpacePoint& b) const {
    double square = 0;
    for (int k = 0; k < dimensions(); ++k) {
        const double delta = percent(static_cast<double>(a[k]) - b[k], k);
        square += delta * delta;
    }
    return std::sqrt(square);
}

int PercentSpace::axis(std::string_view name) const {
    for (int k = 0; k < dimensions(); ++k)
        if (space_->space.axes[k].name == name) return k;
    return -1;
}

std::vector<std::array<int, 2>> PercentSpace::edges() const {
    std::set<std::array<int, 2>> edges;
    for (const Simplex& simplex : space_->space.simplices)
        for (int i = 0; i <= k_max_dimensions && simplex[i] >= 0; ++i)
            for (int j = 0; j < i; ++j)
                edges.insert({std::min(simplex[i], simplex[j]), std::max(simplex[i], simplex[j])});
    return {edges.begin(), edges.end()};
}

const LintRule* find_lint_rule(std::string_view id) noexcept {
    for (const LintRule& rule : lint_rules())
        if (rule.id == id) return &rule;
    return nullptr;
}

const LintRule& LintContext::rule(std::string_view id) const {
    const LintRule* found = find_lint_rule(id);
    assert(found != nullptr);
    return *found;
}

bool LintContext::enabled(const char* id) const {
    const auto found = project_.lint.find(id);
    return found == project_.lint.end() || found->second.enabled.value_or(true);
}

double LintContext::threshold(const char* id, const char* name) const {
    if (const auto found = project_.lint.find(id); found != project_.lint.end())
        if (const auto set = found->second.thresholds.find(name); set != found->second.thresholds.end())
            return set->second;
    for (const RuleThreshold& threshold : rule(id).thresholds)
        if (std::string_view(threshold.name) == name) return threshold.value;
    return 0;
}

std::vector<float> LintContext::place(const ProjectSpace& space, const SpacePoint& point) const {
    return {point.begin(), point.begin() + space.space.dimensions()};
}

SpacePoint LintContext::point(std::span<const float> values) {
    SpacePoint point{};
    std::copy(values.begin(), values.end(), point.begin());
    return point;
}

std::vector<float> LintContext::place(const ProjectSpace& space, int sample) const {
    return place(space, space.space.samples[sample]);
}

Finding LintContext::pair_finding(const char* rule, const ProjectSpace& space, int a, int b) const {
    Finding finding;
    finding.rule = rule;
    finding.space = space.name;
    finding.clips = {name(space, a), name(space, b)};
    SpacePoint middle{};
    for (int k = 0; k < space.space.dimensions(); ++k)
        middle[k] = 0.5f * (space.space.samples[a][k] + space.space.samples[b][k]);
    finding.at = place(space, middle);
    return finding;
}

std::optional<float> LintContext::apart(int a, int b) const {
    if (static_cast<std::size_t>(std::max(a, b)) >= poses_.size()) return {};
    const float metres = pose_distance(poses_[a], poses_[b]);
    if (!std::isfinite(metres)) return {};
    return metres;
}

void LintContext::add(Finding finding, std::optional<Severity> severity) {
    if (!enabled(finding.rule.c_str())) return;
    finding.severity = severity.value_or(rule(finding.rule).severity);
    if (const auto found = project_.lint.find(finding.rule); found != project_.lint.end())
        finding.severity = found->second.severity.value_or(finding.severity);
    result.findings.push_back(std::move(finding));
}

bool LintContext::asked_for(const char* rule, const ProjectSpace& space, const SpacePoint& point) const {
    const PercentSpace percent(space);
    const double near = threshold("too-close", "distance");
    return std::any_of(result.findings.begin(), result.findings.end(), [&](const Finding& finding) {
        if (finding.rule != rule || finding.space != space.name || !finding.fix) return false;
        if (finding.fix->target.size() != space.space.axes.size()) return false;
        SpacePoint target = this->point(finding.fix->target);  // which may lie beyond the axes' limits
        for (int k = 0; k < space.space.dimensions(); ++k)
            target[k] = std::min(std::max(target[k], space.space.axes[k].low), space.space.axes[k].high);
        return percent.distance(target, point) < near;
    });
}

bool LintContext::near_placeholder(const ProjectSpace& space, const Placeholder& placeholder) const {
    const PercentSpace percent(space);
    const double near = threshold("too-close", "distance");
    for (const Placeholder& other : result.placeholders) {
        if (other.space != placeholder.space || other.axes != placeholder.axes) continue;
        double square = 0;
        for (std::size_t k = 0; k < other.target.size(); ++k) {
            const double delta = static_cast<double>(other.target[k]) - placeholder.target[k];
            const double share =
                static_cast<int>(k) < percent.dimensions() ? percent.percent(delta, static_cast<int>(k)) : delta;
            square += share * share;
        }
        if (std::sqrt(square) < near) return true;
    }
    return false;
}

namespace {

std::vector<Axis> with_extra(const ProjectSpace& space, const std::vector<std::string>& extra_axes) {
    std::vector<Axis> axes = space.space.axes;
    for (const std::string& extra : extra_axes) axes.push_back(make_axis(extra));
    return axes;
}

}  // namespace

void LintContext::ask_for(const ProjectSpace& space, Finding finding, PlaceholderKind kind,
                          const std::vector<float>& target, const std::vector<std::string>& extra_axes,
                          std::optional<Severity> severity) {
    const std::string text = describe_clip(with_extra(space, extra_axes), target);
    finding.space = space.name;
    finding.fix = Fix{"add-clip", "add " + text, space.name, target, {}};
    add_placeholder(space, finding.rule.c_str(), kind, target, extra_axes, text);
    add(std::move(finding), severity);
}

void LintContext::add_placeholder(const ProjectSpace& space, const char* rule, PlaceholderKind kind,
                                  const std::vector<float>& target, const std::vector<std::string>& extra_axes,
                                  const std::string& text) {
    if (!enabled(rule)) return;
    Placeholder placeholder{space.name, kind, {}, target, rule, text};
    for (const Axis& axis : with_extra(space, extra_axes)) placeholder.axes.push_back(axis.name);
    if (!near_placeholder(space, placeholder)) result.placeholders.push_back(std::move(placeholder));
}

LintResult lint(const Project& project, std::span<const PoseTable> poses) {
    LintContext context(project, poses);
    using SpaceRule = void (*)(LintContext&, const ProjectSpace&);
    // Needed placeholders come before suggestions, so that a suggestion beside one is not made.
    for (const SpaceRule rule :
         {lint_degenerate_space, lint_missing_idle, lint_crossing_axis, lint_opposite_directions, lint_missing_axis_end,
          lint_misaligned, lint_acute_triangle, lint_too_close, lint_uncovered, lint_dissimilar_neighbours})
        for (const ProjectSpace& space : project.spaces)
            if (!is_style(space)) rule(context, space);  // a style needs no idle, no turns and no way back
    for (const ProjectClip& clip : project.clips)
        if (!clip.excluded) lint_clip(context, clip);
    lint_probe(context);

    for (const auto& [id, setting] : project.lint) {
        const LintRule* found = find_lint_rule(id);
        if (found == nullptr) {
            context.result.warnings.push_back("the project sets lint rule \"" + id + "\", which does not exist");
            continue;
        }
        for (const auto& [name, value] : setting.thresholds)
            if (std::none_of(found->thresholds.begin(), found->thresholds.end(),
                             [&name = name](const RuleThreshold& t) { return t.name == name; }))
                context.result.warnings.push_back("lint rule \"" + id + "\" has no threshold \"" + name + "\"");
    }
    std::stable_sort(context.result.findings.begin(), context.result.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
    return std::move(context.result);
}

bool has_findings(std::span<const Finding> findings, Severity least) {
    return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) { return f.severity >= least; });
}

}  // namespace surefoot
