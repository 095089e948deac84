#pragma once
// A walk for others to read: the table, the metrics file, the scene that a judge can load.

#include <surefoot/course/figures.h>
#include <surefoot/rig/roles.h>

#include <string>

namespace surefoot {

/// One row a mode, with a line above them and misses marked.
std::string metrics_table(const WalkInfo& info, const WalkComparison& walks);

/// As walk_json (walk_table.h).
std::string metrics_json(const WalkInfo& info, const WalkComparison& walks);

/// A .glb with one skinned `character` in one animation of world motion, the `terrain`, and in the scene's extras the
/// course, the contacts, the soles and what the flat twin says: all that is needed to measure the walk again.
std::string walk_glb(const WalkInfo& info, const Course& course, const WalkComparison& walks, FootMode mode,
                     const RoleMap& roles);

/// The stretch that tells most, without and with foot placement.
std::string walk_filmstrip(const WalkInfo& info, const Course& course, const WalkComparison& walks, FootMode mode,
                           const RoleMap& roles);

}  // namespace surefoot
