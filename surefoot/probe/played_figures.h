#pragma once
// What the standing feet of a steady motion say. Private to the room.

#include <surefoot/author/probe_result.h>
#include <surefoot/probe/steady_play.h>

namespace surefoot {

struct PlayedFigures {
    Vec3 velocity;       ///< [m/s] of the root over the ground, in its own frame, as the feet say
    float turn = 0;      ///< [deg/s] likewise
    float standing = 0;  ///< share of frames in which a foot stands; 0: nothing could be measured
    ProbeFigures figures;
};

/// Measures the whole cycles of what was played; errors are against `asked` velocity and `asked_turn` [deg/s].
PlayedFigures measure_play(const Character& character, const SteadyPlay& play, Vec3 asked, float asked_turn);

}  // namespace surefoot
