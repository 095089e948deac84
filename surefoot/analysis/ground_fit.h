#pragma once
// The ground as the standing feet show it: one plane, or places of different height.

#include <surefoot/analysis/tracks.h>

namespace surefoot {

struct GroundFit {
    /// Height of the plane [m]: height + slope_x * x + slope_z * z.
    float height = 0, slope_x = 0, slope_z = 0;
    bool planar = true;  ///< false: the feet stand at heights that no plane explains (stairs, rubble)
    int samples = 0;     ///< feet standing still, counted in frames; 0 where none do (in-place clips)

    float at(Vec3 p) const noexcept { return height + slope_x * p.x + slope_z * p.z; }
    float steepness() const noexcept { return std::sqrt(slope_x * slope_x + slope_z * slope_z); }
};

/// Frames in which the whole sole of a foot is still, and how high its lowest point then is. Needs soles.
/// `still[side][frame]`.
std::array<std::vector<char>, 2> still_feet(const Tracks& tracks, float leg_length);

/// Robust plane through the standing soles. Optical capture volumes are often tilted by a degree (CMU's rises 9 cm over
/// 4 m), which is more than the height by which a foot clears the ground.
GroundFit fit_ground(const Tracks& tracks, float leg_length);

/// Rise of the ground in time [m/s] of a clip whose feet never stand still, as the lower hull of its soles shows it.
float ground_trend(const Tracks& tracks);

}  // namespace surefoot
