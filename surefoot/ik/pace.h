#pragma once
// How fast the ground ahead lets a character go. Inner header of the ik room.
//
// A step that climbs more than a share of the leg folds a knee further than knees fold, and no foot placement mends
// that: the step itself must be shorter. So the ground is probed along the way, every place is asked how long a step it
// bears, and what that is in speed, at the rate of the character's own steps, is handed back to steering, early enough
// to slow down.

#include <surefoot/ik/foot_forecast.h>

namespace surefoot {

/// Measures how often the character steps, from a new forecast.
void measure_cadence(PaceState& pace, const Forecast& forecast) noexcept;

/// One frame: looks along the way now and then.
void keep_pace(const FootRig& rig, FootPlacementState& state, const FootInput& input, const GroundProbe& probe,
               const LegPreview& preview) noexcept;

}  // namespace surefoot
