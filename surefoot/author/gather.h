#pragma once
// The first half of authoring: from loaded clips to measured, closed, named cycles of one skeleton, and a reason for
// everything that was left out.

#include <surefoot/analysis/analyze.h>
#include <surefoot/author/project.h>
#include <surefoot/author/retarget_clips.h>
#include <surefoot/io/load.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace surefoot {

struct Candidate {
    AnalyzedClip clip;
    std::vector<std::string> provenance;
    bool cut_from_take = false;  ///< we chose it; a clip that the user made stays in even where it is one too many
    bool retargeted = false;     ///< it comes from another skeleton
    bool out = false;            ///< the user left it out: no other clip gives way to it
};

struct Gathered {
    std::vector<Candidate> kept;        ///< in order of name
    std::vector<ProjectClip> left_out;  ///< with reasons, in order of name
    std::vector<std::string> failed;    ///< clips that could not be measured
    std::vector<std::string> warnings;  ///< what was done that the user may not expect
    int takes = 0;                      ///< clips that were searched for cycles
    int takes_with_cycles = 0;
    int cycles = 0;  ///< found in them, before any was left out
};

struct GatherOptions {
    bool retarget = true;  ///< clips of other skeletons are put onto the one in use; else they are left out
    /// Whose skeleton is used; none: that which most clips share, the first of equals.
    std::optional<Actor> actor;
    /// Folder in which measurements are kept for the next run (author/result_cache.h); empty: nowhere.
    std::filesystem::path cache;
    /// Says of a named clip whether it stays out whatever it does; empty: none does.
    std::function<bool(const AnalyzedClip&)> left_out_by_user;
};

/// Measures clips (in parallel), cuts takes into cycles, drops what is not locomotion, brings all to one skeleton,
/// thins cycles of takes that do nearly the same, and makes names unique.
Gathered gather(std::vector<LoadedClip> clips, const RoleOverrides& overrides, const GatherOptions& options = {});

/// A clip that has no place in any space, and why.
ProjectClip left_out(const AnalyzedClip& clip, std::string reason);

}  // namespace surefoot
