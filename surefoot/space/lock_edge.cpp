#include <surefoot/space/lock_edge.h>
#include <surefoot/space/predicates.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <utility>

namespace surefoot {
namespace {

using Edge = std::array<std::int32_t, 2>;

Edge edge_of(std::int32_t a, std::int32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// Triangles of a plane space with exact geometry, while diagonals are flipped.
class Flipper {
  public:
    explicit Flipper(const BlendSpace& space) : triangles_(space.simplices), points_(to_lattice(space)) {}

    int side(std::int32_t a, std::int32_t b, std::int32_t c) const {
        const LatticePoint corners[3] = {points_[a], points_[b], points_[c]};
        const Wide turn = orientation(2, corners);
        return turn > 0 ? 1 : turn < 0 ? -1 : 0;
    }
    bool cross(const Edge& e, const Edge& f) const {
        return side(e[0], e[1], f[0]) * side(e[0], e[1], f[1]) < 0 &&
               side(f[0], f[1], e[0]) * side(f[0], f[1], e[1]) < 0;
    }
    bool passes_through_a_sample(const Edge& e) const {
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(points_.size()); ++i) {
            if (points_[i] == points_[e[0]] || points_[i] == points_[e[1]] || side(e[0], e[1], i) != 0) continue;
            const auto [low, high] = std::minmax(points_[e[0]], points_[e[1]]);
            if (low < points_[i] && points_[i] < high) return true;
        }
        return false;
    }
    std::deque<Edge> crossed_by(const Edge& wanted) const {
        std::deque<Edge> result;
        for (const auto& [edge, opposite] : edges())
            if (cross(edge, wanted)) result.push_back(edge);
        return result;
    }
    /// Exchanges the diagonal of the two triangles at `edge`; false where their outline is not strictly convex.
    bool flip(const Edge& edge, Edge& flipped) {
        const auto all = edges();
        const auto found = all.find(edge);
        if (found == all.end() || found->second.size() != 2) return false;
        const auto [first, p] = found->second[0];
        const auto [second, q] = found->second[1];
        flipped = edge_of(p, q);
        if (!cross(edge, flipped)) return false;
        set(first, p, q, edge[0]);
        set(second, p, q, edge[1]);
        return true;
    }
    /// Triangles in canonical order with neighbours.
    void finish(BlendSpace& space) {
        std::sort(triangles_.begin(), triangles_.end());
        space.simplices = triangles_;
        space.neighbours.assign(triangles_.size(), {-1, -1, -1, -1, -1});
        for (const auto& [edge, sides] : edges()) {
            if (sides.size() != 2) continue;
            for (int n = 0; n < 2; ++n) {
                const auto [triangle, corner] = sides[n];
                for (int k = 0; k < 3; ++k)
                    if (triangles_[triangle][k] == corner) space.neighbours[triangle][k] = sides[1 - n].first;
            }
        }
    }

  private:
    /// Of every edge: the one or two triangles at it, with the corner opposite.
    std::map<Edge, std::vector<std::pair<std::int32_t, std::int32_t>>> edges() const {
        std::map<Edge, std::vector<std::pair<std::int32_t, std::int32_t>>> result;
        for (std::int32_t t = 0; t < static_cast<std::int32_t>(triangles_.size()); ++t)
            for (int k = 0; k < 3; ++k)
                result[edge_of(triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3])].emplace_back(t,
                                                                                                     triangles_[t][k]);
        return result;
    }
    void set(std::int32_t triangle, std::int32_t a, std::int32_t b, std::int32_t c) {
        std::array<std::int32_t, 3> corners{a, b, c};
        sort_few(corners.data(), 3, std::less<>{});
        if (side(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
        triangles_[triangle] = {corners[0], corners[1], corners[2], -1, -1};
    }

    std::vector<Simplex> triangles_;
    std::vector<LatticePoint> points_;
};

}  // namespace

namespace {

bool is_sample(const BlendSpace& space, std::int32_t i) {
    return i >= 0 && i < static_cast<std::int32_t>(space.samples.size());
}

}  // namespace

bool has_edge(const BlendSpace& space, std::int32_t a, std::int32_t b) noexcept {
    const auto holds = [&](const Simplex& simplex, std::int32_t sample) {
        return std::any_of(simplex.begin(), simplex.end(),
                           [&](std::int32_t s) { return s >= 0 && space.original(s) == space.original(sample); });
    };
    return std::any_of(space.simplices.begin(), space.simplices.end(),
                       [&](const Simplex& simplex) { return holds(simplex, a) && holds(simplex, b); });
}

bool has_simplex(const BlendSpace& space, std::span<const std::int32_t> corners) noexcept {
    for (const Simplex& simplex : space.simplices) {
        const auto end = std::find(simplex.begin(), simplex.end(), -1);
        const auto has = [&](std::int32_t corner) {
            return std::any_of(simplex.begin(), end, [&](std::int32_t s) { return space.original(s) == corner; });
        };
        if (static_cast<std::size_t>(end - simplex.begin()) == corners.size() &&
            std::all_of(corners.begin(), corners.end(), [&](std::int32_t c) { return has(space.original(c)); }))
            return true;
    }
    return false;
}

bool lock_edge(BlendSpace& space, std::int32_t a, std::int32_t b, std::span<const Edge> locked) {
    if (!is_sample(space, a) || !is_sample(space, b) || a == b) return false;
    if (has_edge(space, a, b)) return true;
    const bool flat = space.simplices.empty() || space.simplices[0][space.dimensions()] < 0;
    if (space.dimensions() != 2 || flat || !space.copy_of.empty()) return false;
    Flipper flipper(space);
    const Edge wanted{a, b};
    for (const Edge& other : locked)
        if (flipper.cross(other, wanted)) return false;
    if (flipper.passes_through_a_sample(wanted)) return false;
    std::deque<Edge> crossed = flipper.crossed_by(wanted);
    // Sloan's queue empties within a multiple of its length squared; the bound only guards against misuse.
    std::size_t patience = 16 * (crossed.size() + 1) * (crossed.size() + 1);
    while (!crossed.empty()) {
        if (patience-- == 0) return false;
        const Edge edge = crossed.front();
        crossed.pop_front();
        Edge flipped;
        if (!flipper.flip(edge, flipped))
            crossed.push_back(edge);
        else if (flipper.cross(flipped, wanted))
            crossed.push_back(flipped);
    }
    flipper.finish(space);
    return has_edge(space, a, b);
}

bool lock_simplex(BlendSpace& space, std::span<const std::int32_t> corners, std::span<const Edge> locked) {
    const auto count = static_cast<std::size_t>(space.dimensions()) + 1;
    if (corners.size() != count) return false;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!is_sample(space, corners[i]) || !is_sample(space, corners[j]) || corners[i] == corners[j])
                return false;
    if (space.dimensions() != 2) return has_simplex(space, corners);
    BlendSpace changed = space;
    std::vector<Edge> held(locked.begin(), locked.end());
    for (std::size_t i = 0; i < 3; ++i) {
        const Edge edge{corners[i], corners[(i + 1) % 3]};
        if (!lock_edge(changed, edge[0], edge[1], held)) return false;
        held.push_back(edge);
    }
    if (!has_simplex(changed, corners)) return false;
    space = std::move(changed);
    return true;
}

}  // namespace surefoot
