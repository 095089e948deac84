#pragma once
// Paths of the legs through the world, and how well their feet stand and their knees move: the figures that walks over
// courses (course/) and blends of clips (probe/) share.
//
// *Planted* is where the flat twin (the same motion on flat ground, un-placed; on flat ground the motion itself) has a
// sole point low and slow. All derivatives are taken after a Gaussian of 25 ms.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/leg.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace surefoot {

inline constexpr int k_sole_points = 4;  ///< heel, mid-sole, ball, toe tip

/// World positions of one leg at one frame.
struct LegTrack {
    Vec3 hip, knee, ankle;
    std::array<Vec3, k_sole_points> sole;
    Vec3 sole_up{0, 1, 0};  ///< unit: away from the ground, of the foot
};

struct TrackFrame {
    RootFrame root;
    Vec3 hips;
    std::array<LegTrack, 2> legs;
};

struct WalkTrack {
    float fps = 60;
    std::vector<TrackFrame> frames;
};

/// One frame of it: `world` are the joints' transforms.
TrackFrame track_frame(const RootFrame& root, std::span<const Transform> world, const Legs& legs);

/// The track of a world motion.
WalkTrack make_track(const Motion& motion, const Legs& legs);

/// Frames [first, end) of a track that are measured; those around them only feed the derivatives.
struct FrameRange {
    std::size_t first = 0, end = 0;
};

/// When a sole point (0 heel, 1 mid, 2 ball, 3 toe tip) of the flat twin is planted: within 1.5 cm of its own 3rd
/// percentile of height and slower than 0.25 m/s.
std::vector<bool> planted_frames(const WalkTrack& twin, std::size_t side, std::size_t point);

/// The ground under a sole point.
struct UnderFoot {
    float height = 0;  ///< [m]
    Vec3 normal{0, 1, 0};
};

/// Speeds are along the ground: what goes along its normal lifts off, or sinks in, and does not slide. (A heel that
/// peels off a slope as it does off the level moves sideways by the slope's sine of it, without skating.) NaN where no
/// point is planted.
struct SkateFigures {
    double mean_cm_s = 0;      ///< mean speed of planted sole points along the ground
    double level_cm_s = 0;     ///< mean level speed of the same: on flat ground the same figure
    double share = 0;          ///< share of standing frames in which a planted point moves faster than 10 cm/s
    double weighted_cm = 0;    ///< mean of displacement a frame * (2 - 2^(h/H)), H = 2.5 cm (Zhang et al. 2018)
    int planted_samples = 0;   ///< points times frames; 0 means that nothing was measured
    std::size_t standing = 0;  ///< frames in which some point is planted
};

/// Skate of `walked` where `twin` (of the same frames, or the same track) is planted. `ground` tells what is under
/// a point; none: level ground at 0.
SkateFigures measure_skate(const WalkTrack& walked, const WalkTrack& twin, FrameRange range,
                           const std::function<UnderFoot(Vec3)>& ground = {});

/// The longest way [cm] along level ground that a foot goes while it lies on it, heel and ball within 1 cm of the
/// ground or in it. Asks neither the twin nor anybody's idea of what is planted: a foot that is dragged is as fast as
/// one that swings, and still lies.
double longest_drag_cm(const WalkTrack& walked, FrameRange range, const std::function<UnderFoot(Vec3)>& ground = {});

/// Interior angle of the knee, degrees: 180 is a straight leg.
double knee_angle(const LegTrack& leg);

/// Largest angular acceleration of a knee, deg/s^2.
double knee_peak(const WalkTrack& track, std::size_t side, FrameRange range);

/// Gaussian of 25 ms over a series at `fps`; mirrored through the ends, so that a straight line stays straight.
std::vector<double> smoothed_series(const std::vector<double>& series, double fps);

}  // namespace surefoot
