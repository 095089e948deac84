#pragma once
// A body for any skeleton with roles: what exported clips wear, so that every viewer shows more than bones.
//
// One closed, smooth-weighted surface from the toes to the crown, sized by the skeleton itself, its edges running
// around every joint that bends; thumbs, or all fingers where they have roles, are closed tubes that begin inside the
// hand. Joints of spine and neck without a role bend it, too. Missing toes, shoulders, chest joints, head and arms are
// fine; who stands on its toes gets feet to match. Same input, same bytes.

#include <surefoot/mannequin/mesh.h>
#include <surefoot/motion/motion.h>
#include <surefoot/rig/leg.h>

namespace surefoot {

/// For the skeleton of a clip: bound to the rest pose where that agrees with how the clip turns the joints, else to the
/// pose of mannequin_bind_frame(). `legs` says where the soles are. Some 6,200 triangles, 7,900 with
/// fingers; at most four weights a vertex. Needs roles.has_legs().
Mesh make_mannequin(const Motion& motion, const RoleMap& roles, const Legs& legs);

/// Bound to the rest pose, whatever that is.
Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs);

/// Bound to a pose given as joint_count() model transforms, whose torso is upright and faces where it likes.
Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs,
                    std::span<const Transform> bind_models);

/// Bound to a pose that stands flat on y = 0, from which the soles are found, too.
Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, std::span<const Transform> standing_models);

/// A body of few triangles for crowds, bound to a pose as above: a closed tube a part with `corners` >= 4 corners
/// around, 80 triangles a corner where nothing is missing. Without fingers.
Mesh make_low_mannequin(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs,
                        std::span<const Transform> bind_models, int corners);

/// The frame with the straightest limbs where the rest pose cannot carry a skin: files without a real rest pose (BVH
/// offsets, say) twist bones about themselves by half a turn, and a skin bound there would shrink to nothing at the
/// joints; others rest in the middle of a run. -1 where the rest pose is fine.
int mannequin_bind_frame(const Motion& motion, const RoleMap& roles);

}  // namespace surefoot
