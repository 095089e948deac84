#pragma once
// What a report shows of clips beyond their facts, made from the motions themselves: where the soles go, and the clip
// as the runtime will play it.

#include <surefoot/analysis/analyze.h>
#include <surefoot/author/project.h>
#include <surefoot/clip/packed_clip.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace surefoot {

struct ClipFigure {
    PackedClip packed;  ///< without frames where the clip is not at hand
    /// [m] of the lowest sole point above the clip's ground, by Side, at even steps from the first frame to the last.
    std::array<std::vector<float>, 2> sole;
};

struct ClipFigures {
    std::shared_ptr<const Skeleton> skeleton;  ///< of all packed clips; null where there are none
    RoleMap roles;
    Legs legs;
    std::vector<Transform> standing;  ///< model space: the pose that the legs were made from
    float height = 1.7f;              ///< [m] of the character
    std::vector<ClipFigure> clips;    ///< one a clip of the project, or none at all
};

/// Figures of a project's clips, in parallel. `clips` holds one a clip of the project, null where it is not at hand
/// (one that was left out); those of another skeleton than the first get no packed form. The project must be placed.
ClipFigures make_clip_figures(const Project& project, std::span<const AnalyzedClip* const> clips);

}  // namespace surefoot
