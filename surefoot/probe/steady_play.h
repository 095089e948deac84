#pragma once
// A character that keeps doing one thing, recorded. Private to the room.

#include <surefoot/bake/character.h>

namespace surefoot {

/// Whole cycles of a steady motion, with some frames before and after that only feed derivatives. Frames are about
/// 60 a second, so that a cycle has a whole number of them.
struct SteadyPlay {
    Motion motion;             ///< the root moves as the runtime moved it
    int first = 0, last = 0;   ///< frames of the whole cycles, both included: the pose at `last` is that at `first`
    std::vector<Leaf> leaves;  ///< what was blended, heaviest first
    Vec3 velocity;             ///< [m/s] of the root in its own frame
    float turn = 0;            ///< [deg/s] of the root
    bool clamped = false;      ///< asked for more than the clips cover; nothing was recorded
};

/// What the runtime does when asked for this and nothing else.
SteadyPlay play_request(const Character& character, const LocomotionRequest& request);

/// One clip of the character alone, at its own speed.
SteadyPlay play_clip(const Character& character, int clip);

}  // namespace surefoot
