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

std::vector<std::string> names_at(const LintContext& context, const ProjectSpace& space) {
    std::vector<std::string> names;
    for (int i = 0; i < static_cast<int>(space.clips.size()); ++i) names.push_back(context.name(space, i));
    return names;
}

/// Where all axes have the value nearest to 0: standing still on level ground.
SpacePoint neutral_point(const BlendSpace& space) {
    SpacePoint point{};
    for (int k = 0; k < space.dimensions(); ++k)
        point[k] = std::min(std::max(0.0f, space.axes[k].low), space.axes[k].high);
    return point;
}

/// Highest and lowest value on an axis among samples that lie on the axis itself (all other values neutral).
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
        SpacePoint on_axis = neutral_point(space.space);
        on_axis[axis] = sample[axis];
        if (percent.distance(sample, on_axis) > limit) continue;
        ends.low_held |= percent.percent(static_cast<double>(sample[axis]) - ends.low, axis) <= limit;
        ends.high_held |= percent.percent(static_cast<double>(ends.high) - sample[axis], axis) <= limit;
    }
    return ends;
}

/// Dimension that the samples span.
int rank_of(const BlendSpace& space) {
    if (space.simplices.empty()) return 0;
    int corners = 0;
    for (const std::int32_t corner : space.simplices.front()) corners += corner >= 0;
    return corners - 1;
}

/// Name of an axis along which all samples have one value; empty where there is none.
std::string flat_axis(const ProjectSpace& space) {
    const auto& samples = space.space.samples;
    for (int k = 0; k < space.space.dimensions(); ++k)
        if (std::all_of(samples.begin(), samples.end(), [&](const SpacePoint& p) { return p[k] == samples[0][k]; }))
            return space.space.axes[k].name;
    return {};
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
        } else if (context.project().spaces.size() == 1) {  // else another space has the other directions
            finding.message =
                fmt::format("The clips differ in nothing but {}, so that is all that the player can steer.", axis);
            finding.fix = Fix{"add-clip", "add clips that move in other directions", space.name, {}, {}};
            context.add(std::move(finding), Severity::warning);
        }
        return;
    }
    const int rank = rank_of(space.space);
    if (rank == space.space.dimensions()) return;
    const char* where = rank == 1 ? "line" : rank == 2 ? "plane" : "volume";
    const std::string flat = flat_axis(space);
    finding.message = fmt::format(
        "All samples lie on one {0}{1}, so the character can only blend along it; any other wish is answered by the "
        "nearest point of the {0}.",
        where, flat.empty() ? "" : " (no two of them differ in " + flat + ")");
    finding.fix = Fix{"add-clip",
                      flat.empty() ? fmt::format("add a clip beside the {}", where) : "add a clip with another " + flat,
                      space.name,
                      {},
                      {}};
    context.add(std::move(finding), Severity::warning);
}

void lint_missing_idle(LintContext& context, const ProjectSpace& space) {
    if (space.name != "facing" && context.project().find_space("facing")) return;
    const PercentSpace percent(space);
    const double limit = context.threshold("missing-idle", "distance");
    std::vector<int> motion;  // an idle is still, whatever its slope or style
    for (const char* name : {"speed", "forward", "lateral", "turn"})
        if (const int axis = percent.axis(name); axis >= 0) motion.push_back(axis);
    const auto stands = [&](const SpacePoint& sample) {
        double square = 0;
        for (const int axis : motion)
            square += percent.percent(sample[axis], axis) * percent.percent(sample[axis], axis);
        return std::sqrt(square) <= limit;
    };
    const auto& samples = space.space.samples;
    if (motion.empty() || std::any_of(samples.begin(), samples.end(), stands)) return;
    Finding finding;
    finding.rule = "missing-idle";
    finding.at = context.place(space, neutral_point(space.space));
    finding.message =
        "No clip stands still. When the player lets go of the stick the character keeps stepping on the spot.";
    context.ask_for(space, finding, PlaceholderKind::needed, finding.at);
}

void lint_missing_axis_end(LintContext& context, const ProjectSpace& space) {
    const PercentSpace percent(space);
    const double limit = context.threshold("missing-axis-end", "distance");
    const auto ask = [&](int axis, float value, const std::string& message) {
        SpacePoint point = neutral_point(space.space);
        point[axis] = value;
        Finding finding;
        finding.rule = "missing-axis-end";
        finding.at = context.place(space, point);
        finding.message = message;
        context.ask_for(space, finding, PlaceholderKind::needed, finding.at);
    };
    // Sideways spaces leave straight ahead and back to the space of those who go where they face.
    const bool alone = percent.axis("speed") < 0 && !context.project().find_space("facing");
    if (const int speed = percent.axis(alone ? "forward" : "speed"); speed >= 0) {
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
                SpacePoint on_axis = neutral_point(space.space);
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

namespace {

/// A finding about one sample, without words yet.
Finding about_sample(const char* rule, const LintContext& context, const ProjectSpace& space, int sample) {
    Finding finding;
    finding.rule = rule;
    finding.space = space.name;
    finding.clips = {context.name(space, sample)};
    finding.at = context.place(space, sample);
    return finding;
}

void add_misaligned(LintContext& context, const ProjectSpace& space, int sample, const SpacePoint& aligned,
                    int off_axis) {
    const PercentSpace percent(space);
    const Axis& axis = space.space.axes[off_axis];
    const float value = space.space.samples[sample][off_axis];
    const SideWords words = side_words(axis.name);
    Finding finding = about_sample("misaligned", context, space, sample);
    finding.message = fmt::format(
        "\"{}\" seems meant for {}, but it is {} by {:.2g} {} ({:.1f} % of the axis). Placed on the axis by hand it "
        "would carry the character off course; placed where it was measured, {} is mixed from several clips.",
        finding.clips[0], words.between, value < 0 ? words.below : words.above, std::fabs(value), axis.unit,
        std::fabs(percent.at(sample, off_axis)), words.between);
    const std::vector<float> target = context.place(space, aligned);
    const std::string wanted = describe_clip(space.space.axes, target);
    // Where another clip is about there, none needs to be added.
    bool held = false;
    for (int i = 0; i < percent.count(); ++i)
        held |= i != sample &&
                percent.distance(space.space.samples[i], aligned) < context.threshold("too-close", "distance");
    if (!held) context.add_placeholder(space, "misaligned", PlaceholderKind::needed, target, {}, wanted);
    finding.fix = Fix{"straighten", held ? "straighten it" : "straighten it, or add " + wanted, space.name, target,
                      finding.clips};
    context.add(std::move(finding));
}

/// A clip that turns by itself where no axis tells turns apart.
void add_unknown_turn(LintContext& context, const ProjectSpace& space, int sample) {
    const float turn = context.clip(space, sample).facts.turn;
    Finding finding = about_sample("misaligned", context, space, sample);
    finding.message = fmt::format(
        "\"{}\" turns by {:.0f} deg/s to its {}, but its space has no axis for that: the character goes where it is "
        "steered, and the feet twist on the ground by what the clip turns.",
        finding.clips[0], std::fabs(turn), turn < 0 ? "right" : "left");
    finding.fix = Fix{"straighten", "straighten it", space.name, finding.at, finding.clips};
    context.add(std::move(finding));
}

}  // namespace

void lint_misaligned(LintContext& context, const ProjectSpace& space) {
    const auto& axes = space.space.axes;
    if (std::none_of(axes.begin(), axes.end(), [](const Axis& axis) { return axis.name == "turn"; }))
        for (int i = 0; i < space.space.original_count(); ++i)
            if (std::fabs(static_cast<double>(context.clip(space, i).facts.turn)) >
                context.threshold("misaligned", "turn"))
                add_unknown_turn(context, space, i);
    if (space.space.dimensions() < 2) return;
    const PercentSpace percent(space);
    const double near = context.threshold("misaligned", "near"), far = context.threshold("misaligned", "far");
    for (int i = 0; i < percent.count(); ++i) {
        SpacePoint aligned = space.space.samples[i];
        int off_axis = -1;
        double along = 0;
        for (int k = 0; k < percent.dimensions(); ++k) {
            const double value = std::fabs(percent.at(i, k));
            along = std::max(along, value);
            if (value <= near || value >= far) continue;
            aligned[k] = 0;
            if (off_axis < 0 || value > std::fabs(percent.at(i, off_axis))) off_axis = k;
        }
        if (off_axis < 0 || along < far) continue;  // a sample near the origin is an idle, aligned with nothing
        add_misaligned(context, space, i, aligned, off_axis);
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
            Finding finding = context.pair_finding("too-close", space, i, j);
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
            const bool conflicting = apart && apart_cm > conflict;
            if (conflicting) finding.fix->text += ", and give the other a space of its own";
            finding.message = fmt::format("\"{}\" and \"{}\" are only {:.1f} % apart. ", finding.clips[0],
                                          finding.clips[1], distance);
            if (!apart)
                finding.message += "If their style differs, the character flickers between them.";
            else if (conflicting)
                finding.message += fmt::format(
                    "They are conflicting: their poses differ by {:.0f} cm, so the slightest move of the stick "
                    "switches between two styles.",
                    apart_cm);
            else
                finding.message += fmt::format(
                    "They are redundant (poses {:.1f} cm apart): the second costs memory and adds little.", apart_cm);
            context.add_placeholder(
                space, "too-close", PlaceholderKind::suggested, finding.at, {},
                "one clip here in place of \"" + finding.clips[0] + "\" and \"" + finding.clips[1] + "\"");
            context.add(std::move(finding), conflicting ? std::optional(Severity::error) : std::nullopt);
        }
}

void lint_uncovered(LintContext& context, const ProjectSpace& space) {
    const int d = space.space.dimensions();
    if (space.space.simplices.empty()) return;
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
        // Limits that nobody set are rounded out: their ends are beyond all clips by that alone.
        if (!space.axes_pinned && (inner > 0 || d == 1)) continue;
        const BlendWeights nearest = blend_weights(space.space, point);
        const double distance = percent.distance(nearest.point, point);
        if (distance <= limit) continue;
        Finding finding;
        finding.rule = "uncovered";
        finding.at = context.place(space, point);
        if (context.asked_for("missing-axis-end", space, point)) continue;  // said already, and more plainly
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
