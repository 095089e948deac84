#pragma once
// The T-stance: the one pose in which all characters look alike, whatever pose their file rests in.

#include <surefoot/rig/leg.h>

namespace surefoot {

/// Model rotation of every joint when the character stands in a T: facing +Z, trunk as it rests (brought upright where
/// it leans by more than 12 degrees), legs straight down, feet flat and pointing straight ahead as `legs` says they
/// are, arms straight out to the sides, collar bones as they rest (brought level where
/// they point more than 45 degrees away from sideways). Each bone gets there from `shape` by the least rotation after
/// its parent's, so it is not twisted about itself; joints without a role go with their parent. `shape` is a pose in
/// model space that no bone is twisted in: the rest pose of most rigs (T, A or splayed, facing anywhere). Needs
/// roles.has_legs().
std::vector<Quat> t_stance(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs,
                           std::span<const Transform> shape);

/// The same as model transforms, with the bones' own lengths: the lower sole on y = 0, the hip joints over the origin.
std::vector<Transform> standing_pose(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs,
                                     std::span<const Transform> shape);

}  // namespace surefoot
