#pragma once
// Gaits that are played live, as the command line names them.

#include <surefoot/harmonic/gait_style.h>
#include <surefoot/live/live.h>
#include <surefoot/rig/roles.h>

#include <string>

namespace surefoot::cli {

struct LiveGait {
    std::string name;
    LiveRig rig;
    RoleMap roles;
    float speed = 1.4f, turn_deg = 0;        ///< that it has unless asked for another
    float least_speed = 0, most_speed = 10;  ///< [m/s] that may be asked for
};

/// A file of a fitted gait (.json with the key surefoot_gait) or of expressions (.gait), or the name of one that the
/// program carries, where no file is called so.
bool is_live_gait(const std::string& name);

/// The gait named, as `style` says. One of expressions is played for a cycle on the generated biped and fitted. Throws
/// Error.
LiveGait read_live_gait(const std::string& name, const GaitStyle& style = {});

}  // namespace surefoot::cli
