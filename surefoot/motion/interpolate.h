#pragma once
// A new cycle between clips: what their blend at equal phase looks like, as a clip of its own.
//
// The clips are laid over each other foot strike by foot strike: between two strikes each runs at its own steady pace
// (piecewise warp), so no step is doubled and none falls between. Rotations are the normalised weighted sum that the
// runtime blends with, translations the weighted mean. The root covers the weighted mean of the strides in the weighted
// mean of the velocities: the cycle lasts |sum w s| / |sum w v|, and where both vanish, the mean frequency decides
// (DESIGN §4; a quarter of a metre stands for a radian of turn, so that turning on the spot keeps its rhythm).

#include <surefoot/motion/motion.h>

#include <span>
#include <vector>

namespace surefoot {

struct PhasedClip {
    const Motion* motion = nullptr;
    /// [s] moments that correspond between the clips, ascending: left strike, right strike, left strike again. The
    /// last is one cycle after the first and may lie past the end of a cyclic clip. Empty for a clip without steps,
    /// which lends its first pose and no travel.
    std::vector<float> marks;
    float weight = 0;  ///< [Limit: >= 0]
};

/// One cycle at `fps` frames a second or little off it (a whole number of frames fills the cycle), begun at the first
/// mark, cyclic, root at the origin. Weights are normalised. All clips need extracted root motion, one skeleton, and
/// the same number of marks where they have any. Throws Error where there is nothing to mix or something does not fit.
Motion interpolate(std::span<const PhasedClip> clips, float fps);

}  // namespace surefoot
