#include <surefoot/base/random.h>
#include <surefoot/ground/shapes.h>

#include <algorithm>
#include <utility>

namespace surefoot {
namespace {

GroundHit answer(const GroundQuery& q, float height, Vec3 normal = k_up) noexcept {
    GroundHit hit;
    hit.height = height;
    hit.normal = normal;
    hit.hit = height <= q.origin.y + q.up && height >= q.origin.y - q.down;
    return hit;
}

/// Two triangles; the corners run counter-clockwise seen from the side that shows.
void add_quad(SurfaceMesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

/// A strip from z0 to z1 across the extent, its height going from y0 to y1.
void add_strip(SurfaceMesh& mesh, const Extent& e, float z0, float y0, float z1, float y1) {
    add_quad(mesh, {e.x0, y0, z0}, {e.x0, y1, z1}, {e.x1, y1, z1}, {e.x1, y0, z0});
}

}  // namespace

Plane::Plane(float rise_x, float rise_z, float height) noexcept : rise_x_(rise_x), rise_z_(rise_z), height_(height) {}

void Plane::query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept {
    const Vec3 normal = normalized({-rise_x_, 1, -rise_z_});
    for (std::size_t i = 0; i < queries.size(); ++i)
        hits[i] = answer(queries[i], height_ + rise_x_ * queries[i].origin.x + rise_z_ * queries[i].origin.z, normal);
}

SurfaceMesh Plane::mesh(const Extent& e) const {
    const auto at = [&](float x, float z) { return Vec3{x, height_ + rise_x_ * x + rise_z_ * z, z}; };
    SurfaceMesh mesh;
    add_quad(mesh, at(e.x0, e.z0), at(e.x0, e.z1), at(e.x1, e.z1), at(e.x1, e.z0));
    return mesh;
}

Ramp::Ramp(float rise, float start, float end) noexcept : rise_(rise), start_(start), end_(end) {}

void Ramp::query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept {
    const Vec3 sloping = normalized({0, 1, -rise_});
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const float z = queries[i].origin.z;
        const float on = std::clamp(z, start_, end_);
        hits[i] = answer(queries[i], rise_ * (on - start_), z > start_ && z < end_ ? sloping : k_up);
    }
}

SurfaceMesh Ramp::mesh(const Extent& e) const {
    const float top = rise_ * (end_ - start_);
    SurfaceMesh mesh;
    add_strip(mesh, e, e.z0, 0, start_, 0);
    add_strip(mesh, e, start_, 0, end_, top);
    add_strip(mesh, e, end_, top, std::max(e.z1, end_), top);
    return mesh;
}

Stairs::Stairs(float riser, float tread, float start, int count) noexcept
    : riser_(riser), tread_(tread), start_(start), count_(count) {}

void Stairs::query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept {
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const float steps = std::floor((queries[i].origin.z - start_) / tread_) + 1;
        hits[i] = answer(queries[i], riser_ * std::clamp(steps, 0.0f, static_cast<float>(count_)));
    }
}

SurfaceMesh Stairs::mesh(const Extent& e) const {
    SurfaceMesh mesh;
    add_strip(mesh, e, e.z0, 0, start_, 0);
    for (int i = 0; i < count_; ++i) {
        const float z = start_ + static_cast<float>(i) * tread_;
        const float below = riser_ * static_cast<float>(i), above = below + riser_;
        if (riser_ > 0)
            add_quad(mesh, {e.x1, below, z}, {e.x0, below, z}, {e.x0, above, z}, {e.x1, above, z});
        else
            add_quad(mesh, {e.x0, above, z}, {e.x1, above, z}, {e.x1, below, z}, {e.x0, below, z});
        const float end = i + 1 < count_ ? z + tread_ : std::max(e.z1, z + tread_);
        add_strip(mesh, e, z, above, end, above);
    }
    return mesh;
}

Bands::Bands(float height, float skew, std::vector<Band> bands) noexcept
    : height_(height), skew_(skew), bands_(std::move(bands)) {}

void Bands::query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept {
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const float along = queries[i].origin.z + skew_ * queries[i].origin.x;
        bool raised = false;
        for (const Band& band : bands_) raised |= along > band.from && along < band.to;
        hits[i] = answer(queries[i], raised ? height_ : 0);
    }
}

SurfaceMesh Bands::mesh(const Extent& e) const {
    SurfaceMesh mesh;
    const float left = skew_ * e.x0, right = skew_ * e.x1;  // z = along - skew x
    const auto strip = [&](float from, float to, float y) {
        add_quad(mesh, {e.x0, y, from - left}, {e.x0, y, to - left}, {e.x1, y, to - right}, {e.x1, y, from - right});
    };
    const auto low = std::min(e.z0 + left, e.z0 + right), high = std::max(e.z1 + left, e.z1 + right);
    float z = low;
    for (const Band& b : bands_) {
        strip(z, b.from, 0);
        strip(b.from, b.to, height_);
        add_quad(mesh, {e.x1, 0, b.from - right}, {e.x0, 0, b.from - left}, {e.x0, height_, b.from - left},
                 {e.x1, height_, b.from - right});
        add_quad(mesh, {e.x0, 0, b.to - left}, {e.x1, 0, b.to - right}, {e.x1, height_, b.to - right},
                 {e.x0, height_, b.to - left});
        z = b.to;
    }
    strip(z, std::max(high, z + 1), 0);
    return mesh;
}

namespace {
constexpr int k_tile_columns = 64, k_tile_rows = 256;
}

Tiles::Tiles(float size, float highest, float start, std::uint64_t seed)
    : size_(size), start_(start), heights_(static_cast<std::size_t>(k_tile_columns * k_tile_rows)) {
    Random random(seed);
    for (float& h : heights_) h = random.between(0, highest);
}

float Tiles::height_at(int column, int row) const noexcept {
    if (row < 0) return 0;  // the start is level
    const int i = std::clamp(column + k_tile_columns / 2, 0, k_tile_columns - 1), j = std::min(row, k_tile_rows - 1);
    return heights_[static_cast<std::size_t>(j * k_tile_columns + i)];
}

void Tiles::query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept {
    constexpr float far = 1e6f;  // keeps the conversion to int defined
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const Vec3 p = queries[i].origin;
        const int column = static_cast<int>(std::floor(std::clamp(p.x / size_, -far, far)));
        const int row = static_cast<int>(std::floor(std::clamp((p.z - start_) / size_, -far, far)));
        hits[i] = answer(queries[i], height_at(column, row));
    }
}

SurfaceMesh Tiles::mesh(const Extent& e) const {
    SurfaceMesh mesh;
    add_strip(mesh, e, e.z0, 0, start_, 0);
    const int columns = static_cast<int>(std::ceil(e.x1 / size_)), first = static_cast<int>(std::floor(e.x0 / size_));
    const int rows = static_cast<int>(std::ceil((e.z1 - start_) / size_));
    for (int row = 0; row < rows; ++row)
        for (int column = first; column < columns; ++column) {
            const float x0 = static_cast<float>(column) * size_, x1 = x0 + size_;
            const float z0 = start_ + static_cast<float>(row) * size_, z1 = z0 + size_;
            const float y = height_at(column, row), before = height_at(column, row - 1),
                        beside = height_at(column - 1, row);
            add_quad(mesh, {x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0});
            if (y > before)
                add_quad(mesh, {x1, before, z0}, {x0, before, z0}, {x0, y, z0}, {x1, y, z0});
            else
                add_quad(mesh, {x0, y, z0}, {x0, before, z0}, {x1, before, z0}, {x1, y, z0});
            if (y > beside)
                add_quad(mesh, {x0, beside, z0}, {x0, beside, z1}, {x0, y, z1}, {x0, y, z0});
            else
                add_quad(mesh, {x0, y, z0}, {x0, y, z1}, {x0, beside, z1}, {x0, beside, z0});
        }
    return mesh;
}

float height_at(const Ground& ground, float x, float z) noexcept {
    const GroundQuery query{{x, 0, z}, 100, 100};
    GroundHit hit;
    ground.query({&query, 1}, {&hit, 1});
    return hit.hit ? hit.height : 0;
}

}  // namespace surefoot
