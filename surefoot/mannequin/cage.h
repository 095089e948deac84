#pragma once
// A coarse closed surface with skin weights, and the smooth mesh that one step of subdivision makes of it. Private to
// the room.

#include <surefoot/mannequin/mesh.h>
#include <surefoot/mannequin/skin.h>

#include <span>

namespace surefoot {

/// Vertices of a cage that go around something, in order.
using Loop = std::vector<std::uint32_t>;

struct Cage {
    std::vector<Vec3> positions;  ///< [m]
    std::vector<SkinWeights> skins;
    std::vector<Loop> faces;  ///< counter-clockwise from outside; three corners or more

    std::uint32_t add(Vec3 position, const SkinWeights& skin);
    /// A band of quads between loops of equal length, corner to corner. `flip` turns its faces to the other side.
    void bridge(const Loop& from, const Loop& to, bool flip);
    /// One face across a loop. Unflipped it closes what `bridge` unflipped leads to.
    void cap(const Loop& loop, bool flip);
};

/// One step of E. Catmull and J. Clark, "Recursively generated B-spline surfaces on arbitrary topological meshes",
/// Computer-Aided Design 10, 1978, of positions and weights alike; triangles, and normals that are smooth. The cage
/// must be closed: every edge between two faces.
Mesh subdivided(const Cage& cage);

/// Normals of the vertices from `first_vertex` on: sums of the triangles around each from `first_index` on, larger ones
/// counting more.
void add_normals(Mesh& mesh, std::size_t first_vertex, std::size_t first_index);

}  // namespace surefoot
