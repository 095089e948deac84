#pragma once
// A skeleton measured for a body: sizes and directions in its bind pose. Private to the room.

#include <surefoot/mannequin/skin.h>
#include <surefoot/rig/leg.h>

namespace surefoot {

/// Shapes are drawn in shares of stature, which is taken from the legs and the trunk: thigh and shank are 0.491 of it,
/// the way from the hip joints to the neck 0.302 (Drillis and Contini 1966).
class Measures {
  public:
    Measures(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs, std::span<const Transform> bind);

    bool has(Role role) const { return roles[role] != k_no_joint; }
    const Transform& pose(int joint) const { return bind[static_cast<std::size_t>(joint)]; }
    Vec3 at(Role role) const { return pose(roles[role]).translation; }
    float size(float share) const { return share * stature; }
    /// The topmost joint of the trunk below the neck.
    int chest_joint() const;
    /// Where the neck begins; by proportion where nothing says so.
    Vec3 neck_base() const;
    /// Under the chin. Rigs put the head's joint anywhere between the neck and the ears: the crown decides.
    Vec3 head_base() const;
    /// From under the chin to the crown.
    float head_height() const;
    /// End of a leaf bone: the skeleton's tip, else the farthest joint below it, else the usual length along
    /// `direction`.
    Vec3 tip_of(int joint, Vec3 direction, float usual) const;

    const Skeleton& skeleton;
    const RoleMap& roles;
    const Legs& legs;
    std::span<const Transform> bind;
    float stature = 1;                                  ///< [m]
    Vec3 hips;                                          ///< [m] between the hip joints
    Vec3 left, up, front;                               ///< of the body
    float hip_half_width = 0, shoulder_half_width = 0;  ///< [m]
};

/// The two axes square to a bone, carried from a first bone by the least rotation, so that nothing twists.
struct Axes {
    Vec3 along, across, forward;

    Axes turned_to(Vec3 direction) const {
        const Quat turn = rotation_between(along, direction);
        return {direction, normalized(rotate(turn, across), across), normalized(rotate(turn, forward), forward)};
    }
};

}  // namespace surefoot
