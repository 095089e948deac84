#pragma once
// What a cyclic clip does to the floor, for tests of this room.

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/leg_track.h>
#include <surefoot/motion/edit.h>

#include <algorithm>
#include <vector>

namespace surefoot {

/// [cm/s] over a cycle that has neighbours on both sides.
inline double skate_of(const AnalyzedClip& clip) {
    const WalkTrack track = make_track(concatenate(std::vector<Motion>(3, clip.motion)), clip.legs);
    const auto frames = static_cast<std::size_t>(clip.motion.frame_count() - 1);
    return measure_skate(track, track, {frames, 2 * frames}).mean_cm_s;
}

/// [m] Lowest sole point against ground that rises by `rise` a metre ahead.
inline float lowest_sole(const AnalyzedClip& clip, float rise = 0) {
    float lowest = 1;
    for (const TrackFrame& frame : make_track(clip.motion, clip.legs).frames)
        for (const auto& leg : frame.legs)
            for (const Vec3 point : leg.sole) lowest = std::min(lowest, point.y - rise * point.z);
    return lowest;
}

}  // namespace surefoot
