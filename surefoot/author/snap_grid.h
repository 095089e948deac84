#pragma once
// Engines keep samples on a grid of their own: what that does to a space.

#include <surefoot/author/project.h>

#include <string>
#include <vector>

namespace surefoot {

inline constexpr int k_coarsest_grid = 4, k_finest_grid = 100;

/// Where a sample was and where the grid put it.
struct SnappedSample {
    std::string space, clip;
    std::vector<float> from, to;  ///< in axis units, one value an axis
    float percent = 0;            ///< distance, in percent of each axis' range
};

struct GridSnap {
    std::vector<SnappedSample> samples;  ///< of all spaces, also those that stayed
    /// Clips that share a grid point: the space keeps the first one there, the others are never played.
    std::vector<std::vector<std::string>> collisions;
};

/// Moves each sample to the nearest of the points that divide each axis, from its low to its high limit, in `divisions`
/// equal parts (divisions + 1 points), and triangulates anew; locked edges are kept where they can be. Samples beyond
/// the limits go to the limit. Throws Error for divisions out of k_coarsest_grid … k_finest_grid.
GridSnap snap_to_grid(Project& project, int divisions, std::vector<std::string>& warnings);

/// The table that `surefoot author --grid` prints: each sample's displacement, the farthest first, and the collisions.
std::string snap_table(const Project& project, const GridSnap& snap);

}  // namespace surefoot
