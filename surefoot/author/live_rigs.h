#pragma once
// Fitted gaits made ready to be played live (live/live.h).

#include <surefoot/live/live.h>

#include <memory>
#include <string>

namespace surefoot {

/// A gait that the program carries (fitted_gaits.h), with what belongs to it: who walks and runs can crouch as well, as
/// manner 1, and all breathe while they stand. Check `problem`.
LiveRig bundled_live_rig(std::shared_ptr<const HarmonicGait> gait);

/// The rig of a file of a fitted gait or, where no file is called so, of a gait that the program carries. Throws Error.
LiveRig read_live_rig(const std::string& name);

}  // namespace surefoot
