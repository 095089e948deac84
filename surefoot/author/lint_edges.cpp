// Rules about edges and triangles: crossing axes, opposite directions, acute triangles, dissimilar neighbours.

#include <surefoot/author/lint_context.h>
#include <surefoot/author/place.h>
#include <surefoot/math/trig.h>
#include <surefoot/space/triangulate.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

/// The two sides of an axis in words: below 0, above 0, and 0 itself.
struct SideWords {
    const char *below, *above, *between;
};

SideWords side_words(const std::string& axis) {
    if (axis == "turn") return {"turning right", "turning left", "going straight"};
    if (axis == "speed" || axis == "forward") return {"going backward", "going forward", "neither"};
    if (axis == "lateral") return {"stepping right", "stepping left", "neither"};
    if (axis == "slope") return {"going downhill", "going uphill", "level ground"};
    return {"below zero", "above zero", "zero"};
}

using Triangle = std::array<int, 3>;

std::vector<Triangle> plane_triangles(const BlendSpace& space) {
    std::vector<Triangle> triangles;
    if (space.dimensions() == 2)
        for (const Simplex& simplex : space.simplices)
            if (simplex[2] >= 0) triangles.push_back({simplex[0], simplex[1], simplex[2]});
    return triangles;
}

/// Smallest angle [deg] of a triangle in percent coordinates, and the corner of the largest one.
double smallest_angle(const PercentSpace& percent, const BlendSpace& space, const Triangle& t, int& widest) {
    double smallest = 180, largest = 0;
    for (int k = 0; k < 3; ++k) {
        const SpacePoint &p = space.samples[t[k]], &a = space.samples[t[(k + 1) % 3]],
                         &b = space.samples[t[(k + 2) % 3]];
        double u[2], v[2];
        for (int c = 0; c < 2; ++c) {
            u[c] = percent.percent(static_cast<double>(a[c]) - p[c], c);
            v[c] = percent.percent(static_cast<double>(b[c]) - p[c], c);
        }
        const double angle = atan2(std::fabs(u[0] * v[1] - u[1] * v[0]), u[0] * v[0] + u[1] * v[1]) * 180 / k_pi;
        smallest = std::min(smallest, angle);
        if (angle > largest) largest = angle, widest = k;
    }
    return smallest;
}

/// Sum over triangles of how far their smallest angle falls below the limit: what a new clip should lower.
double acuteness(const ProjectSpace& space, const BlendSpace& trial, double limit) {
    const PercentSpace percent(space);
    double sum = 0;
    int widest = 0;
    for (const Triangle& t : plane_triangles(trial))
        sum += std::max(0.0, limit - smallest_angle(percent, trial, t, widest));
    return sum;
}

/// Where a new sample would help most against the acute triangle: tried out at the middle of its longest edge, at its
/// circumcentre (Delaunay refinement), and at the middle of its flanks.
bool best_refinement(const ProjectSpace& space, const Triangle& t, int widest, double limit, double too_close,
                     SpacePoint& best) {
    const PercentSpace percent(space);
    const auto& samples = space.space.samples;
    const auto middle = [&](int a, int b) {
        return SpacePoint{0.5f * (samples[a][0] + samples[b][0]), 0.5f * (samples[a][1] + samples[b][1])};
    };
    std::vector<SpacePoint> candidates{middle(t[(widest + 1) % 3], t[(widest + 2) % 3]),
                                       middle(t[widest], t[(widest + 1) % 3]), middle(t[widest], t[(widest + 2) % 3])};
    const double ax = percent.at(t[0], 0), ay = percent.at(t[0], 1);
    const double bx = percent.at(t[1], 0) - ax, by = percent.at(t[1], 1) - ay;
    const double cx = percent.at(t[2], 0) - ax, cy = percent.at(t[2], 1) - ay;
    if (const double twice = 2 * (bx * cy - by * cx); twice != 0) {
        const double bb = bx * bx + by * by, cc = cx * cx + cy * cy;
        const double x = ax + (cy * bb - by * cc) / twice, y = ay + (bx * cc - cx * bb) / twice;
        candidates.push_back(
            {static_cast<float>(x / percent.percent(1, 0)), static_cast<float>(y / percent.percent(1, 1))});
    }
    double least = 0.9 * acuteness(space, space.space, limit);  // worth a clip only where it helps by a tenth
    bool found = false;
    for (const SpacePoint& candidate : candidates) {
        bool usable = true;
        for (int k = 0; k < 2; ++k)
            usable = usable && candidate[k] >= space.space.axes[k].low && candidate[k] <= space.space.axes[k].high;
        for (const SpacePoint& sample : samples) usable = usable && percent.distance(sample, candidate) >= too_close;
        if (!usable) continue;
        BlendSpace trial = space.space;
        trial.samples.push_back(candidate);
        triangulate(trial);
        const double left = acuteness(space, trial, limit);
        if (left >= least) continue;
        least = left;
        best = candidate;
        found = true;
    }
    return found;
}

}  // namespace

void lint_crossing_axis(LintContext& context, const ProjectSpace& space) {
    const PercentSpace percent(space);
    const double limit = context.threshold("crossing-axis", "distance");
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
            finding.message = fmt::format(
                "\"{}\" ({}) and \"{}\" ({}) are blended across {} = 0 with no clip on the axis: asked to go {}, the "
                "character mixes two opposite motions, and its feet shuffle or cross.",
                finding.clips[0], ua < 0 ? words.below : words.above, finding.clips[1],
                ub < 0 ? words.below : words.above, axis.name, describe_place(space.space.axes, finding.at));
            context.ask_for(space, finding, PlaceholderKind::needed, finding.at);
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
        Finding finding;
        finding.rule = "opposite-directions";
        finding.space = space.name;
        finding.clips = {context.name(space, a), context.name(space, b)};
        SpacePoint middle{};
        for (int c = 0; c < percent.dimensions(); ++c)
            middle[c] = 0.5f * (space.space.samples[a][c] + space.space.samples[b][c]);
        finding.at = context.place(space, middle);
        finding.message = fmt::format(
            "\"{}\" and \"{}\" travel {:.0f} deg apart and are blended with each other: their steps cancel out, and "
            "the "
            "feet slide to and fro.",
            finding.clips[0], finding.clips[1], apart);
        finding.fix = Fix{"add-clip", "add a clip between the two, such as one that stands or turns on the spot",
                          space.name, finding.at, finding.clips};
        context.add(std::move(finding));
    }
}

void lint_acute_triangle(LintContext& context, const ProjectSpace& space) {
    if (!context.enabled("acute-triangle")) return;
    const PercentSpace percent(space);
    const double limit = context.threshold("acute-triangle", "angle");
    const double too_close = context.threshold("too-close", "distance");
    for (const Triangle& t : plane_triangles(space.space)) {
        int widest = 0;
        const double angle = smallest_angle(percent, space.space, t, widest);
        if (angle >= limit) continue;
        Finding finding;
        finding.rule = "acute-triangle";
        finding.space = space.name;
        SpacePoint centre{};
        for (const int corner : t) {
            finding.clips.push_back(context.name(space, corner));
            for (int c = 0; c < 2; ++c) centre[c] += space.space.samples[corner][c] / 3;
        }
        finding.at = context.place(space, centre);
        const std::string& sharp = finding.clips[widest];
        finding.message = fmt::format(
            "The triangle of \"{}\", \"{}\" and \"{}\" is a sliver (smallest angle {:.1f} deg): \"{}\" is so near the "
            "line between the others that a small move of the stick switches from them to it, and the character "
            "twitches.",
            finding.clips[0], finding.clips[1], finding.clips[2], angle, sharp);
        SpacePoint target;
        if (best_refinement(space, t, widest, limit, too_close, target)) {
            context.ask_for(space, finding, PlaceholderKind::needed, context.place(space, target));
            continue;
        }
        finding.fix = Fix{"remove",
                          fmt::format("leave out \"{}\", or replace it by a clip farther from the line", sharp),
                          space.name,
                          {},
                          {sharp}};
        context.add(std::move(finding));
    }
}

void lint_dissimilar_neighbours(LintContext& context, const ProjectSpace& space) {
    const PercentSpace percent(space);
    const double limit = context.threshold("dissimilar-neighbours", "pose");
    for (const auto& [a, b] : percent.edges()) {
        const auto apart = context.apart(space.clips[a], space.clips[b]);
        if (!apart || 100.0 * *apart <= limit) continue;
        Finding finding;
        finding.rule = "dissimilar-neighbours";
        finding.space = space.name;
        finding.clips = {context.name(space, a), context.name(space, b)};
        SpacePoint middle{};
        for (int c = 0; c < percent.dimensions(); ++c)
            middle[c] = 0.5f * (space.space.samples[a][c] + space.space.samples[b][c]);
        finding.at = context.place(space, middle);
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
