#pragma once
// Ground given by triangles: levels from modelling tools, with bridges, overhangs and holes.
//
// A square grid over the plane holds in each cell the triangles that reach into it, so a query looks at a few of them
// however many there are.

#include <surefoot/ground/ground.h>
#include <surefoot/ground/surface_mesh.h>

#include <string>

namespace surefoot {

class TriangleMesh final : public Ground {
  public:
    /// `surfaces` holds the host's id of each triangle, or nothing (all 0). Which way round a triangle is does not
    /// matter: normals point up. Upright ones are never hit. Check `problem` of the mesh before.
    explicit TriangleMesh(SurfaceMesh mesh, std::vector<std::uint32_t> surfaces = {});

    /// The highest surface within reach: of a bridge and the road under it, what `up` lets be seen.
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override;

    const SurfaceMesh& mesh() const noexcept { return mesh_; }
    /// How many triangles a query at that place looks at: for tests and profiles.
    std::size_t candidates_at(float x, float z) const noexcept;

  private:
    struct Column {
        const std::uint32_t *begin = nullptr, *end = nullptr;
    };
    Column column_at(float x, float z) const noexcept;
    GroundHit hit_at(const GroundQuery& query) const noexcept;

    SurfaceMesh mesh_;
    std::vector<std::uint32_t> surfaces_;
    float low_x_ = 0, low_z_ = 0, cell_ = 1;
    int columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> starts_;  ///< of each cell's triangles in `cells_`, and the end
    std::vector<std::uint32_t> cells_;
};

/// What is wrong with a mesh, as a sentence; empty: nothing. Indices in threes and in range, finite positions.
std::string problem(const SurfaceMesh& mesh);

}  // namespace surefoot
