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
    std::vector<Simplex> simplices;     ///< of rank + 1 points each; positively oriented where rank == dimensions
    std::vector<Simplex> neighbours;    ///< neighbours[s][k]: across the face opposite vertex k, or -1
    std::vector<std::int32_t> same_as;  ///< of each point: the first point at the same place (itself, mostly)
    int rank = -1;  ///< dimension that the points span: 0 for one place, 1 for a line, …; -1 without points
};

/// Triangulates lattice points. Needs 1 <= dimensions <= 4. Points of equal position are merged into the first. Points
/// that all lie on a line, plane, … are triangulated within it. Simplices are sorted, so that the result does not
/// depend on how it was found.
Triangulation triangulate(int dimensions, std::span<const LatticePoint> points);

/// `point` on the lattice. The axes' limits take its middle half (of wrapping axes its middle third), so that there is
/// room for samples beyond the limits and for the copies of a wrapping axis; what lies farther out is clamped.
LatticePoint to_lattice(std::span<const Axis> axes, const SpacePoint& point);

/// All samples on the lattice, copies exactly one range away from what they repeat.
std::vector<LatticePoint> to_lattice(const BlendSpace& space);

/// Fills simplices and neighbours of a space from its axes and samples, and returns the rank (see Triangulation).
int triangulate(BlendSpace& space);

/// Makes wrapping axes seamless: brings all samples within their limits and repeats each a range below and a range
/// above (of n wrapping axes, 3^n - 1 times), filling `copy_of`. Nothing happens where no axis wraps. Call it once,
/// before triangulate. Three periods are enough: corners of a Delaunay simplex lie within half a range of its centre
/// along a wrapping axis, so what covers the middle period is what infinitely many would give, the same at both ends.
void add_wrap_copies(BlendSpace& space);

}  // namespace surefoot
