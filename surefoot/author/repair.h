#pragma once
// Repairs: findings answered by clips that are made of the clips at hand, by clips left out, and by edges laid another
// way. Each is tried on a copy of the project and kept only where lint afterwards is content.
//
// Delicado & Pelechano 2019, §3.2 and §3.3 mirror clips and interpolate on an axis where two of its samples stand on
// either side of the place asked for; where one side has none, there stays a placeholder: nothing is extrapolated.

#include <surefoot/author/workbench.h>

#include <map>
#include <string>
#include <vector>

namespace surefoot {

struct RepairOptions {
    std::vector<std::string> only;  ///< rules or fix ids; empty: everything
};

struct RepairAttempt {
    std::string fix_id;
    Finding finding;
    bool done = false;
    std::string text;  ///< what was done, or why nothing could be
};

struct RepairReport {
    std::vector<RepairAttempt> attempts;       ///< what was done in order, then what was not
    std::map<std::string, int> before, after;  ///< findings by "severity rule"
    int made() const;
};

/// Name of what would mend a finding: eight hexadecimal digits that are the same as long as the finding is.
std::string fix_id(const Finding& finding);

/// Repairs what can be repaired: sliding feet are held first (also those that slide less than lint minds), then
/// findings are mended, worst first. `bench` must be placed and linted; afterwards it is again. A repair is kept only
/// where the finding is gone, no rule has more errors than before, errors and warnings together are no more, every made
/// clip does what it was made for (within a twentieth of each axis' range) and slides no more than its sources (by 3
/// cm/s), and no space loses a dimension. The same bench gives the same repairs on any thread count; a second run makes
/// none.
RepairReport repair(Workbench& bench, const RepairOptions& options = {});

/// Makes again what `before` records (from the clips that are at hand now) and records it in `bench`; repairs whose
/// clips are missing are dropped with a warning. Does not place.
void replay_repairs(Workbench& bench, const Project& before, std::vector<std::string>& warnings);

/// Takes back a repair and those that build on it, all of them for an empty id, then places and lints. Returns the ids
/// taken back, in the order in which they were made. Throws Error where there is no such repair.
std::vector<std::string> undo_repairs(Workbench& bench, const std::string& id, std::vector<std::string>& warnings);

/// Findings by "severity rule".
std::map<std::string, int> count_findings(const Project& project);

}  // namespace surefoot
