#pragma once
// Triangles of a ground, for showing and exporting it. A ground and its mesh are the same surface: queries use the same
// diagonals that the triangles do.

#include <surefoot/math/vec.h>

#include <cstdint>
#include <vector>

namespace surefoot {

struct SurfaceMesh {
    std::vector<Vec3> positions;         ///< [m] world
    std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise seen from above or outside
};

/// The part of the ground plane that a mesh covers.
struct Extent {
    float x0 = -10, x1 = 10, z0 = -10, z1 = 30;  ///< [m]
};

}  // namespace surefoot
