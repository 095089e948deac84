#pragma once
// What might mend a finding: plans to try, best first. Private to the room.

#include <surefoot/author/workbench.h>

#include <string>
#include <vector>

namespace surefoot {

struct RepairPlan {
    std::vector<RepairStep> steps;
    std::string text;  ///< what it is meant to do
};

/// Plans for a finding of the bench's project; made clips are named, nothing is made yet. None where the finding asks
/// for what the clips at hand cannot give.
std::vector<RepairPlan> repair_plans(const Workbench& bench, const Finding& finding);

}  // namespace surefoot
