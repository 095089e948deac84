#pragma once
// A body for any skeleton with roles: what exported clips wear, so that every viewer shows more than bones.
//
// Smooth-weighted closed parts (torso, head, arms with mitten hands, legs, shoes), sized by the skeleton itself. Joints
// without a role are left out; missing toes, shoulders, chest joints and arms are fine. Same input, same bytes.

#include <surefoot/io/mesh.h>
#include <surefoot/rig/leg.h>

namespace surefoot {

/// Bound to the skeleton's rest pose, whatever that is; `legs` says where the soles are. Below 6,000 triangles, at most
/// four weights a vertex. Needs roles.has_legs().
Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs);

/// The same, with the soles found from a pose that stands flat on y = 0, facing +Z (joint_count() model transforms).
Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, std::span<const Transform> standing_models);

}  // namespace surefoot
