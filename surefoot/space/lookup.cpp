#include <surefoot/space/lookup.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

/// Weights above this count as inside: rounding at a face shared by two simplices must not send a point to and fro.
constexpr double k_inside = -1e-9;

using Equations = double[k_max_dimensions][k_max_dimensions + 1];

/// Gaussian elimination with row pivots of n equations, the right side in column n.
template <int n>
bool eliminate(Equations& m, double* x) noexcept {
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

/// The same, its loops unrolled for each number of equations.
bool solve(Equations& m, int n, double* x) noexcept {
    static_assert(k_max_dimensions == 4);
    switch (n) {
        case 1:
            return eliminate<1>(m, x);
        case 2:
            return eliminate<2>(m, x);
        case 3:
            return eliminate<3>(m, x);
        default:
            return eliminate<4>(m, x);
    }
}

double smallest(const CornerWeights& w, int count, int& slot) noexcept {
    slot = 0;
    for (int k = 1; k < count; ++k)
        if (w[k] < w[slot]) slot = k;
    return w[slot];
}

}  // namespace

Lookup::Lookup(const BlendSpace& space) noexcept : space_(space), d_(space.dimensions()) {
    for (int k = 0; k < d_; ++k) scale_[k] = 1.0 / (static_cast<double>(space.axes[k].high) - space.axes[k].low);
}

ScaledPoint Lookup::mean(const Located& at) const noexcept {
    ScaledPoint sum{};
    const Simplex& simplex = space_.simplices[at.simplex];
    for (int n = 0; n <= d_ && simplex[n] >= 0; ++n) {
        const ScaledPoint corner = sample(simplex[n]);
        for (int k = 0; k < d_; ++k) sum[k] += at.weights[n] * corner[k];
    }
    return sum;
}

/// Corners of a simplex, all of them but `without`; returns how many.
int Lookup::corners(const Simplex& simplex, int without, ScaledPoint* points, int* slots) const noexcept {
    int count = 0;
    for (int k = 0; k <= d_ && simplex[k] >= 0; ++k) {
        if (k == without) continue;
        points[count] = scaled(space_.samples[simplex[k]]);
        slots[count++] = k;
    }
    return count;
}

bool Lookup::barycentric(const Simplex& simplex, const ScaledPoint& p, CornerWeights& w) const noexcept {
    const ScaledPoint origin = scaled(space_.samples[simplex[0]]);
    double m[k_max_dimensions][k_max_dimensions + 1];
    for (int c = 0; c < d_; ++c) {
        const ScaledPoint corner = scaled(space_.samples[simplex[c + 1]]);
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
double Lookup::nearest(const ScaledPoint& p, const ScaledPoint* corner, int count, double* w) const noexcept {
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

/// Affine weights of the orthogonal projection of `p` onto the span of the corners (normal equations).
bool Lookup::project(const ScaledPoint& p, const ScaledPoint* corner, int count, double* w) const noexcept {
    const int n = count - 1;
    double m[k_max_dimensions][k_max_dimensions + 1];
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= n; ++j) {
            const ScaledPoint& other = j < n ? corner[j + 1] : p;
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
double Lookup::nearest_face(const ScaledPoint& p, const ScaledPoint* corner, int count, double* w,
                            bool only_seen) const noexcept {
    double best = 1e300, best_w[k_corners] = {};
    for (int drop = 0; drop < count; ++drop) {
        if (only_seen && w[drop] >= 0) continue;
        ScaledPoint face[k_corners];
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

/// The nearest point of the hull: on a boundary face that `p` sees, or, where samples span fewer dimensions than there
/// are axes, anywhere on the simplices.
Located Lookup::clamp_to_hull(const ScaledPoint& p) const noexcept {
    double best = 1e300;
    Located found{-1, {}, true};
    const int corner_count = d_ + 1;
    const auto consider = [&](std::int32_t s, int without) noexcept {
        ScaledPoint corner[k_corners];
        int slots[k_corners];
        double w[k_corners];
        const int count = corners(space_.simplices[s], without, corner, slots);
        const double square = nearest(p, corner, count, w);
        if (!(square < best)) return;
        best = square;
        found.simplex = s;
        found.weights.fill(0);
        for (int k = 0; k < count; ++k) found.weights[slots[k]] = w[k];
    };
    const auto count = static_cast<std::int32_t>(space_.simplices.size());
    for (std::int32_t s = 0; s < count; ++s) {
        if (!is_full(space_.simplices[s])) {
            consider(s, -1);
            continue;
        }
        const Simplex& next = space_.neighbours[s];
        if (std::find(next.begin(), next.begin() + corner_count, -1) == next.begin() + corner_count) continue;
        CornerWeights w;
        if (!barycentric(space_.simplices[s], p, w)) continue;
        for (int k = 0; k < corner_count; ++k)
            if (next[k] < 0 && w[k] < 0) consider(s, k);
    }
    if (found.simplex < 0) {  // a hair's breadth inside by rounding: any face will do
        for (std::int32_t s = 0; s < count; ++s) consider(s, -1);
    }
    found.outside = best > 0;
    return found;
}

Located Lookup::locate(const ScaledPoint& p, std::int32_t hint) const noexcept {
    if (!is_full(space_.simplices[0])) return clamp_to_hull(p);
    const auto count = static_cast<std::int32_t>(space_.simplices.size());
    const int corner_count = d_ + 1;
    std::int32_t s = hint >= 0 && hint < count ? hint : 0;
    CornerWeights w;
    for (std::int32_t steps = 0; steps <= count; ++steps) {
        if (!barycentric(space_.simplices[s], p, w)) break;
        int slot;
        if (smallest(w, corner_count, slot) >= k_inside) return {s, w, false};
        const std::int32_t next = space_.neighbours[s][slot];
        if (next < 0) return clamp_to_hull(p);
        s = next;
    }
    // The walk met a sliver, or went round in circles by rounding: look everywhere.
    Located best{-1, {}, false};
    double best_low = -1e300;
    for (s = 0; s < count; ++s) {
        int slot;
        if (!barycentric(space_.simplices[s], p, w)) continue;
        if (const double low = smallest(w, corner_count, slot); low > best_low) {
            best_low = low;
            best.simplex = s;
            best.weights = w;
        }
    }
    constexpr double k_nearly_inside = -1e-5;  // of a face between two slivers
    return best_low >= k_nearly_inside ? best : clamp_to_hull(p);
}

}  // namespace surefoot
