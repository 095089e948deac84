#pragma once
// Which single new clip would help most: each placeholder filled in turn, and what is better then.

#include <surefoot/author/workbench.h>

#include <string>

namespace surefoot {

/// How bad a project's findings are, in warnings; lower is better. `error`: what an error counts. A suggestion counts
/// as a twentieth, a space that lacks a dimension as ten: the rest of its findings shows only once it has one.
double findings_weight(const Project& project, double error);

/// Fills every placeholder of the bench's project in turn with a clip of facts alone, places and lints, and keeps what
/// is better then: `worth` by the findings, and `probe_gain` by the forecast of the probe (author/probe_forecast.h)
/// where the project has one. Where the mirror image of that clip would fill another placeholder it is counted in:
/// mirroring costs nothing.
void rank_placeholders(Workbench& bench);

/// Whether `a` would help more: first what opens a dimension, then by what it mends of the blends, to the percent, and
/// last by the findings.
bool helps_more(const Placeholder& a, const Placeholder& b);

/// The placeholder that helps most, the first among equals; null where none helps.
const Placeholder* most_wanted(const Project& project);

/// What filling a placeholder would change, for a person: "would mend 31 % of what the probe found wrong and settle as
/// much as 3 warnings". Empty where nothing.
std::string describe_worth(const Placeholder& placeholder);

}  // namespace surefoot
