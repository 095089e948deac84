#pragma once
// Clips made from other clips: what each making step of a repair does, and what came of it, measured.

#include <surefoot/author/workbench.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

/// Whether a step of that kind makes a clip.
bool makes_clip(const std::string& kind);

/// The clip that `step` makes of `inputs` (one a name of step.clips), named step.makes and measured anew, with the
/// skate of its own feet. Throws Error where the step cannot be done (unknown kind, a rate beyond its limits, clips
/// that do not mix).
AnalyzedClip make_clip(const RepairStep& step, std::span<const AnalyzedClip* const> inputs);

/// What the step did, for the provenance: "mirrored from \"walk_left\"", "0.60 of \"walk\" and 0.40 of \"jog\" mixed
/// at equal phase".
std::string describe_step(const RepairStep& step);

/// A name for the clip that `step` would make, not taken by any of `clips` (without regard to case).
std::string name_for(const RepairStep& step, std::span<const ProjectClip> clips);

/// Moments of one cycle that correspond between clips: left strike, right strike, left strike again. Empty for clips
/// that do not step; absent where strikes do not alternate.
std::optional<std::vector<float>> cycle_marks(const AnalyzedClip& clip);

}  // namespace surefoot
