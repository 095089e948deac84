#pragma once
// Cycles of fitted gaits for a library of clips: as clean on the floor as if they were made by numbers.

#include <surefoot/harmonic/gait_style.h>
#include <surefoot/motion/motion.h>

namespace surefoot {

/// One cycle at 60 frames a second from the left foot's strike on, which closes exactly. A foot that stands is still,
/// flat or rolling over its heel and toes, which lie on the floor; in the swing it goes the gait's own way between its
/// places. Hips sink as far as both legs need. Root velocity and turn are steady and exactly as asked, on level ground,
/// with the hips above the root in the mean, and the right foot strikes at half of the cycle. The number of frames is
/// even, so cadence changes by up to 2 %. `style` may do what it does to any gait.
/// Throws Error as bake_gait does (fit/fit_gait.h), and where the gait has no feet or is made for stairs.
Motion grounded_cycle(const HarmonicGait& gait, float speed, float turn_deg, const GaitStyle& style = {});

}  // namespace surefoot
