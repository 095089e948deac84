#pragma once
// Ground given by heights on a square grid: Colvin & Kajala 2013, §IV.B step 1 ("an axis-aligned grid that allows for
// indexed queries into an array of quads").
//
// Quad (i, j) spans x from i to i + 1 and z from j to j + 1 spacings. Its diagonal runs from corner (i + 1, j) to
// corner (i, j + 1); heights are barycentric in the two triangles, normals are exact per triangle. Beyond the rim the
// rim's heights go on, level outward.

#include <surefoot/ground/ground.h>
#include <surefoot/ground/surface_mesh.h>

namespace surefoot {

class HeightField final : public Ground {
  public:
    /// `heights` holds columns * rows values, x fastest. [Limit: columns and rows >= 2, spacing > 0]
    HeightField(float origin_x, float origin_z, float spacing, int columns, int rows, std::vector<float> heights);

    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override;
    SurfaceMesh mesh() const;

    float spacing() const noexcept { return spacing_; }

  private:
    float origin_x_, origin_z_, spacing_;
    int columns_, rows_;
    std::vector<float> heights_;
};

/// The paper's rolling hills: quads 4 m apart, corners lifted by up to `amplitude` either way. The line x = 0 runs
/// through the middle of a row of quads. Covers x in [-30, 30], z in [-10, 90].
HeightField make_hills(std::uint64_t seed = 1, float amplitude = 0.5f);

}  // namespace surefoot
