#pragma once
// What edits of feet share: when a foot stands, and a leg that follows its foot to another place. Private to the room.

#include <surefoot/motion/steer.h>

#include <span>
#include <vector>

namespace surefoot {

/// [frame] both included; may reach beyond the ends of a cyclic clip.
struct Stance {
    double first, last;
    double middle() const { return 0.5 * (first + last); }
};

/// The stances of one foot in order, those of a cyclic clip with some before and after; none for a foot that is never
/// lifted in a cyclic clip (it has no step to go over in), or whose flags do not cover the clip.
std::vector<Stance> stances_of(const std::vector<char>& down, const Motion& motion);

struct LegJoints {
    int upper = k_no_joint, lower = k_no_joint, foot = k_no_joint;
    bool complete() const { return upper != k_no_joint && lower != k_no_joint && foot != k_no_joint; }
};
LegJoints leg_joints(const RoleMap& roles, std::size_t side);

/// Moves and turns one foot of a pose in root space by `change`; the leg turns along in the hip and reaches for it.
/// Returns how much too short the leg was [m].
float move_foot(const Skeleton& skeleton, const LegJoints& leg, const RootFrame& change, std::span<Transform> locals);

/// Makes the last pose of a cyclic clip its first, to the last bit.
void join_ends(Motion& motion);

}  // namespace surefoot
