#pragma once
// New stances for a character that its host moves while its clip stands. Inner header of the ik room.
//
// A host may turn or slide the root though no clip turns or goes: the clip's feet then drag over the ground, and their
// footholds are soon no longer under them. Feet are held instead, until the clip's own have gone too far from where
// they stand; then they lift, one at a time, and come down where the stance will be by the middle of their next rest.

#include <surefoot/ik/foot_forecast.h>

namespace surefoot {

/// Which standing feet the root has dragged along since the last frame. True where the feet must be planned anew: that
/// begins, or one stirs that was to rest, for steering has changed. Remembers root and feet for the next.
bool feel_drag(const FootRig& rig, FootPlacementState& state, const FootInput& input) noexcept;

/// Before planning: feet that are dragged, and shall be on, are held. The contact runs of held feet end where they have
/// gone too far and begin anew where they shall come down; feet whose clip steps by itself again are let go.
void replant(const FootRig& rig, FootPlacementState& state, Forecast& forecast) noexcept;

}  // namespace surefoot
