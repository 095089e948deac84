#include <surefoot/space/blend_space.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr int k_corners = k_max_dimensions + 1;
/// Weights above this count as inside: rounding at a face shared by two simplices must not send a point to and fro.
constexpr double k_inside = -1e-9;

using Point = std::array<double, k_max_dimensions>;
using Weights = std::array<double, k_corners>;

/// The space as the lookup sees it: axes scaled to ranges of 1, so that distances compare.
class Lookup {
  public:
    explicit Lookup(const BlendSpace& space) noexcept : space_(space), d_(space.dimensions()) {
        for (int k = 0; k < d_; ++k) scale_[k] = 1.0 / (static_cast<double>(space.axes[k].high) - space.axes[k].low);
    }

    Point scaled(const SpacePoint& p) const noexcept {
        Point q{};
        for (int k = 0; k < d_; ++k) q[k] = p[k] * scale_[k];
        return q;
    }

    /// Corners of a simplex, all of them but `without`; returns how many.
    int corners(const Simplex& simplex, int without, Point* points, int* slots) const noexcept {
        int count = 0;
        for (int k = 0; k <= d_ && simplex[k] >= 0; ++k) {
            if (k == without) continue;
            points[count] = scaled(space_.samples[simplex[k]]);
            slots[count++] = k;
        }
        return count;
    }

    bool is_full(const Simplex& simplex) const noexcept { return simplex[d_] >= 0; }

    /// Barycentric weights of `p` in a full simplex; false where it is flat in floating point.
    bool barycentric(const Simplex& simplex, const Point& p, Weights& w) const noexcept {
        const Point origin = scaled(space_.samples[simplex[0]]);
        double m[k_max_dimensions][k_max_dimensions + 1];
        for (int c = 0; c < d_; ++c) {
            const Point corner = scaled(space_.samples[simplex[c + 1]]);
            for (int r = 0; r < d_; ++r) m[r][c] = corner[r] - origin[r];
        }
        for (int r = 0; r < d_; ++r) m[r][d_] = p[r] - origin[r];
        double rest[k_max_dimensions];
        if (!solve(m, d_, rest)) return false;
        w.fill(0);
        w[0] = 1;
        for (int k = 0; k < d_; ++k) {
            w[k + 1] = rest[k];
            w[0] -= rest[k];
        }
        return true;
    }

    /// Nearest point to `p` of the simplex of `count` corners; returns the squared distance.
    double nearest(const Point& p, const Point* corner, int count, double* w) const noexcept {
        if (count > 1 && !project(p, corner, count, w)) {
            for (int k = 0; k < count; ++k) w[k] = 0;  // corners (nearly) dependent: the faces decide
            return nearest_face(p, corner, count, w, false);
        }
        if (count == 1) w[0] = 1;
        for (int k = 0; k < count; ++k)
            if (w[k] < 0) return nearest_face(p, corner, count, w, true);
        double square = 0;
        for (int r = 0; r < d_; ++r) {
            double delta = -p[r];
            for (int k = 0; k < count; ++k) delta += w[k] * corner[k][r];
            square += delta * delta;
        }
        return square;
    }

  private:
    /// Gaussian elimination with row pivots of n equations, the right side in column n.
    static bool solve(double (&m)[k_max_dimensions][k_max_dimensions + 1], int n, double* x) noexcept {
        for (int c = 0; c < n; ++c) {
            int pivot = c;
            for (int r = c + 1; r < n; ++r)
                if (std::fabs(m[r][c]) > std::fabs(m[pivot][c])) pivot = r;
            if (!(std::fabs(m[pivot][c]) > 1e-30)) return false;
            if (pivot != c)
                for (int k = c; k <= n; ++k) std::swap(m[c][k], m[pivot][k]);
            for (int r = c + 1; r < n; ++r) {
                const double f = m[r][c] / m[c][c];
                for (int k = c; k <= n; ++k) m[r][k] -= f * m[c][k];
            }
        }
        for (int r = n - 1; r >= 0; --r) {
            double sum = m[r][n];
            for (int k = r + 1; k < n; ++k) sum -= m[r][k] * x[k];
            x[r] = sum / m[r][r];
        }
        return true;
    }

    /// Affine weights of the orthogonal projection of `p` onto the span of the corners (normal equations).
    bool project(const Point& p, const Point* corner, int count, double* w) const noexcept {
        const int n = count - 1;
        double m[k_max_dimensions][k_max_dimensions + 1];
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j <= n; ++j) {
                const Point& other = j < n ? corner[j + 1] : p;
                m[i][j] = 0;
                for (int r = 0; r < d_; ++r) m[i][j] += (corner[i + 1][r] - corner[0][r]) * (other[r] - corner[0][r]);
            }
        }
        double rest[k_max_dimensions];
        if (!solve(m, n, rest)) return false;
        w[0] = 1;
        for (int k = 0; k < n; ++k) {
            w[k + 1] = rest[k];
            w[0] -= rest[k];
        }
        return true;
    }

    /// The nearest point lies on a face opposite a corner of negative weight (one that `p` sees).
    double nearest_face(const Point& p, const Point* corner, int count, double* w, bool only_seen) const noexcept {
        double best = 1e300, best_w[k_corners] = {};
        for (int drop = 0; drop < count; ++drop) {
            if (only_seen && w[drop] >= 0) continue;
            Point face[k_corners];
            double face_w[k_corners] = {};
            for (int k = 0, n = 0; k < count; ++k)
                if (k != drop) face[n++] = corner[k];
            const double square = nearest(p, face, count - 1, face_w);
            if (square >= best) continue;
            best = square;
            for (int k = 0, n = 0; k < count; ++k) best_w[k] = k == drop ? 0 : face_w[n++];
        }
        for (int k = 0; k < count; ++k) w[k] = best_w[k];
        return best;
    }

    const BlendSpace& space_;
    int d_;
    Point scale_{};
};

double smallest(const Weights& w, int count, int& slot) noexcept {
    slot = 0;
    for (int k = 1; k < count; ++k)
        if (w[k] < w[slot]) slot = k;
    return w[slot];
}

/// Finite, and wrapping axes turned back into their range.
SpacePoint tamed(const BlendSpace& space, const SpacePoint& point) noexcept {
    constexpr float k_far = 1000;  // ranges: farther out the nearest hull point is the same for all practical purposes
    SpacePoint p{};
    for (int k = 0; k < space.dimensions(); ++k) {
        const Axis& axis = space.axes[k];
        const float range = axis.high - axis.low, low = axis.low - k_far * range, high = axis.high + k_far * range;
        p[k] = point[k] != point[k] ? 0.0f : point[k] < low ? low : point[k] > high ? high : point[k];
        if (axis.wraps) p[k] -= std::floor((p[k] - axis.low) / range) * range;
    }
    return p;
}

BlendWeights answer(const BlendSpace& space, std::int32_t simplex, const Weights& w, const SpacePoint& asked,
                    bool clamped) noexcept {
    BlendWeights result;
    result.samples.fill(-1);
    result.simplex = simplex;
    result.clamped = clamped;
    double sum = 0;
    for (const double weight : w) sum += weight > 0 ? weight : 0;
    for (int k = 0; k < k_corners; ++k) {
        const auto weight = static_cast<float>(w[k] / sum);
        if (!(weight > 0)) continue;
        result.samples[result.count] = space.simplices[simplex][k];
        result.weights[result.count++] = weight;
    }
    result.point = asked;
    if (clamped) {
        for (int r = 0; r < space.dimensions(); ++r) {
            double at = 0;
            for (int k = 0; k < result.count; ++k)
                at += static_cast<double>(result.weights[k]) * space.samples[result.samples[k]][r];
            result.point[r] = static_cast<float>(at);
        }
    }
    return result;
}

/// The nearest point of the hull: on a boundary face that `point` sees, or, where samples span fewer dimensions than
/// there are axes, anywhere on the simplices.
BlendWeights clamp_to_hull(const BlendSpace& space, const Lookup& lookup, const SpacePoint& asked,
                           const Point& p) noexcept {
    double best = 1e300;
    Weights best_w{};
    std::int32_t best_simplex = -1;
    const int corner_count = space.dimensions() + 1;
    const auto consider = [&](std::int32_t s, int without) noexcept {
        Point corner[k_corners];
        int slots[k_corners];
        double w[k_corners];
        const int count = lookup.corners(space.simplices[s], without, corner, slots);
        const double square = lookup.nearest(p, corner, count, w);
        if (!(square < best)) return;
        best = square;
        best_simplex = s;
        best_w.fill(0);
        for (int k = 0; k < count; ++k) best_w[slots[k]] = w[k];
    };
    for (std::int32_t s = 0; s < static_cast<std::int32_t>(space.simplices.size()); ++s) {
        if (!lookup.is_full(space.simplices[s])) {
            consider(s, -1);
            continue;
        }
        const Simplex& next = space.neighbours[s];
        if (std::find(next.begin(), next.begin() + corner_count, -1) == next.begin() + corner_count) continue;
        Weights w;
        if (!lookup.barycentric(space.simplices[s], p, w)) continue;
        for (int k = 0; k < corner_count; ++k)
            if (next[k] < 0 && w[k] < 0) consider(s, k);
    }
    if (best_simplex < 0) {  // a hair's breadth inside by rounding: any face will do
        for (std::int32_t s = 0; s < static_cast<std::int32_t>(space.simplices.size()); ++s) consider(s, -1);
    }
    return answer(space, best_simplex, best_w, asked, best > 0);
}

}  // namespace

BlendWeights blend_weights(const BlendSpace& space, const SpacePoint& point, std::int32_t hint) noexcept {
    const SpacePoint asked = tamed(space, point);
    const Lookup lookup(space);
    const Point p = lookup.scaled(asked);
    const auto count = static_cast<std::int32_t>(space.simplices.size());
    if (count == 0) {  // never triangulated: all that can be said is the first sample
        BlendWeights result;
        result.samples.fill(-1);
        if (space.samples.empty()) return result;
        result.samples[0] = 0;
        result.weights[0] = 1;
        result.count = 1;
        result.point = space.samples[0];
        result.clamped = true;
        return result;
    }
    if (!lookup.is_full(space.simplices[0])) return clamp_to_hull(space, lookup, asked, p);

    const int corner_count = space.dimensions() + 1;
    std::int32_t s = hint >= 0 && hint < count ? hint : 0;
    Weights w;
    for (std::int32_t steps = 0; steps <= count; ++steps) {
        if (!lookup.barycentric(space.simplices[s], p, w)) break;
        int slot;
        if (smallest(w, corner_count, slot) >= k_inside) return answer(space, s, w, asked, false);
        const std::int32_t next = space.neighbours[s][slot];
        if (next < 0) return clamp_to_hull(space, lookup, asked, p);
        s = next;
    }
    // The walk met a sliver, or went round in circles by rounding: look everywhere.
    std::int32_t best = -1;
    double best_low = -1e300;
    Weights best_w{};
    for (s = 0; s < count; ++s) {
        int slot;
        if (!lookup.barycentric(space.simplices[s], p, w)) continue;
        if (const double low = smallest(w, corner_count, slot); low > best_low) {
            best_low = low;
            best = s;
            best_w = w;
        }
    }
    constexpr double k_nearly_inside = -1e-5;  // of a face between two slivers
    if (best_low >= k_nearly_inside) return answer(space, best, best_w, asked, false);
    return clamp_to_hull(space, lookup, asked, p);
}

std::string problem(const BlendSpace& space) {
    const int d = space.dimensions();
    if (d < 1 || d > k_max_dimensions) return "a blend space has 1 to 4 axes, not " + std::to_string(d);
    for (const Axis& axis : space.axes)
        if (!std::isfinite(axis.low) || !std::isfinite(axis.high) || !(axis.low < axis.high))
            return "axis \"" + axis.name + "\" needs a low limit below its high one";
    if (space.samples.empty()) return "a blend space needs at least one sample";
    for (std::size_t i = 0; i < space.samples.size(); ++i)
        for (int k = 0; k < d; ++k)
            if (!std::isfinite(space.samples[i][k]))
                return "sample " + std::to_string(i) + " has no finite place on axis \"" + space.axes[k].name + "\"";
    if (space.neighbours.size() != space.simplices.size())
        return "there are " + std::to_string(space.simplices.size()) + " simplices but neighbours of " +
               std::to_string(space.neighbours.size());
    const auto samples = static_cast<std::int32_t>(space.samples.size());
    const auto simplices = static_cast<std::int32_t>(space.simplices.size());
    int rank = -1;
    for (std::int32_t s = 0; s < simplices; ++s) {
        const std::string where = "simplex " + std::to_string(s);
        int corners = 0;
        while (corners < k_corners && space.simplices[s][corners] >= 0) ++corners;
        if (corners < 1 || corners > d + 1) return where + " has " + std::to_string(corners) + " corners";
        if (rank >= 0 && corners != rank) return where + " has another number of corners than the ones before";
        rank = corners;
        for (int k = 0; k < k_corners; ++k) {
            const std::int32_t sample = space.simplices[s][k], next = space.neighbours[s][k];
            if (k >= corners ? sample != -1 || next != -1 : sample >= samples || next < -1 || next >= simplices)
                return where + " names a sample or neighbour that does not exist";
            for (int j = 0; j < k; ++j)
                if (k < corners && space.simplices[s][j] == sample) return where + " names a sample twice";
        }
    }
    for (std::int32_t s = 0; s < simplices; ++s)
        for (int k = 0; k < rank; ++k) {
            const std::int32_t next = space.neighbours[s][k];
            if (next < 0) continue;
            const Simplex& back = space.neighbours[next];
            if (std::find(back.begin(), back.begin() + rank, s) == back.begin() + rank)
                return "simplex " + std::to_string(next) + " is a neighbour of simplex " + std::to_string(s) +
                       " but not the other way round";
        }
    return {};
}

}  // namespace surefoot
