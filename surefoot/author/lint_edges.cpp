// Rules about the edges of a space: crossing axes, opposite directions, dissimilar neighbours.

#include <surefoot/author/lint_context.h>
#include <surefoot/author/place.h>

#include <fmt/format.h>

#include <cmath>

namespace surefoot {
namespace {

/// A sample on axis `k` (within `limit`) that is nearer to `point` than `near`; -1 for none.
int on_axis_near(const ProjectSpace& space, const PercentSpace& percent, int k, const SpacePoint& point, double limit,
                 double near) {
    for (int i = 0; i < percent.count(); ++i)
        if (std::fabs(percent.at(i, k)) <= limit && percent.distance(space.space.samples[i], point) < near) return i;
    return -1;
}

/// An edge that passes a clip on the axis closely: the clips are out of line, and one more would not help.
void add_crossing_beside(LintContext& context, const ProjectSpace& space, Finding finding, int beside) {
    const std::string &a = finding.clips[0], &b = finding.clips[1], &passed = context.name(space, beside);
    const PercentSpace percent(space);
    finding.space = space.name;
    finding.message += fmt::format(
        " \"{}\" stands on the axis, {:.1f} % away, but the three are out of line, and the edge passes beside it.",
        passed, percent.distance(space.space.samples[beside], context.point(finding.at)));
    finding.fix = Fix{"straighten", fmt::format("straighten \"{}\" and \"{}\", so that the three are in line", a, b),
                      space.name, finding.at, finding.clips};
    context.add(std::move(finding));
}

}  // namespace

void lint_crossing_axis(LintContext& context, const ProjectSpace& space) {
    const PercentSpace percent(space);
    const double limit = context.threshold("crossing-axis", "distance");
    const double near = context.threshold("misaligned", "far");
    for (int k = 0; k < percent.dimensions(); ++k)
        for (const auto& [a, b] : percent.edges()) {
            const double ua = percent.at(a, k), ub = percent.at(b, k);
            if (ua * ub >= 0 || std::fabs(ua) <= limit || std::fabs(ub) <= limit) continue;
            const double t = ua / (ua - ub);
            SpacePoint at{};
            for (int c = 0; c < percent.dimensions(); ++c) {
                const float from = space.space.samples[a][c], to = space.space.samples[b][c];
                at[c] = static_cast<float>(from + t * (static_cast<double>(to) - from));
            }
            at[k] = 0;
            const Axis& axis = space.space.axes[k];
            const SideWords words = side_words(axis.name);
            Finding finding;
            finding.rule = "crossing-axis";
            finding.clips = {context.name(space, a), context.name(space, b)};
            finding.at = context.place(space, at);
            const int beside = on_axis_near(space, percent, k, at, limit, near);
            finding.message = fmt::format(
                "\"{}\" ({}) and \"{}\" ({}) are blended across {} = 0{}: asked to go {}, the "
                "character mixes two opposite motions, and its feet shuffle or cross.",
                finding.clips[0], ua < 0 ? words.below : words.above, finding.clips[1],
                ub < 0 ? words.below : words.above, axis.name, beside < 0 ? " with no clip on the axis" : "",
                describe_place(space.space.axes, finding.at));
            if (beside < 0)
                context.ask_for(space, finding, PlaceholderKind::needed, finding.at);
            else
                add_crossing_beside(context, space, std::move(finding), beside);
        }
}

void lint_opposite_directions(LintContext& context, const ProjectSpace& space) {
    const PercentSpace percent(space);
    const double limit = context.threshold("opposite-directions", "angle");
    for (const auto& [a, b] : percent.edges()) {
        const ClipFacts &fa = context.clip(space, a).facts, &fb = context.clip(space, b).facts;
        if (std::fabs(fa.speed) < k_standing_speed || std::fabs(fb.speed) < k_standing_speed) continue;
        double apart = std::fabs(static_cast<double>(fa.travel) - fb.travel);
        if (apart > 180) apart = 360 - apart;
        if (apart <= limit) continue;
        Finding finding = context.pair_finding("opposite-directions", space, a, b);
        finding.message = fmt::format(
            "\"{}\" and \"{}\" travel {:.0f} deg apart and are blended with each other: their steps cancel out, and "
            "the feet slide to and fro.",
            finding.clips[0], finding.clips[1], apart);
        finding.fix = Fix{"add-clip", "add a clip between the two, such as one that stands or turns on the spot",
                          space.name, finding.at, finding.clips};
        context.add(std::move(finding));
    }
}

void lint_dissimilar_neighbours(LintContext& context, const ProjectSpace& space) {
    const PercentSpace percent(space);
    const double limit = context.threshold("dissimilar-neighbours", "pose");
    const double near = context.enabled("too-close") ? context.threshold("too-close", "distance") : 0;
    for (const auto& [a, b] : percent.edges()) {
        const auto apart = context.apart(space.clips[a], space.clips[b]);
        if (!apart || 100.0 * *apart <= limit) continue;
        if (percent.distance(a, b) < near) continue;  // too close, which says more
        Finding finding = context.pair_finding("dissimilar-neighbours", space, a, b);
        finding.message = fmt::format(
            "\"{}\" and \"{}\" are neighbours, but at the same point of the step their poses are {:.0f} cm apart on "
            "average: the motion between them looks like neither.",
            finding.clips[0], finding.clips[1], 100.0 * *apart);
        finding.fix = Fix{"add-clip", "add a clip between the two in the style of one of them", space.name, finding.at,
                          finding.clips};
        context.add(std::move(finding));
    }
}

}  // namespace surefoot
