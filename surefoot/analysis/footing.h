#pragma once
// Where a clip's ground is, and the soles that touch it.

#include <surefoot/analysis/tracks.h>

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

}  // namespace surefoot
