#pragma once
// Grounds that are wide enough for a crowd of any size: courses lead ahead, rings go round.

#include <surefoot/ground/ground.h>
#include <surefoot/ground/surface_mesh.h>

#include <memory>
#include <string>
#include <vector>

namespace surefoot::wasm {

struct CrowdGround {
    std::shared_ptr<const Ground> ground;  ///< null: level at y = 0
    SurfaceMesh mesh;                      ///< the same, `reach` metres in all directions
};

/// flat, hills, slope, kerbs.
const std::vector<std::string>& crowd_ground_names();

/// Throws Error for a name that is none of these.
CrowdGround make_crowd_ground(const std::string& name, float reach);

}  // namespace surefoot::wasm
