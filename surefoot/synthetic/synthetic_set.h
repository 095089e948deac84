#pragma once
// The clips that are made from numbers alone.

#include <surefoot/motion/clip_set.h>

namespace surefoot {

/// Cyclic clips at 60 frames a second that start at a left foot strike: idle; walk, jog, run and back, each straight,
/// _left and _right; strafe_left and strafe_right; turn_left and turn_right on the spot, and the same _slow. Velocity
/// and yaw rate of Motion::root are constant, feet stand still where they stand, soles at y = 0.
/// Takes a few milliseconds; the same bytes every time.
ClipSet make_synthetic_set();

}  // namespace surefoot
