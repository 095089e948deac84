// Acute triangles and what they are in three and four dimensions: cells so flat that one corner nearly lies in the face
// opposite (Delicado & Pelechano 2019, §3.2.2).

#include <surefoot/author/lint_context.h>
#include <surefoot/math/trig.h>
#include <surefoot/space/triangulate.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace surefoot {
namespace {

using Vector = std::array<double, k_max_dimensions>;

double dot(const Vector& a, const Vector& b) {
    double sum = 0;
    for (int k = 0; k < k_max_dimensions; ++k) sum += a[k] * b[k];
    return sum;
}

/// How a simplex' weights change over space, in percent coordinates. A corner's weight falls from 1 at the corner to 0
/// at the face opposite along this gradient, which is as long as the corner's height is short.
struct CellShape {
    std::array<Vector, k_max_dimensions + 1> corners{}, gradients{};
    bool flat = false;  ///< no gradients: all corners in one plane
};

CellShape shape_of(const PercentSpace& percent, const BlendSpace& space, const Simplex& simplex) {
    const int d = space.dimensions();
    CellShape shape;
    for (int i = 0; i <= d; ++i)
        for (int k = 0; k < d; ++k) shape.corners[i][k] = percent.percent(space.samples[simplex[i]][k], k);
    // The gradients of corners 1 … d are the columns of the inverse of the edges' matrix: Gauss and Jordan.
    double rows[k_max_dimensions][2 * k_max_dimensions] = {};
    for (int i = 0; i < d; ++i) {
        for (int k = 0; k < d; ++k) rows[i][k] = shape.corners[i + 1][k] - shape.corners[0][k];
        rows[i][d + i] = 1;
    }
    for (int c = 0; c < d; ++c) {
        int pivot = c;
        for (int r = c + 1; r < d; ++r)
            if (std::fabs(rows[r][c]) > std::fabs(rows[pivot][c])) pivot = r;
        constexpr double k_nothing = 1e-9;  // [%]
        if (std::fabs(rows[pivot][c]) < k_nothing) {
            shape.flat = true;
            return shape;
        }
        std::swap(rows[pivot], rows[c]);
        for (int r = 0; r < d; ++r) {
            const double factor = (r == c ? rows[c][c] - 1 : rows[r][c]) / rows[c][c];
            for (int k = 0; k < 2 * d; ++k) rows[r][k] -= factor * rows[c][k];
        }
    }
    for (int i = 1; i <= d; ++i)
        for (int k = 0; k < d; ++k) {
            shape.gradients[i][k] = rows[k][d + i - 1];
            shape.gradients[0][k] -= rows[k][d + i - 1];
        }
    return shape;
}

struct Sliver {
    Simplex simplex{};
    double angle = 180;  ///< [deg] the smallest between two of its sides: a triangle's corner, a dihedral angle beyond
    int sharp = 0;       ///< the corner nearest to the side opposite
};

Sliver measure(const PercentSpace& percent, const BlendSpace& space, const Simplex& simplex) {
    const CellShape shape = shape_of(percent, space, simplex);
    Sliver sliver{simplex, 180, 0};
    if (shape.flat) sliver.angle = 0;
    for (int i = 0; i <= space.dimensions() && !shape.flat; ++i) {
        if (dot(shape.gradients[i], shape.gradients[i]) >
            dot(shape.gradients[sliver.sharp], shape.gradients[sliver.sharp]))
            sliver.sharp = i;
        for (int j = 0; j < i; ++j) {
            const Vector &a = shape.gradients[i], &b = shape.gradients[j];
            const double product = std::sqrt(dot(a, a) * dot(b, b));
            sliver.angle = std::min(sliver.angle, acos(-dot(a, b) / product) * 180 / k_pi);
        }
    }
    return sliver;
}

/// Cells of a space whose smallest angle is below `limit`, in the order of the simplices.
std::vector<Sliver> slivers_of(const PercentSpace& percent, const BlendSpace& space, double limit) {
    std::vector<Sliver> slivers;
    const int d = space.dimensions();
    if (d < 2) return slivers;
    for (const Simplex& simplex : space.simplices) {
        if (simplex[d] < 0) continue;
        const Sliver sliver = measure(percent, space, simplex);
        if (sliver.angle < limit) slivers.push_back(sliver);
    }
    return slivers;
}

/// How far the slivers' angles fall below the limit, in sum: what a new clip should lower.
double badness(const std::vector<Sliver>& slivers, double limit) {
    double sum = 0;
    for (const Sliver& sliver : slivers) sum += limit - sliver.angle;
    return sum;
}

/// Places that may break up a sliver: the middles of its edges and its circumcentre (Delaunay refinement).
std::vector<SpacePoint> refinements(const PercentSpace& percent, const BlendSpace& space, const Sliver& sliver) {
    const int d = space.dimensions();
    std::vector<SpacePoint> points;
    for (int i = 0; i <= d; ++i)
        for (int j = 0; j < i; ++j) {
            SpacePoint middle{};
            for (int k = 0; k < d; ++k)
                middle[k] = 0.5f * (space.samples[sliver.simplex[i]][k] + space.samples[sliver.simplex[j]][k]);
            points.push_back(middle);
        }
    const CellShape shape = shape_of(percent, space, sliver.simplex);
    if (shape.flat) return points;
    SpacePoint centre = space.samples[sliver.simplex[0]];
    for (int i = 1; i <= d; ++i) {
        Vector edge{};
        for (int k = 0; k < d; ++k) edge[k] = shape.corners[i][k] - shape.corners[0][k];
        for (int k = 0; k < d; ++k)
            centre[k] += static_cast<float>(0.5 * dot(edge, edge) * shape.gradients[i][k] / percent.percent(1, k));
    }
    points.push_back(centre);
    return points;
}

bool is_free(const PercentSpace& percent, const BlendSpace& space, const SpacePoint& point, double too_close) {
    for (int k = 0; k < space.dimensions(); ++k)
        if (!(point[k] >= space.axes[k].low && point[k] <= space.axes[k].high)) return false;
    return std::none_of(space.samples.begin(), space.samples.end(),
                        [&](const SpacePoint& sample) { return percent.distance(sample, point) < too_close; });
}

/// Where a new sample helps most against a sliver, tried out; absent where none of the places helps.
std::optional<SpacePoint> best_refinement(const ProjectSpace& space, const std::vector<Sliver>& slivers,
                                          const Sliver& sliver, double limit, double too_close) {
    const PercentSpace percent(space);
    constexpr double k_worth_it = 0.9;  // a clip that helps by less than a tenth is not worth making
    double least = k_worth_it * badness(slivers, limit);
    std::optional<SpacePoint> best;
    for (const SpacePoint& point : refinements(percent, space.space, sliver)) {
        if (!is_free(percent, space.space, point, too_close)) continue;
        BlendSpace trial = space.space;
        trial.samples.push_back(point);
        triangulate(trial);
        const double left = badness(slivers_of(percent, trial, limit), limit);
        if (left < least) least = left, best = point;
    }
    return best;
}

/// One finding speaks for several cells around one sharp corner where the space has more than two dimensions: there a
/// single clip spoils many.
struct Group {
    Sliver worst;
    int count = 0;
};

std::vector<Group> grouped(const std::vector<Sliver>& slivers, int dimensions) {
    std::vector<Group> groups;
    std::map<int, std::size_t> of_corner;
    for (const Sliver& sliver : slivers) {
        const auto [at, fresh] = of_corner.insert({sliver.simplex[sliver.sharp], groups.size()});
        if (dimensions == 2 || fresh) {
            groups.push_back({sliver, 1});
            continue;
        }
        Group& group = groups[at->second];
        ++group.count;
        if (sliver.angle < group.worst.angle) group.worst = sliver;
    }
    return groups;
}

std::string describe(const Finding& finding, const Group& group, const std::string& sharp, int dimensions) {
    if (dimensions == 2)
        return fmt::format(
            "The triangle of \"{}\", \"{}\" and \"{}\" is a sliver (smallest angle {:.1f} deg): \"{}\" is so near the "
            "line between the others that a small move of the stick switches from them to it, and the character "
            "twitches.",
            finding.clips[0], finding.clips[1], finding.clips[2], group.worst.angle, sharp);
    std::string others;
    for (const std::string& clip : finding.clips)
        if (clip != sharp) others += (others.empty() ? "\"" : ", \"") + clip + "\"";
    return fmt::format(
        "\"{}\" is so near to what {} blend to that a small move of the stick switches from them to it, and the "
        "character twitches ({}sides {:.1f} deg apart).",
        sharp, others, group.count == 1 ? "" : fmt::format("{} flat cells, the worst with ", group.count),
        group.worst.angle);
}

/// Where all corners seem meant to be on one axis (in more dimensions: to have no share in one of the axes): those that
/// are slightly off it. Such a cell should not be at all.
std::vector<int> out_of_line(const LintContext& context, const PercentSpace& percent, const ProjectSpace& space,
                             const Sliver& sliver) {
    const double near = context.threshold("misaligned", "near"), far = context.threshold("misaligned", "far");
    const int d = space.space.dimensions();
    for (int k = 0; k < d; ++k) {
        std::vector<int> off;
        bool meant = true;
        for (int i = 0; i <= d; ++i) {
            const double value = std::fabs(percent.at(sliver.simplex[i], k));
            meant = meant && value < far;
            if (value > near) off.push_back(sliver.simplex[i]);
        }
        if (meant && !off.empty()) return off;
    }
    return {};
}

}  // namespace

void lint_acute_triangle(LintContext& context, const ProjectSpace& space) {
    if (!context.enabled("acute-triangle")) return;
    const int d = space.space.dimensions();
    const PercentSpace percent(space);
    const double limit = context.threshold("acute-triangle", "angle");
    const double too_close = context.threshold("too-close", "distance");
    const std::vector<Sliver> slivers = slivers_of(percent, space.space, limit);
    for (const Group& group : grouped(slivers, d)) {
        Finding finding;
        finding.rule = "acute-triangle";
        finding.space = space.name;
        SpacePoint centre{};
        for (int i = 0; i <= d; ++i) {
            const int corner = group.worst.simplex[i];
            finding.clips.push_back(context.name(space, corner));
            for (int k = 0; k < d; ++k) centre[k] += space.space.samples[corner][k] / static_cast<float>(d + 1);
        }
        finding.at = context.place(space, centre);
        const std::string sharp = finding.clips[group.worst.sharp];
        finding.message = describe(finding, group, sharp, d);
        if (const std::vector<int> out = out_of_line(context, percent, space, group.worst); !out.empty()) {
            std::vector<std::string> clips;
            std::string names;
            for (const int corner : out) {
                clips.push_back(context.name(space, corner));
                names += (names.empty() ? "\"" : ", \"") + clips.back() + "\"";
            }
            finding.fix = Fix{"straighten",
                              "straighten " + names + ": all of these clips seem meant for one axis",
                              space.name,
                              {},
                              clips};
            context.add(std::move(finding));
            continue;
        }
        if (const auto target = best_refinement(space, slivers, group.worst, limit, too_close)) {
            context.ask_for(space, finding, PlaceholderKind::needed, context.place(space, *target));
            continue;
        }
        finding.fix = Fix{"remove",
                          fmt::format("leave out \"{0}\", or replace it by a clip farther from {1}", sharp,
                                      d == 2 ? "the line" : "the others"),
                          space.name,
                          {},
                          {sharp}};
        context.add(std::move(finding));
    }
}

}  // namespace surefoot
