#pragma once
// Every walk of a sweep on one HTML page: what meets its marks, each course's table, and plots of feet, hips and knees.

#include <surefoot/course/colvin_study.h>
#include <surefoot/course/sweep.h>
#include <surefoot/rig/roles.h>

#include <span>
#include <string>

namespace surefoot {

/// The page as text; `study` may be null: then it has no figures of the paper's. Opens from disk, refers to nothing
/// else, works without scripts but for sorting. The same input gives the same bytes.
std::string walk_page(const std::string& character, std::span<const SweptWalk> walks,
                      const ColvinStudy* study = nullptr, const RoleMap& roles = {});

/// The plots of one walk as an SVG: foot heights over the ground, hips over the ground's own height, knee angles.
std::string walk_plots(const SweptWalk& walk);

}  // namespace surefoot
