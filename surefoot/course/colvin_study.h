#pragma once
// What the figures 7 to 10 of Colvin & Kajala 2013 show, found in a real walk: the moment in which the hips sink most,
// and the one in which the last twist has most to mend.

#include <surefoot/course/sweep.h>
#include <surefoot/ik/colvin_trace.h>
#include <surefoot/rig/roles.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

/// One frame, world space.
struct ColvinMoment {
    float time_s = 0;
    RootFrame root;                   ///< on the ground under it
    std::vector<Transform> animated;  ///< joints as in mode none
    std::vector<Transform> placed;    ///< joints as in mode colvin2013
    ColvinFrame steps;
    std::array<ColvinTrace, 2> traces;  ///< by Side
    std::size_t side = 0;               ///< the leg to look at
};

/// Angle between the plane of a leg (hip to `knee`, relative to the hip) and the animated one, about hip -> target
/// [deg].
float knee_plane_deg(const ColvinInput& leg, Vec3 knee) noexcept;

struct ColvinStudy {
    WalkInfo info;
    std::shared_ptr<const Ground> ground;
    Legs legs;
    ColvinMoment sunk;    ///< figure 7: the hips sink most
    ColvinMoment turned;  ///< figures 8 to 10: step 4 leaves the knee's plane farthest off
};

/// Walks `info` in the modes none and colvin2013.
ColvinStudy study_colvin(Walker& walker, const WalkInfo& info);

/// The study of that one of the walks on hills with mode colvin2013 that goes most usually (straight, about 1.4 m/s);
/// none where there is none.
std::optional<ColvinStudy> study_colvin(std::span<const SweptWalk> walks, const MakeWalker& make);

/// Figures 7, 8, 9 and 10 as HTML figures with what they show in numbers.
std::string colvin_figures(const ColvinStudy& study, const RoleMap& roles);

}  // namespace surefoot
