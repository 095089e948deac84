#pragma once
// Motion-capture glitches found and mended: spikes, flipped joints, dropped frames, jitter, toes in the floor.
//
// Everything is judged against the joint's own motion just before and after, never against a model of how people move:
// what a body does fast it does over several frames, and what is broken jumps there and back. Only frames that are
// found broken change; all others keep their bits, and so does a clip in which nothing is found.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/leg.h>

#include <string>
#include <vector>

namespace surefoot {

enum class Glitch : std::uint8_t {
    dropped,  ///< the whole pose stands still for some frames and then catches up
    spike,    ///< a joint is somewhere else for a few frames
    flip,     ///< a joint is turned by a constant for a while (marker swaps, Euler angles over the pole)
    jitter,   ///< a joint trembles from frame to frame (not looked for below 45 frames a second)
    toes      ///< a toe tip goes through the floor
};

struct GlitchRepair {
    Glitch kind = Glitch::spike;
    int joint = k_no_joint;   ///< k_no_joint: the whole pose
    int first = 0, last = 0;  ///< frames that were changed, both included
    float degrees = 0;        ///< [deg] farthest that the joint was turned
    float metres = 0;         ///< [m] farthest that it was moved; of toes: deepest under the floor
};

struct CleanOptions {
    float spike_deg = 8;            ///< [deg] smaller jumps are left
    float spike_m = 0.02f;          ///< [m] the same for joints that move (hips)
    float spike_seconds = 0.07f;    ///< [s] longest spike; what is longer is no spike
    float flip_deg = 60;            ///< [deg] smaller turns of longer stretches are left
    float dropped_seconds = 0.35f;  ///< [s] a pose held longer is a pause
    float jitter_deg = 0.6f;        ///< [deg] tremble (RMS) below which nothing is done
    float toes_m = 0.005f;          ///< [m] toes less deep than this in all of a stretch are left
    const Legs* legs = nullptr;     ///< toes are looked at only where soles are known
    float floor = 0;                ///< [m] height of the ground in the clip's world
};

/// Mends `motion` and says what was done, by frame. Works on clips with or without extracted root motion. The first and
/// last two frames are left alone (nothing shows on which side they are wrong). Cost: linear in frames and joints.
std::vector<GlitchRepair> clean(Motion& motion, const CleanOptions& options = {});

/// "left_foot: spike of 43 deg at frame 12", "all joints: frames 30 to 33 were dropped; filled in".
std::string describe(const GlitchRepair& repair, const Skeleton& skeleton);

}  // namespace surefoot
