#pragma once
// Delaunay triangulation in 1 to 4 dimensions, exact, and independent of the order of the samples.
//
// Points are rounded to a lattice of 16 bits an axis. There, orientation and the empty-sphere test are determinants of
// integers that fit 128 bits, so no decision is ever wrong by rounding. Co-circular points (the rule on a grid) are
// decided by lifting each point by an infinitesimal of its own, keyed by its position.

#include <surefoot/space/blend_space.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

inline constexpr int k_lattice_steps = 65535;                     ///< coordinates are 0 … k_lattice_steps
using LatticePoint = std::array<std::int32_t, k_max_dimensions>;  ///< unused dimensions are 0

struct Triangulation {
    std::vector<Simplex> simplices;     ///< positively oriented
    std::vector<Simplex> neighbours;    ///< neighbours[s][k]: across the face opposite vertex k, or -1
    std::vector<std::int32_t> same_as;  ///< of each point: the first point at the same place (itself, mostly)
    int rank = 0;  ///< dimension that the points span; simplices exist only where it equals the asked dimension
};

/// Triangulates distinct lattice points. Needs 1 <= dimensions <= 4. Points of equal position are merged into the
/// first. Simplices are sorted, so that the result does not depend on how it was found.
Triangulation triangulate(int dimensions, std::span<const LatticePoint> points);

/// `point` on the lattice that spans each axis' limits, low to high, clamped. (On a wrapping axis high meets low.)
LatticePoint to_lattice(std::span<const Axis> axes, const SpacePoint& point);

/// Fills simplices and neighbours of a space from its axes and samples. Returns the rank (see Triangulation): where it
/// is below dimensions(), the samples lie on a line, a plane, … and the space has no simplices.
int triangulate(BlendSpace& space);

}  // namespace surefoot
