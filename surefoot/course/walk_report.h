#pragma once
// A walk for others to read: the table, the metrics file, the scene that a judge can load.

#include <surefoot/course/walk.h>
#include <surefoot/rig/roles.h>

#include <string>

namespace surefoot {

/// What was walked, for titles and files.
struct WalkInfo {
    std::string character, course = "flat", path = "straight";
    float grade_deg = 15, speed_mps = 1.4f;
    bool reverse = false;  ///< from the course's far end
};

/// Three rows, one a mode, with a line above them.
std::string metrics_table(const WalkInfo& info, const WalkComparison& walks);

/// {"course", "path", "speed_mps", "rows": {"none": …, "colvin2013": …, "surefoot": …}}
std::string metrics_json(const WalkInfo& info, const WalkComparison& walks);

/// A .glb with one skinned `character` in one animation of world motion, the `terrain`, and in the scene's extras the
/// course, the contacts, the soles and what the flat twin says: all that is needed to measure the walk again.
std::string walk_glb(const WalkInfo& info, const Course& course, const WalkComparison& walks, FootMode mode,
                     const RoleMap& roles);

/// The stretch that tells most, without and with foot placement.
std::string walk_filmstrip(const WalkInfo& info, const Course& course, const WalkComparison& walks, FootMode mode,
                           const RoleMap& roles);

}  // namespace surefoot
