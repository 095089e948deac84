#include <surefoot/ground/triangle_mesh.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_triangles_a_cell = 2;  // aimed at
constexpr int k_most_cells_a_side = 4096;
constexpr float k_upright = 1e-6f;  // of the normal's height: steeper is a wall

struct Corners {
    Vec3 a, b, c;
};
Corners corners_of(const SurfaceMesh& mesh, std::uint32_t triangle) noexcept {
    const std::size_t at = std::size_t{3} * triangle;
    return {mesh.positions[mesh.indices[at]], mesh.positions[mesh.indices[at + 1]],
            mesh.positions[mesh.indices[at + 2]]};
}

/// Twice the signed area of (from, to, (x, z)) seen from above. The same edge gives the same number with its sign
/// turned in the triangle on its other side, so that no query falls between two triangles.
double side_of(Vec3 from, Vec3 to, float x, float z) noexcept {
    const auto d = [](float v) { return static_cast<double>(v); };
    const bool turned = from.x > to.x || (from.x == to.x && from.z > to.z);
    if (turned) std::swap(from, to);
    const double side = (d(to.x) - d(from.x)) * (d(z) - d(from.z)) - (d(x) - d(from.x)) * (d(to.z) - d(from.z));
    return turned ? -side : side;
}

int cell_of(float offset, float cell, int count) noexcept {
    return std::clamp(static_cast<int>(std::floor(offset / cell)), 0, count - 1);
}

}  // namespace

std::string problem(const SurfaceMesh& mesh) {
    if (mesh.indices.empty() || mesh.indices.size() % 3 != 0) return "the indices are not three for each triangle";
    for (const std::uint32_t index : mesh.indices)
        if (index >= mesh.positions.size()) return "a triangle names a corner that is not there";
    for (const Vec3 p : mesh.positions)
        if (!is_finite(p)) return "a corner has a coordinate that is no number";
    return {};
}

TriangleMesh::TriangleMesh(SurfaceMesh mesh, std::vector<std::uint32_t> surfaces)
    : mesh_(std::move(mesh)), surfaces_(std::move(surfaces)) {
    assert(problem(mesh_).empty());
    const auto count = static_cast<std::uint32_t>(mesh_.indices.size() / 3);
    assert(surfaces_.empty() || surfaces_.size() == count);
    Vec3 low = mesh_.positions[mesh_.indices[0]], high = low;
    for (const std::uint32_t index : mesh_.indices) {
        const Vec3 p = mesh_.positions[index];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    low_x_ = low.x;
    low_z_ = low.z;
    const float width = std::max(high.x - low.x, 1e-3f), depth = std::max(high.z - low.z, 1e-3f);
    cell_ = std::sqrt(width * depth * k_triangles_a_cell / static_cast<float>(count));
    cell_ = std::max(cell_, std::max(width, depth) / static_cast<float>(k_most_cells_a_side));
    columns_ = static_cast<int>(width / cell_) + 1;
    rows_ = static_cast<int>(depth / cell_) + 1;

    const auto each_cell = [&](std::uint32_t triangle, auto&& visit) {
        const Corners t = corners_of(mesh_, triangle);
        const auto column = [&](float x) { return cell_of(x - low_x_, cell_, columns_); };
        const auto row = [&](float z) { return cell_of(z - low_z_, cell_, rows_); };
        const int from = column(std::min({t.a.x, t.b.x, t.c.x})), until = column(std::max({t.a.x, t.b.x, t.c.x}));
        const int first = row(std::min({t.a.z, t.b.z, t.c.z})), last = row(std::max({t.a.z, t.b.z, t.c.z}));
        for (int j = first; j <= last; ++j)
            for (int i = from; i <= until; ++i) visit(static_cast<std::size_t>(j * columns_ + i));
    };
    starts_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for (std::uint32_t t = 0; t < count; ++t) each_cell(t, [&](std::size_t cell) { ++starts_[cell + 1]; });
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    cells_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t t = 0; t < count; ++t) each_cell(t, [&](std::size_t cell) { cells_[next[cell]++] = t; });
}

TriangleMesh::Column TriangleMesh::column_at(float x, float z) const noexcept {
    const float i = std::floor((x - low_x_) / cell_), j = std::floor((z - low_z_) / cell_);
    if (!(i >= 0 && j >= 0 && i < static_cast<float>(columns_) && j < static_cast<float>(rows_))) return {};
    const auto cell = static_cast<std::size_t>(static_cast<int>(j) * columns_ + static_cast<int>(i));
    return {cells_.data() + starts_[cell], cells_.data() + starts_[cell + 1]};
}

std::size_t TriangleMesh::candidates_at(float x, float z) const noexcept {
    const Column column = column_at(x, z);
    return static_cast<std::size_t>(column.end - column.begin);
}

GroundHit TriangleMesh::hit_at(const GroundQuery& q) const noexcept {
    GroundHit best;
    const Column column = column_at(q.origin.x, q.origin.z);
    for (const std::uint32_t* t = column.begin; t != column.end; ++t) {
        const auto [a, b, c] = corners_of(mesh_, *t);
        const double u = side_of(b, c, q.origin.x, q.origin.z), v = side_of(c, a, q.origin.x, q.origin.z),
                     w = side_of(a, b, q.origin.x, q.origin.z);
        const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
        const double area = u + v + w;
        if (!inside || area == 0) continue;
        const Vec3 normal = normalized(cross(b - a, c - a));
        if (std::fabs(normal.y) < k_upright) continue;
        const auto height = static_cast<float>(
            (u * static_cast<double>(a.y) + v * static_cast<double>(b.y) + w * static_cast<double>(c.y)) / area);
        if (height > q.origin.y + q.up || height < q.origin.y - q.down || (best.hit && height <= best.height)) continue;
        best.hit = true;
        best.height = height;
        best.normal = normal.y < 0 ? -normal : normal;
        best.surface = surfaces_.empty() ? 0 : surfaces_[*t];
    }
    return best;
}

void TriangleMesh::query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept {
    for (std::size_t i = 0; i < queries.size(); ++i) hits[i] = hit_at(queries[i]);
}

}  // namespace surefoot
