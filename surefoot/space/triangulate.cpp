// Incremental Delaunay (Bowyer 1981, Watson 1981) with a vertex at infinity: every face of the hull is closed off by a
// "ghost" cell, so that inserting a point outside the hull is the same operation as inserting one inside.
//
// Why it is right in degenerate positions, too: a ghost cell conflicts with a point strictly beyond its facet. For a
// point in the facet's plane, conflict means lying in the facet's own circumsphere, which is the plane's section of the
// circumsphere of the finite cell behind it: so the answer of that cell is taken over. Since the (perturbed) in-sphere
// answers of two cells agree for a point in the plane of their common face, no face on the border of a conflict region
// is coplanar with the new point, and no cell of zero volume ever arises.

#include <surefoot/space/predicates.h>
#include <surefoot/space/triangulate.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace surefoot {
namespace {

constexpr std::int32_t k_infinite = -2;
constexpr std::int32_t k_none = -1;

struct Cell {
    Simplex vertices, neighbours;
    bool alive = true;
};

/// The face opposite vertex `slot`, as a key: its vertices in order.
Simplex face_key(const Cell& cell, int slot) {
    Simplex key = cell.vertices;
    key[slot] = k_none;
    sort_few(key.data(), k_max_dimensions + 1, std::less<>{});
    return key;
}

class Delaunay {
  public:
    Delaunay(int dimensions, std::span<const LatticePoint> points) : d_(dimensions), points_(points) {}

    /// Points must be distinct and span all dimensions; `basis` names d + 1 independent ones.
    void run(const Simplex& basis) {
        start(basis);
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(points_.size()); ++i)
            if (std::find(basis.begin(), basis.end(), i) == basis.end()) insert(i);
    }

    void finish(Triangulation& result) const {
        std::vector<std::int32_t> index(cells_.size(), k_none);
        std::vector<std::int32_t> kept;
        for (std::size_t c = 0; c < cells_.size(); ++c)
            if (cells_[c].alive && ghost_slot(cells_[c]) < 0) kept.push_back(static_cast<std::int32_t>(c));
        std::vector<Cell> cells;
        for (const std::int32_t c : kept) cells.push_back(sorted(cells_[c]));
        std::vector<std::int32_t> order(kept.size());
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(),
                  [&](std::int32_t a, std::int32_t b) { return cells[a].vertices < cells[b].vertices; });
        for (std::size_t n = 0; n < order.size(); ++n) index[kept[order[n]]] = static_cast<std::int32_t>(n);
        for (const std::int32_t n : order) {
            Simplex neighbours = cells[n].neighbours;
            for (int k = 0; k <= d_; ++k) neighbours[k] = index[neighbours[k]];  // ghosts have no index: -1
            for (int k = d_ + 1; k <= k_max_dimensions; ++k) neighbours[k] = k_none;
            result.simplices.push_back(cells[n].vertices);
            result.neighbours.push_back(neighbours);
        }
    }

  private:
    int ghost_slot(const Cell& cell) const {
        for (int k = 0; k <= d_; ++k)
            if (cell.vertices[k] == k_infinite) return k;
        return -1;
    }

    std::array<LatticePoint, k_max_dimensions + 1> corners(const Simplex& vertices) const {
        std::array<LatticePoint, k_max_dimensions + 1> result{};
        for (int k = 0; k <= d_; ++k)
            if (vertices[k] >= 0) result[k] = points_[vertices[k]];
        return result;
    }

    void start(const Simplex& basis) {
        Cell first;
        first.vertices = basis;
        first.neighbours.fill(k_none);
        if (orientation(d_, corners(basis).data()) < 0) std::swap(first.vertices[0], first.vertices[1]);
        cells_.push_back(first);
        std::vector<std::int32_t> all{0};
        for (int k = 0; k <= d_; ++k) {
            Cell ghost = first;
            ghost.vertices[k] = k_infinite;
            std::swap(ghost.vertices[k], ghost.vertices[(k + 1) % (d_ + 1)]);  // outward: the other orientation
            all.push_back(static_cast<std::int32_t>(cells_.size()));
            cells_.push_back(ghost);
        }
        link(all);
    }

    /// Joins the faces that two of `cells` share; every face that is not yet linked has its twin among them.
    void link(const std::vector<std::int32_t>& cells) {
        std::map<Simplex, std::pair<std::int32_t, int>> open;
        for (const std::int32_t c : cells)
            for (int k = 0; k <= d_; ++k) {
                if (cells_[c].neighbours[k] != k_none) continue;
                const auto [twin, is_new] = open.try_emplace(face_key(cells_[c], k), c, k);
                if (is_new) continue;
                cells_[c].neighbours[k] = twin->second.first;
                cells_[twin->second.first].neighbours[twin->second.second] = c;
                open.erase(twin);
            }
    }

    bool conflicts(const Cell& cell, const LatticePoint& p) const {
        const int ghost = ghost_slot(cell);
        auto shape = corners(cell.vertices);
        if (ghost < 0) return in_sphere(d_, shape.data(), p);
        shape[ghost] = p;
        const Wide side = orientation(d_, shape.data());
        return side != 0 ? side > 0 : conflicts(cells_[cell.neighbours[ghost]], p);
    }

    void insert(std::int32_t point) {
        const LatticePoint& p = points_[point];
        std::vector<std::int32_t> region;
        // Points come in order of position, so a cell in conflict is among the youngest.
        for (std::size_t c = cells_.size(); c-- > 0 && region.empty();)
            if (cells_[c].alive && conflicts(cells_[c], p)) region.push_back(static_cast<std::int32_t>(c));
        const std::int32_t inside = 2 * point + 1, outside = inside + 1;  // as marks of this insertion
        marks_.resize(cells_.size(), 0);
        marks_[region.front()] = inside;

        std::vector<std::int32_t> created;
        for (std::size_t n = 0; n < region.size(); ++n) {
            for (int k = 0; k <= d_; ++k) {
                const std::int32_t next = cells_[region[n]].neighbours[k];
                if (marks_[next] != inside && marks_[next] != outside) {
                    marks_[next] = conflicts(cells_[next], p) ? inside : outside;
                    if (marks_[next] == inside) region.push_back(next);
                }
                if (marks_[next] == inside) continue;
                created.push_back(static_cast<std::int32_t>(cells_.size()));
                add_cell(cells_[region[n]], k, point, next);
            }
        }
        for (const std::int32_t c : region) cells_[c].alive = false;
        link(created);
    }

    /// `old` with its vertex `slot` replaced by the new point; across the face opposite that, `outside` stays.
    void add_cell(const Cell& old, int slot, std::int32_t point, std::int32_t outside) {
        const Simplex key = face_key(old, slot);
        Cell cell;
        cell.vertices = old.vertices;
        cell.vertices[slot] = point;
        cell.neighbours.fill(k_none);
        cell.neighbours[slot] = outside;
        Cell& other = cells_[outside];
        for (int k = 0; k <= d_; ++k)
            if (face_key(other, k) == key) other.neighbours[k] = static_cast<std::int32_t>(cells_.size());
        cells_.push_back(cell);
    }

    /// Vertices in ascending order but for the last two, which are swapped where the orientation asks for it.
    Cell sorted(const Cell& cell) const {
        std::array<int, k_max_dimensions + 1> order{0, 1, 2, 3, 4};
        sort_few(order.data(), d_ + 1, [&](int a, int b) { return cell.vertices[a] < cell.vertices[b]; });
        Cell result = cell;
        const auto apply = [&] {
            for (int k = 0; k <= d_; ++k) {
                result.vertices[k] = cell.vertices[order[k]];
                result.neighbours[k] = cell.neighbours[order[k]];
            }
        };
        apply();
        if (orientation(d_, corners(result.vertices).data()) < 0) {
            std::swap(order[d_ - 1], order[d_]);
            apply();
        }
        return result;
    }

    int d_;
    std::span<const LatticePoint> points_;
    std::vector<Cell> cells_;
    std::vector<std::int32_t> marks_;  // by cell: how the last insertion that looked at it found it
};

/// A choice of `rank` axes onto which the points can be dropped without two falling together: their projection spans
/// as much as they do. There always is one.
std::array<int, k_max_dimensions> spanning_axes(int dimensions, int rank, std::span<const LatticePoint> points) {
    std::array<int, k_max_dimensions> axes{0, 1, 2, 3};
    Simplex basis;
    for (unsigned mask = 1; mask < (1u << dimensions); ++mask) {
        int count = 0;
        for (int k = 0; k < dimensions; ++k)
            if (mask >> k & 1u) axes[count++] = k;
        if (count != rank) continue;
        std::vector<LatticePoint> dropped;
        for (const LatticePoint& p : points) {
            LatticePoint q{};
            for (int k = 0; k < rank; ++k) q[k] = p[axes[k]];
            dropped.push_back(q);
        }
        if (affine_rank(rank, dropped, basis) == rank) break;
    }
    return axes;
}

}  // namespace

Triangulation triangulate(int dimensions, std::span<const LatticePoint> points) {
    Triangulation result;
    // Distinct places in order of position, each with the first point that stands there.
    std::map<LatticePoint, std::int32_t> places;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [place, is_new] = places.try_emplace(points[i], static_cast<std::int32_t>(i));
        result.same_as.push_back(place->second);
    }
    if (places.empty()) return result;
    std::vector<LatticePoint> distinct;
    std::vector<std::int32_t> first;
    for (const auto& [position, index] : places) {
        distinct.push_back(position);
        first.push_back(index);
    }

    Simplex basis;
    result.rank = affine_rank(dimensions, distinct, basis);
    if (result.rank == 0) {
        result.simplices.push_back({first[0], -1, -1, -1, -1});
        result.neighbours.push_back({-1, -1, -1, -1, -1});
        return result;
    }
    if (result.rank < dimensions) {
        const auto axes = spanning_axes(dimensions, result.rank, distinct);
        for (LatticePoint& p : distinct) {
            LatticePoint q{};
            for (int k = 0; k < result.rank; ++k) q[k] = p[axes[k]];
            p = q;
        }
    }
    Delaunay delaunay(result.rank, distinct);
    delaunay.run(basis);
    delaunay.finish(result);
    for (Simplex& simplex : result.simplices)
        for (std::int32_t& vertex : simplex)
            if (vertex >= 0) vertex = first[vertex];
    return result;
}

namespace {

/// Steps of an axis' range, numbers of many divisors: halves, thirds, tenths, fortieths of an axis are lattice points,
/// so that sets which are symmetric, gridded or in line stay so.
constexpr int k_used_steps = 65520;
int steps_of(const Axis& axis) { return k_used_steps / (axis.wraps ? 3 : 2); }

}  // namespace

LatticePoint to_lattice(std::span<const Axis> axes, const SpacePoint& point) {
    LatticePoint result{};
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const int steps = steps_of(axes[k]);
        const double range = static_cast<double>(axes[k].high) - axes[k].low;
        const double share = (static_cast<double>(point[k]) - axes[k].low) / range;
        const double step = share * steps + 0.5 * (k_used_steps - steps) + 0.5;
        result[k] = !(step > 0) ? 0 : step >= k_lattice_steps ? k_lattice_steps : static_cast<std::int32_t>(step);
    }
    return result;
}

std::vector<LatticePoint> to_lattice(const BlendSpace& space) {
    std::vector<LatticePoint> points;
    for (std::size_t i = 0; i < space.samples.size(); ++i) {
        const SpacePoint &sample = space.samples[i], &original = space.samples[space.original(static_cast<int>(i))];
        LatticePoint point = to_lattice(space.axes, original);
        for (std::size_t k = 0; k < space.axes.size(); ++k) {
            const Axis& axis = space.axes[k];
            if (sample[k] != original[k]) point[k] += sample[k] > original[k] ? steps_of(axis) : -steps_of(axis);
        }
        points.push_back(point);
    }
    return points;
}

int triangulate(BlendSpace& space) {
    Triangulation result = triangulate(space.dimensions(), to_lattice(space));
    space.simplices = std::move(result.simplices);
    space.neighbours = std::move(result.neighbours);
    return result.rank;
}

void add_wrap_copies(BlendSpace& space) {
    space.copy_of.clear();
    if (std::none_of(space.axes.begin(), space.axes.end(), [](const Axis& axis) { return axis.wraps; })) return;
    space.copy_of.resize(space.samples.size());
    std::iota(space.copy_of.begin(), space.copy_of.end(), 0);
    for (std::size_t k = 0; k < space.axes.size(); ++k) {
        const Axis& axis = space.axes[k];
        if (!axis.wraps) continue;
        const float range = axis.high - axis.low;
        const std::size_t count = space.samples.size();
        for (std::size_t i = 0; i < count; ++i) {
            SpacePoint& sample = space.samples[i];
            if (sample[k] < axis.low || sample[k] >= axis.high)  // high is low's place
                sample[k] -= std::floor((sample[k] - axis.low) / range) * range;
        }
        for (const float shift : {-range, range})
            for (std::size_t i = 0; i < count; ++i) {
                SpacePoint copy = space.samples[i];
                copy[k] += shift;
                space.samples.push_back(copy);
                space.copy_of.push_back(space.copy_of[i]);
            }
    }
}

}  // namespace surefoot
