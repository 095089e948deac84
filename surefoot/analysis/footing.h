#pragma once
// Where a clip's ground is, and the soles that touch it.

#include <surefoot/analysis/tracks.h>

#include <span>

namespace surefoot {

struct Footing {
    Legs legs;
    float floor = 0;         ///< [m] world height that the standing soles touch most
    bool from_rest = false;  ///< the soles were measured in the rest pose, not in the motion
};

/// Soles come from the rest pose where that shows a standing character (skinned rigs), else from the frames in which
/// each foot lies flattest (motion capture, whose rest pose often has splayed legs or no shape at all). The floor is
/// the height at which soles spend most of their time: dips of a toe tip or a jump do not move it. A floor within
/// 1.5 cm of y = 0 is y = 0.
Footing find_footing(const Motion& motion, const RoleMap& roles, const Tracks& tracks);

/// The floor [m] as given soles show it, found like that of find_footing.
float floor_under(const Motion& motion, const RoleMap& roles, const Legs& legs);

/// Soles that are alike on both feet. A foot of a short clip may never lie flat, or spend more time at one height in
/// the air than on the ground, and is then taken for standing there on its toes. Where one ankle stands half as high
/// again as the other, that foot is measured anew in the frame in which it stands most like the lower one. Else `legs`
/// come back as they are.
Legs matched_soles(const Motion& motion, const RoleMap& roles, const Legs& legs);

/// Heels are round, and a skeleton does not tell how far they reach behind the ankle. Where feet come down toes up and
/// the heel of `legs` is in the ground (y = 0), the sole ought to end where it meets the ground. That is asked of all
/// such frames of `clips`, and the lower quartile counts: feet that are still in the air say more. Heels that are
/// clearly too long end there, alike on both feet, but no nearer to the ankle than a quarter of the way to the ball. A
/// foot that is in the ground as a whole says nothing. Else `legs` come back as they are.
Legs rounded_heels(const Legs& legs, std::span<const Tracks> clips);

}  // namespace surefoot
