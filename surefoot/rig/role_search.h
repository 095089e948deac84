#pragma once
// The two searches behind find_roles (rig/roles.h). Not needed by users of the library.

#include <surefoot/rig/joint_name.h>
#include <surefoot/rig/roles.h>

namespace surefoot {

/// Which family of rigs the names belong to: "Mixamo", "CMU", "Unreal", …, "generic names".
std::string naming_convention(const Skeleton& skeleton, const RoleMap& roles);

/// What names say, checked against the hierarchy: limbs descend joint by joint, legs hang from the hips, the spine
/// leads from the hips to where the arms branch. Roles without a name stay empty.
RoleMap roles_by_name(const Skeleton& skeleton);

/// Fills what `roles` lacks of hips, legs, spine, head and arms from the shape of the pose (Y up): legs are the two
/// long chains that end low, arms the two long lateral chains off the upper spine, the head ends the upward chain.
/// Returns what it filled.
std::vector<Role> add_roles_by_shape(const Skeleton& skeleton, std::span<const Transform> models, RoleMap& roles);

/// Spine, chest, upper chest, neck from hips, arms and head: the joints that lie between them. Leaves set roles alone.
void fill_trunk(const Skeleton& skeleton, RoleMap& roles);

/// The deepest joint that has both at or below it (k_no_joint: none).
int common_ancestor(const Skeleton& skeleton, int a, int b) noexcept;

/// Sided roles without their side, for tables: role_on(Role::left_foot, right) == Role::right_foot.
inline Role role_on(Role left_role, NameSide side) noexcept {
    return side == NameSide::right ? mirrored(left_role) : left_role;
}

}  // namespace surefoot
