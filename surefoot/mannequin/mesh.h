#pragma once
// Meshes as they are written to glTF.

#include <surefoot/math/transform.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace surefoot {

/// A skinned mesh, in model space, bound to the skeleton's rest pose or to the pose in `bind`. Arrays of equal length;
/// `indices` are triangles, counter-clockwise from outside.
struct Mesh {
    std::vector<Vec3> positions;                       ///< [m]
    std::vector<Vec3> normals;                         ///< unit
    std::vector<std::array<std::uint16_t, 4>> joints;  ///< indices of skeleton joints
    std::vector<std::array<float, 4>> weights;         ///< sum to 1; unused ones are 0
    std::vector<std::uint32_t> indices;
    /// Model transforms of all joints in the pose that the vertices show; empty: the rest pose.
    std::vector<Transform> bind;
};

/// A mesh that does not move, in world space: a terrain, a marker.
struct StaticMesh {
    std::string name;             ///< of its node
    std::vector<Vec3> positions;  ///< [m]
    std::vector<Vec3> normals;    ///< unit; empty: computed flat per vertex from the triangles
    std::vector<std::uint32_t> indices;
    std::array<float, 4> color{0.6f, 0.6f, 0.6f, 1};  ///< linear RGBA of the whole
    std::vector<std::array<float, 4>> vertex_colors;  ///< linear RGBA, multiplied with `color`; empty: none
};

}  // namespace surefoot
