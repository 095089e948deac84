#pragma once
// A root that moves steadily (one velocity in its own frame, one turn rate) and carries the clip along.
//
// Runtime root motion is a weighted mean of constant velocities, while an actor's path breathes within each step. If
// the mean moved the root and the breath were dropped, planted feet would slide by it. So the clip is seen from a
// steady root instead, and the breath is left in the pose: world poses are the same, and every moment obeys.

#include <surefoot/motion/motion.h>

namespace surefoot {

struct SteadyRoot {
    Vec3 velocity;        ///< [m/s] in the root's own frame
    float turn_rate = 0;  ///< [rad/s]
    /// [frame] the motion's root seen from the steady one; the pose takes it. First and last agree where the motion's
    /// travel allows it (always, but for whole turns on the spot).
    std::vector<RootFrame> deviation;
};

/// Fits the steady root so that deviations average to nothing; with `along_travel`, so that the velocity points
/// straight ahead or straight back and the mean deviation of heading makes up for it.
SteadyRoot fit_steady_root(const Motion& motion, bool along_travel);

}  // namespace surefoot
