#pragma once
// How well feet stand: figures from world joint positions, the sole's outline and the ground, and nothing else. The
// solver's own idea of what is planted is not asked: *planted* is where the flat twin (the same walk on flat ground,
// un-placed) has a sole point low and slow.
//
// All derivatives are taken after a Gaussian of 25 ms. Lengths in the result are centimetres, angles degrees.

#include <surefoot/analysis/leg_track.h>
#include <surefoot/ground/ground.h>

#include <array>
#include <string>
#include <vector>

namespace surefoot {

/// Figures of planted points are NaN (`null` in JSON) where no point is planted; those of the sole's angle, where heel
/// and ball never stand at once.
struct WalkMetrics {
    double skate_cm_s = 0;         ///< mean speed of planted sole points along the ground
    double skate_level_cm_s = 0;   ///< their mean level speed: it counts a heel that peels off a slope as well
    double skate_share = 0;        ///< share of frames in which a planted point moves faster than 10 cm/s
    double skate_weighted_cm = 0;  ///< mean over frames of displacement * (2 - 2^(h/H)), H = 2.5 cm (Zhang et al. 2018)
    double drag_cm = 0;            ///< longest way that a foot goes while heel and ball lie on the ground
    double penetration_max_cm = 0, penetration_mean_cm = 0;  ///< distance to free space, all frames
    double penetration_heel_ball_cm = 0;                     ///< most of heel and ball
    double penetration_toe_mid_cm = 0;                       ///< most of toe tip and mid-sole
    double float_max_cm = 0, float_mean_cm = 0;              ///< planted points above the flat twin's height
    /// Planted sole against the plane under its heel and ball. Here and for floating, a point within 1.5 cm of an edge
    /// stands on the side of it that is nearer to its own height.
    double sole_angle_deg = 0, sole_angle_worst_deg = 0;
    int over_extensions = 0;     ///< leg-frames with the knee past 179.5 degrees where the twin's is not
    double knee_peak_ratio = 0;  ///< peak angular acceleration of the knee, against the flat twin's
    double knee_peak_deg_s2 = 0;
    double knee_min_deg = 0;            ///< smallest interior angle
    double hip_jerk_ratio = 0;          ///< RMS of the hips' vertical jerk, against the flat twin's
    double drift_m = 0, drift_deg = 0;  ///< end of the root path against the request
    int planted_samples = 0;            ///< 0 means that nothing was measured: a failure, not a pass
};

/// `twin` has the same frames on flat ground. `requested_end` is where the root was to be at the last frame.
/// The first and last `margin` seconds are left out of derivatives.
WalkMetrics measure_walk(const WalkTrack& walked, const WalkTrack& twin, const Ground& ground,
                         const RootFrame& requested_end, float margin = 0.5f);

/// What the ratios are against.
struct TwinFigures {
    double skate_cm_s = 0, knee_peak_deg_s2 = 0, hip_jerk_m_s3 = 0;
    double path_m = 0;  ///< length of the root's path, all frames
};
TwinFigures measure_twin(const WalkTrack& twin, float margin = 0.5f);

/// Distance from `point` to the nearest place outside the ground, m; 0 where it is outside. A point behind a riser
/// counts its distance to the riser's face.
float depth_in_ground(const Ground& ground, Vec3 point) noexcept;

}  // namespace surefoot
