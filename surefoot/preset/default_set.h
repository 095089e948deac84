#pragma once
// The embedded default: clips of the bundled gaits that were learnt from people, so that everything works without a
// single downloaded file. This header is the whole seam: what makes the clips may change behind it.

#include <surefoot/motion/clip_set.h>

namespace surefoot {

/// Cyclic clips at 60 frames a second that start at a left foot strike: idle; walk, jog, run and back, each straight,
/// _left and _right; strafe_left and strafe_right; turn_left and turn_right on the spot, and the same _slow. Velocity
/// and yaw rate of Motion::root are constant, feet stand still where they stand, soles are on y = 0 or above it, and
/// what goes to the right is the mirror image of what goes to the left.
/// Takes some hundredths of a second; the same bytes every time.
ClipSet make_default_set();

}  // namespace surefoot
