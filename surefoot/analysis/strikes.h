#pragma once
// The steps of a cycle, put in order: what a shared phase rests on.

#include <surefoot/analysis/clip_facts.h>

#include <span>
#include <vector>

namespace surefoot {

/// The foot strikes of one pass through a cyclic clip in order of time [s, clamped to 0 … duration], left and right in
/// turn. Empty where there are none and where they do not alternate all the way round (an odd number of steps, two of
/// one foot in a row): such a clip cannot be kept in step with others. A strike on the seam that is reported at both
/// ends counts once.
std::vector<PhaseEvent> alternating_strikes(std::span<const PhaseEvent> events, float duration, float fps);

}  // namespace surefoot
