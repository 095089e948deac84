// Rules about single samples and the outline of a space: missing idle and axis ends, misaligned, too close, uncovered,
// degenerate.

#include <surefoot/author/lint_context.h>
#include <surefoot/author/place.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace surefoot {
namespace {

constexpr float k_reference_turn = 90;  ///< [deg/s] the paper's 90 degree turn, read as one second's
constexpr float k_walk_back = -1;       ///< [m/s] a backward walk, where there is none to measure
constexpr float k_walk = 1.4f;          ///< [m/s] a walk

/// Whether some sample is within `limit` percent of `point`.
bool has_sample_near(const ProjectSpace& space, const PercentSpace& percent, const SpacePoint& point, double limit) {
    for (const SpacePoint& sample : space.space.samples)
        if (percent.distance(sample, point) <= limit) return true;
    return false;
}

std::vector<std::string> names_at(const LintContext& context, const ProjectSpace& space) {
    std::vector<std::string> names;
    for (int i = 0; i < static_cast<int>(space.clips.size()); ++i) names.push_back(context.name(space, i));
    return names;
}

/// Highest and lowest value on an axis among samples that lie on the axis itself (all other values near 0).
struct AxisEnds {
    float low = 0, high = 0;                   ///< of all samples
    bool low_held = false, high_held = false;  ///< a sample on the axis is there
};

AxisEnds axis_ends(const ProjectSpace& space, const PercentSpace& percent, int axis, double limit) {
    AxisEnds ends;
    for (const SpacePoint& sample : space.space.samples) {
        ends.low = std::min(ends.low, sample[axis]);
        ends.high = std::max(ends.high, sample[axis]);
    }
    for (const SpacePoint& sample : space.space.samples) {
        SpacePoint on_axis{};
        on_axis[axis] = sample[axis];
        if (percent.distance(sample, on_axis) > limit) continue;
        ends.low_held |= percent.percent(static_cast<double>(sample[axis]) - ends.low, axis) <= limit;
        ends.high_held |= percent.percent(static_cast<double>(ends.high) - sample[axis], axis) <= limit;
    }
    return ends;
}

}  // namespace

void lint_degenerate_space(LintContext& context, const ProjectSpace& space) {
    std::set<SpacePoint> places(space.space.samples.begin(), space.space.samples.end());
    Finding finding;
    finding.rule = "degenerate-space";
    finding.space = space.name;
    finding.clips = names_at(context, space);
    if (places.size() < 2) {
        finding.at = context.place(space, 0);
        finding.message =
            space.clips.size() == 1
                ? fmt::format(
                      "\"{}\" is the only clip: whatever the player asks for, the character does this one thing.",
                      context.name(space, 0))
                : fmt::format(
                      "All {} clips do the same thing ({}): whatever the player asks for, the character does "
                      "that.",
                      space.clips.size(), describe_place(space.space.axes, finding.at));
        finding.fix = Fix{
            "add-clip", "add clips that move differently: an idle, a walk, a turn to either side", space.name, {}, {}};
        context.add(std::move(finding));
        return;
    }
    if (space.space.dimensions() == 1) {
        const std::string& axis = space.space.axes[0].name;
        float high = 0;
        for (const SpacePoint& sample : space.space.samples) high = std::max(high, sample[0]);
        if (axis == "speed") {
            const float pace = high >= k_walk ? k_walk : high;
            finding.message =
                "None of the clips turns, so the space has one dimension, speed: the character cannot be steered along "
                "a curve. One clip that turns while it walks (its mirror image serves the other side) opens the "
                "second.";
            finding.at = {pace};
            context.ask_for(space, finding, PlaceholderKind::needed, {pace, k_reference_turn / 2}, {"turn"},
                            Severity::warning);
            context.add_placeholder(space, "degenerate-space", PlaceholderKind::needed, {pace, -k_reference_turn / 2},
                                    {"turn"}, "the mirror image of that clip");
        } else if (axis == "turn") {
            finding.message =
                "None of the clips travels, so the space has one dimension, turn: the character can only turn on the "
                "spot. A walk opens the second.";
            finding.fix = Fix{"add-clip", "add a clip that walks straight ahead", space.name, {}, {}};
            context.add(std::move(finding), Severity::warning);
        }
        return;
    }
    const bool full = !space.space.simplices.empty() && space.space.simplices[0][space.space.dimensions()] >= 0;
    if (full) return;
    finding.message =
        "All samples lie on one line, so the character can only blend along it; any other wish is answered by the "
        "nearest point of the line.";
    finding.fix = Fix{"add-clip", "add a clip beside the line", space.name, {}, {}};
    context.add(std::move(finding), Severity::warning);
}

void lint_missing_idle(LintContext& context, const ProjectSpace& space) {
    const PercentSpace percent(space);
    if (space.name != "facing" && context.project().find_space("facing")) return;
    if (has_sample_near(space, percent, {}, context.threshold("missing-idle", "distance"))) return;
    Finding finding;
    finding.rule = "missing-idle";
    finding.at = context.place(space, SpacePoint{});
    finding.message =
        "No clip stands still. When the player lets go of the stick the character keeps stepping on the spot.";
    context.ask_for(space, finding, PlaceholderKind::needed, finding.at);
}

void lint_missing_axis_end(LintContext& context, const ProjectSpace& space) {
    const PercentSpace percent(space);
    const double limit = context.threshold("missing-axis-end", "distance");
    const auto ask = [&](int axis, float value, const std::string& message) {
        SpacePoint point{};
        point[axis] = value;
        Finding finding;
        finding.rule = "missing-axis-end";
        finding.at = context.place(space, point);
        finding.message = message;
        context.ask_for(space, finding, PlaceholderKind::needed, finding.at);
    };
    if (const int speed = percent.axis("speed"); speed >= 0) {
        const AxisEnds ends = axis_ends(space, percent, speed, limit);
        if (ends.high > 0 && !ends.high_held)
            ask(speed, ends.high,
                fmt::format("No clip goes straight ahead at full speed ({:.2f} m/s): running straight is mixed from "
                            "clips that veer to either side.",
                            ends.high));
        if (ends.low <= -k_standing_speed && !ends.low_held)
            ask(speed, ends.low,
                fmt::format("No clip goes straight back at full speed ({:.2f} m/s): backing up is mixed from clips "
                            "that veer to either side.",
                            -ends.low));
        if (ends.low > -k_standing_speed && ends.high > 0)
            ask(speed, k_walk_back, "No clip goes backward: pulled back, the stick makes the character stand still.");
    }
    if (const int turn = percent.axis("turn"); turn >= 0) {
        for (const float side : {k_reference_turn, -k_reference_turn}) {
            bool held = false;
            for (const SpacePoint& sample : space.space.samples) {
                SpacePoint on_axis{};
                on_axis[turn] = sample[turn];
                held |= percent.distance(sample, on_axis) <= limit &&
                        percent.percent(static_cast<double>(sample[turn]) / side * std::fabs(side) - std::fabs(side),
                                        turn) >= -limit;
            }
            if (!held)
                ask(turn, side,
                    fmt::format("No clip turns on the spot to the {} at 90 deg/s: turning while standing is mixed from "
                                "clips that walk.",
                                side > 0 ? "left" : "right"));
        }
    }
    if (const int lateral = percent.axis("lateral"); lateral >= 0) {
        const AxisEnds ends = axis_ends(space, percent, lateral, limit);
        const float widest = std::max(ends.high, -ends.low);
        for (const float side : {1.0f, -1.0f}) {
            const float end = side > 0 ? ends.high : -ends.low;
            const char* word = side > 0 ? "left" : "right";
            if (end < k_standing_speed)
                ask(lateral, side * widest,
                    fmt::format("No clip steps to its {}, though one steps to the other side: the character strafes "
                                "one way only. Mirroring that clip is enough.",
                                word));
            else if (!(side > 0 ? ends.high_held : ends.low_held))
                ask(lateral, side * end,
                    fmt::format("No clip steps straight to its {} at full speed ({:.2f} m/s).", word, end));
        }
    }
}

void lint_misaligned(LintContext& context, const ProjectSpace& space) {
    if (space.space.dimensions() < 2) return;
    const PercentSpace percent(space);
    const double near = context.threshold("misaligned", "near"), far = context.threshold("misaligned", "far");
    for (int i = 0; i < percent.count(); ++i) {
        SpacePoint aligned = space.space.samples[i];
        int off_axis = -1;
        double off = 0, along = 0;
        for (int k = 0; k < percent.dimensions(); ++k) {
            const double value = std::fabs(percent.at(i, k));
            along = std::max(along, value);
            if (value <= near || value >= far) continue;
            aligned[k] = 0;
            off_axis = k;
            off = std::max(off, value);
        }
        if (off_axis < 0 || along < far) continue;  // a sample near the origin is an idle, aligned with nothing
        const Axis& axis = space.space.axes[off_axis];
        Finding finding;
        finding.rule = "misaligned";
        finding.clips = {context.name(space, i)};
        finding.at = context.place(space, i);
        finding.message = fmt::format(
            "\"{}\" seems meant to have no {}, but it has {:.2f} {} ({:.1f} % of the axis). Played as if it had none, "
            "it "
            "would carry the character off course; here it stands where it was measured, so the course is right and "
            "the pure motion is mixed from several clips.",
            finding.clips[0], axis.name, space.space.samples[i][off_axis], axis.unit, off);
        context.ask_for(space, finding, PlaceholderKind::needed, context.place(space, aligned));
    }
}

void lint_too_close(LintContext& context, const ProjectSpace& space) {
    const PercentSpace percent(space);
    const double limit = context.threshold("too-close", "distance");
    const double conflict = context.threshold("too-close", "conflict");
    for (int i = 0; i < percent.count(); ++i)
        for (int j = i + 1; j < percent.count(); ++j) {
            const double distance = percent.distance(i, j);
            if (distance >= limit) continue;
            const auto apart = context.apart(space.clips[i], space.clips[j]);
            const double apart_cm = apart ? 100.0 * *apart : 0;
            Finding finding;
            finding.space = space.name;
            finding.clips = {context.name(space, i), context.name(space, j)};
            SpacePoint middle{};
            for (int k = 0; k < percent.dimensions(); ++k)
                middle[k] = 0.5f * (space.space.samples[i][k] + space.space.samples[j][k]);
            finding.at = context.place(space, middle);
            finding.fix = Fix{"keep-one",
                              fmt::format("keep one of \"{}\" and \"{}\"", finding.clips[0], finding.clips[1]),
                              space.name,
                              {},
                              finding.clips};
            const bool same = apart && distance <= context.threshold("duplicate", "distance") &&
                              apart_cm <= context.threshold("duplicate", "pose");
            if (same) {
                finding.rule = "duplicate";
                finding.message = fmt::format(
                    "\"{}\" and \"{}\" are the same clip twice (poses {:.1f} cm apart): one of "
                    "them is never needed.",
                    finding.clips[0], finding.clips[1], apart_cm);
                context.add(std::move(finding));
                continue;
            }
            finding.rule = "too-close";
            const bool conflicting = apart && apart_cm > conflict;
            finding.message = fmt::format("\"{}\" and \"{}\" are only {:.1f} % apart. ", finding.clips[0],
                                          finding.clips[1], distance);
            if (!apart)
                finding.message += "If their style differs, the character flickers between them.";
            else if (conflicting)
                finding.message += fmt::format(
                    "They are conflicting: their poses differ by {:.0f} cm, so the slightest move of the stick "
                    "switches "
                    "between two styles.",
                    apart_cm);
            else
                finding.message += fmt::format(
                    "They are redundant: their poses differ by only {:.1f} cm, so the second costs memory and adds "
                    "little.",
                    apart_cm);
            context.add_placeholder(
                space, "too-close", PlaceholderKind::suggested, finding.at, {},
                "one clip here in place of \"" + finding.clips[0] + "\" and \"" + finding.clips[1] + "\"");
            context.add(std::move(finding), conflicting ? std::optional(Severity::error) : std::nullopt);
        }
}

void lint_uncovered(LintContext& context, const ProjectSpace& space) {
    const int d = space.space.dimensions();
    if (d < 2 || space.space.simplices.empty()) return;
    const PercentSpace percent(space);
    const double limit = context.threshold("uncovered", "distance");
    // Each axis at its low end, at 0 (or the middle, where 0 is an end) or at its high end; not all at the inner one.
    int total = 1;
    for (int k = 0; k < d; ++k) total *= 3;
    for (int n = 0; n < total; ++n) {
        SpacePoint point{};
        int inner = 0;
        for (int k = 0, rest = n; k < d; ++k, rest /= 3) {
            const Axis& axis = space.space.axes[k];
            const float between = axis.low < 0 && axis.high > 0 ? 0.0f : 0.5f * (axis.low + axis.high);
            point[k] = rest % 3 == 0 ? axis.low : rest % 3 == 1 ? axis.high : between;
            inner += rest % 3 == 2;
        }
        if (inner == d || (inner > 0 && d > 2)) continue;  // beyond the plane corners are enough
        const BlendWeights nearest = blend_weights(space.space, point);
        const double distance = percent.distance(nearest.point, point);
        if (distance <= limit) continue;
        Finding finding;
        finding.rule = "uncovered";
        finding.at = context.place(space, point);
        for (int k = 0; k < nearest.count; ++k) finding.clips.push_back(context.name(space, nearest.samples[k]));
        std::sort(finding.clips.begin(), finding.clips.end());
        finding.message = fmt::format(
            "Nothing covers \"{}\", {:.0f} % away from the nearest blend. Asked for it, the character goes {} "
            "instead.",
            describe_place(space.space.axes, finding.at), distance,
            describe_place(space.space.axes, context.place(space, nearest.point)));
        context.ask_for(space, finding, PlaceholderKind::suggested, finding.at);
    }
}

}  // namespace surefoot
