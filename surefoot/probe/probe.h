#pragma once
// Plays a blend space on a grid and measures each blend from its standing feet (DESIGN §6).
//
// Each grid point inside what the clips cover is asked of the runtime itself (graph/locomotion.h), which plays whole
// cycles in steady state. Speed and turn come from the standing soles of the pose alone, by the estimate that measures
// clips in place (analysis/treadmill.h); skate and knees from the pose under the root motion that the runtime gave.
// The cell's clips are measured alone in the same way, so that a cell can be compared with what it is made of.

#include <surefoot/author/probe_result.h>
#include <surefoot/bake/character.h>

namespace surefoot {

inline constexpr int k_finest_probe_grid = 201;

struct ProbeOptions {
    /// Grid points an axis, ends included [0: 41, 21, 9 or 5 by the number of axes; Limit: 2 to k_finest_probe_grid].
    int grid = 0;
};

/// Throws Error for a grid out of its limits. Runs in parallel; the result does not depend on the threads. Costs about
/// a millisecond a cell.
ProbeResult probe(const Character& character, const ProbeOptions& options = {});

}  // namespace surefoot
