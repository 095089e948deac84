#pragma once
// How long is a unit of this file? BVH and FBX do not say, or lie.

#include <surefoot/motion/motion.h>

#include <span>
#include <string>

namespace surefoot {

struct UnitGuess {
    double scale = 1;     ///< metres per unit
    std::string warning;  ///< empty where the size is that of a person in metres or centimetres
};

/// From the size of the character in the first frames (largest side of the box around its joints and tips): 0.5 to 3
/// is metres, 50 to 300 centimetres, 500 to 3000 millimetres; anything else is scaled to 1.7 m, with a warning.
UnitGuess guess_unit_scale(const Motion& motion);

/// Multiplies every length of the motion by `scale`, with a skeleton of its own.
void scale_motion(Motion& motion, double scale);

/// Scales motions of one file, which share their skeleton, by `option` (metres per unit) or, where that is 0, by the
/// guess from the first one. Returns the guess or the option.
UnitGuess apply_unit_scale(std::span<Motion* const> motions, double option);

}  // namespace surefoot
