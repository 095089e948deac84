#include <surefoot/base/random.h>
#include <surefoot/ground/height_field.h>

#include <algorithm>
#include <cassert>

namespace surefoot {
namespace {

/// Cell index and share within it; outside the grid the share stays at the rim, and the surface goes on level.
struct Cell {
    int index;
    float share;
    bool outside;
};
Cell locate(float offset, float spacing, int count) noexcept {
    const float cells = static_cast<float>(count - 1);
    const float at = offset / spacing;
    if (!(at > 0)) return {0, 0, at < 0};
    if (at >= cells) return {count - 2, 1, at > cells};
    const int cell = static_cast<int>(at);
    return {cell, at - static_cast<float>(cell), false};
}

}  // namespace

HeightField::HeightField(float origin_x, float origin_z, float spacing, int columns, int rows,
                         std::vector<float> heights)
    : origin_x_(origin_x),
      origin_z_(origin_z),
      spacing_(spacing),
      columns_(columns),
      rows_(rows),
      heights_(std::move(heights)) {
    assert(columns_ >= 2 && rows_ >= 2 && spacing_ > 0);
    assert(heights_.size() == static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

void HeightField::query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept {
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const GroundQuery& q = queries[i];
        const Cell x = locate(q.origin.x - origin_x_, spacing_, columns_);
        const Cell z = locate(q.origin.z - origin_z_, spacing_, rows_);
        const float* row = heights_.data() + static_cast<std::size_t>(z.index) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(x.index);
        const float h00 = row[0], h10 = row[1], h01 = row[columns_], h11 = row[columns_ + 1];
        // The triangle on the origin's side of the diagonal, or the other: slope along x and z per cell.
        const bool near = x.share + z.share <= 1;
        const float dx = near ? h10 - h00 : h11 - h01;
        const float dz = near ? h01 - h00 : h11 - h10;
        GroundHit hit;
        hit.height = near ? h00 + x.share * dx + z.share * dz : h11 - (1 - x.share) * dx - (1 - z.share) * dz;
        hit.normal = normalized({x.outside ? 0 : -dx / spacing_, 1, z.outside ? 0 : -dz / spacing_});
        hit.hit = hit.height <= q.origin.y + q.up && hit.height >= q.origin.y - q.down;
        hits[i] = hit;
    }
}

SurfaceMesh HeightField::mesh() const {
    SurfaceMesh mesh;
    mesh.positions.reserve(heights_.size());
    for (int j = 0; j < rows_; ++j)
        for (int i = 0; i < columns_; ++i)
            mesh.positions.push_back({origin_x_ + static_cast<float>(i) * spacing_,
                                      heights_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                                               static_cast<std::size_t>(i)],
                                      origin_z_ + static_cast<float>(j) * spacing_});
    for (int j = 0; j + 1 < rows_; ++j)
        for (int i = 0; i + 1 < columns_; ++i) {
            const auto a = static_cast<std::uint32_t>(j * columns_ + i), b = a + 1;
            const auto c = a + static_cast<std::uint32_t>(columns_), d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
        }
    return mesh;
}

HeightField make_hills(std::uint64_t seed, float amplitude) {
    constexpr float spacing = 4;  // Colvin & Kajala's quads
    constexpr int columns = 16, rows = 26;
    Random random(seed);
    std::vector<float> heights(static_cast<std::size_t>(columns * rows));
    for (float& h : heights) h = random.between(-amplitude, amplitude);
    return {-30, -10, spacing, columns, rows, std::move(heights)};
}

}  // namespace surefoot
