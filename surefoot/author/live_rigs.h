#pragma once
// Fitted gaits made ready to be played live (live/live.h).

#include <surefoot/harmonic/gait_style.h>
#include <surefoot/live/live.h>

#include <memory>
#include <string>

namespace surefoot {

enum class GaitCompany {
    alone,
    bundled  ///< who walks and runs can crouch as well, as manner 1, and all breathe while they stand
};

/// The gait as live rigs have it: its feet held (holding_feet), for those of captures slide, and what is played live
/// cannot be mended afterwards as baked clips are. Gaits that stand or climb, have no feet, or are held already stay as
/// they are. Takes some hundredths of a second.
HarmonicGait as_played_live(const HarmonicGait& gait);

/// `bundled` company is for gaits that the program carries (fitted_gaits.h): all are of one body. `name` is what the
/// user called it. Throws Error where it cannot be played live.
/// Walking and crouching alike go as `style` says.
LiveRig live_rig_of(const HarmonicGait& gait, GaitCompany company, const std::string& name,
                    const GaitStyle& style = {});

/// The rig of a file of a fitted gait or, where no file is called so, of a gait that the program carries. Throws Error.
LiveRig read_live_rig(const std::string& name);

}  // namespace surefoot
