#include <surefoot/space/lookup.h>
#include <surefoot/space/slice.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace surefoot {
namespace {

/// A function a + b x + c y on the plane.
struct Affine {
    double a = 0, b = 0, c = 0;

    double operator()(const PlanePoint& p) const { return a + b * p[0] + c * p[1]; }
};

/// The part of a convex polygon where `inside` is not negative (Sutherland & Hodgman 1974).
std::vector<PlanePoint> clipped(const std::vector<PlanePoint>& polygon, const Affine& inside) {
    std::vector<PlanePoint> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const PlanePoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = inside(p), at_q = inside(q);
        if (at_p >= 0) result.push_back(p);
        if ((at_p < 0) == (at_q < 0)) continue;
        const double t = at_p / (at_p - at_q);
        result.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
    }
    return result;
}

double area_of(const std::vector<PlanePoint>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const PlanePoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        twice += p[0] * q[1] - q[0] * p[1];
    }
    return 0.5 * twice;
}

/// Corners that lie on one another are one.
void merge_corners(std::vector<PlanePoint>& polygon, double near) {
    const auto same = [&](const PlanePoint& p, const PlanePoint& q) {
        return std::fabs(p[0] - q[0]) <= near && std::fabs(p[1] - q[1]) <= near;
    };
    polygon.erase(std::unique(polygon.begin(), polygon.end(), same), polygon.end());
    while (polygon.size() > 1 && same(polygon.front(), polygon.back())) polygon.pop_back();
}

class Slicer {
  public:
    Slicer(const BlendSpace& space, const SpacePoint& at, int right, int up)
        : space_(space), d_(space.dimensions()), axes_{right, up}, lookup_(space), at_(lookup_.scaled(at)) {
        for (int n = 0; n < 2; ++n) {
            low_[n] = high_[n] = at_[axes_[n]];
            for (std::int32_t i = 0; i < static_cast<std::int32_t>(space.samples.size()); ++i) {
                low_[n] = std::min(low_[n], lookup_.sample(i)[axes_[n]]);
                high_[n] = std::max(high_[n], lookup_.sample(i)[axes_[n]]);
            }
        }
    }

    /// What of a simplex lies in the plane, in shares of ranges; empty where next to nothing does.
    std::vector<PlanePoint> cut(const Simplex& simplex) const {
        constexpr double k_least_area = 1e-12;  // of a range squared
        std::vector<PlanePoint> polygon{
            {low_[0], low_[1]}, {high_[0], low_[1]}, {high_[0], high_[1]}, {low_[0], high_[1]}};
        for (int k = 0; k <= d_ && polygon.size() > 2; ++k) {
            Affine weight;
            if (!weight_of_corner(simplex, k, weight)) return {};
            polygon = clipped(polygon, weight);
        }
        merge_corners(polygon, 1e-9);
        if (polygon.size() < 3 || area_of(polygon) < k_least_area) return {};
        return polygon;
    }

    /// Whether the plane's point lies in a simplex, or on its border.
    bool holds_point(const Simplex& simplex) const {
        constexpr double k_border = -1e-7;
        CornerWeights w;
        return lookup_.barycentric(simplex, at_, w) &&
               std::all_of(w.begin(), w.begin() + d_ + 1, [](double weight) { return weight >= k_border; });
    }

    PlanePoint unscaled(const PlanePoint& p) const {
        PlanePoint result;
        for (int n = 0; n < 2; ++n) {
            const Axis& axis = space_.axes[axes_[n]];
            result[n] = p[n] * (static_cast<double>(axis.high) - axis.low);
        }
        return result;
    }

  private:
    /// A corner's barycentric weight on the plane: affine, so three values say all of it.
    bool weight_of_corner(const Simplex& simplex, int corner, Affine& weight) const {
        const auto value = [&](double x, double y, double& w) {
            ScaledPoint p = at_;
            p[axes_[0]] = x;
            p[axes_[1]] = y;
            CornerWeights all;
            if (!lookup_.barycentric(simplex, p, all)) return false;
            w = all[corner];
            return true;
        };
        double origin, right, up;
        if (!value(low_[0], low_[1], origin) || !value(low_[0] + 1, low_[1], right) || !value(low_[0], low_[1] + 1, up))
            return false;
        weight.b = right - origin;
        weight.c = up - origin;
        weight.a = origin - weight.b * low_[0] - weight.c * low_[1];
        return true;
    }

    const BlendSpace& space_;
    int d_;
    std::array<int, 2> axes_;
    Lookup lookup_;
    ScaledPoint at_;
    double low_[2], high_[2];  // of all samples, and so of all that is cut
};

}  // namespace

SpaceSlice slice(const BlendSpace& space, const SpacePoint& at, int right, int up) {
    assert(right != up && right >= 0 && up >= 0 && right < space.dimensions() && up < space.dimensions());
    SpaceSlice result;
    result.axes = {right, up};
    result.at = at;
    result.live = blend_weights(space, at);
    if (space.simplices.empty() || space.simplices[0][space.dimensions()] < 0) return result;
    const Slicer slicer(space, at, right, up);
    for (std::int32_t s = 0; s < static_cast<std::int32_t>(space.simplices.size()); ++s) {
        SliceCell cell{s, slicer.cut(space.simplices[s])};
        if (cell.polygon.empty()) continue;
        for (PlanePoint& p : cell.polygon) p = slicer.unscaled(p);
        if (s == result.live.simplex) result.live_cell = static_cast<int>(result.cells.size());
        result.cells.push_back(std::move(cell));
    }
    // A point on a face belongs to all simplices around it; the plane may touch just the one that was named.
    for (std::size_t c = 0; c < result.cells.size() && result.live_cell < 0; ++c)
        if (slicer.holds_point(space.simplices[result.cells[c].simplex])) result.live_cell = static_cast<int>(c);
    return result;
}

}  // namespace surefoot
