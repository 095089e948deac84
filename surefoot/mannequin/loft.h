#pragma once
// Closed tubes from rings: fingers. Private to the room.

#include <surefoot/mannequin/mesh.h>
#include <surefoot/mannequin/skin.h>

#include <span>

namespace surefoot {

/// An ellipse of the loft.
struct Ring {
    Vec3 center;   ///< [m]
    Vec3 across;   ///< half-axis [m]
    Vec3 forward;  ///< half-axis [m]
    SkinWeights skin;
};

/// Adds a tube through the rings, closed at both ends by a point in the middle of the first and last ring. Turns its
/// faces outward whichever way the rings run. Normals are smooth.
void add_loft(Mesh& mesh, std::span<const Ring> rings, int segments);

}  // namespace surefoot
