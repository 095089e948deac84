#pragma once
// The bundled family of gaits as a live rig.

#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/live_rigs.h>
#include <surefoot/live/live.h>

namespace surefoot::test {

inline std::shared_ptr<const HarmonicGait> bundled_family() {
    static const auto gait = std::make_shared<const HarmonicGait>(as_played_live(fitted_gait("human")));
    return gait;
}

inline const LiveRig& bundled_rig() {
    static const LiveRig rig = make_live_rig({{"human", bundled_family(), nullptr}});
    return rig;
}

/// The same, breathing while it stands.
inline const LiveRig& bundled_breathing_rig() {
    static const LiveRig rig = make_live_rig({{"human", bundled_family(), nullptr}},
                                             std::make_shared<const HarmonicGait>(fitted_gait("idle")));
    return rig;
}

/// The same, and it can crouch.
inline const LiveRig& bundled_crouching_rig() {
    static const LiveRig rig = make_live_rig(
        {{"human", bundled_family(), nullptr},
         {"crouch", std::make_shared<const HarmonicGait>(as_played_live(fitted_gait("crouch"))), nullptr}},
        std::make_shared<const HarmonicGait>(fitted_gait("idle")));
    return rig;
}

}  // namespace surefoot::test
