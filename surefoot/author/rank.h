#pragma once
// Which single new clip would help most: each placeholder filled in turn, and what is better then.

#include <surefoot/author/workbench.h>

#include <functional>
#include <string>

namespace surefoot {

/// How bad a project is; lower is better. It gets a bench in which the clip in question stands where the placeholder
/// asks for it, placed and linted: a clip of facts, without motion (its entry in `clips` is null).
using BenchScore = std::function<double(const Workbench& bench)>;

/// The default: what the findings weigh, in warnings. An error counts as two (a new clip brings new edges, and what
/// those lack is asked for in its turn), a suggestion as a twentieth, a space that lacks a dimension as ten: the rest
/// of its findings shows only once it has one.
double findings_weight(const Project& project);

/// Fills `worth` of every placeholder of the bench's project: by how much `score` falls with a clip there. Where the
/// mirror image of that clip would fill another placeholder it is counted in: mirroring costs nothing.
void rank_placeholders(Workbench& bench, const BenchScore& score = {});

/// The placeholder that is worth most, the first among equals; null where none is worth anything.
const Placeholder* most_wanted(const Project& project);

/// What filling a placeholder would change, for a person: "would settle as much as 3 warnings". Empty where nothing.
std::string describe_worth(const Placeholder& placeholder);

}  // namespace surefoot
