#pragma once
// What every reader of clips gives back, and what it may be told.

#include <surefoot/motion/motion.h>

#include <map>
#include <string>
#include <vector>

namespace surefoot {

struct LoadOptions {
    /// Metres per unit of the file. 0: guessed from the character's size, see io/unit_scale.h.
    double unit_scale = 0;
    /// A skinned character without animation comes as one frame in its rest pose; else it is an error.
    bool still = false;
};

struct LoadedClip {
    Motion motion;         ///< in metres; root frames are identity unless the file is one of ours
    std::string file;      ///< as the user gave it, with "#NAME" where the file holds several clips
    float unit_scale = 1;  ///< factor that turned the file's units into metres
    /// What a reader had to guess, mend or leave out, for a person to read.
    std::vector<std::string> warnings;
    /// A JSON object as text: what write_glb was given for this clip (phase events, provenance). Empty elsewhere.
    std::string extras;
    /// The order of rotation channels of a BVH file ("ZYX"), for writing it back; empty elsewhere.
    std::string rotation_order;
    /// Numbers that a person set for the clip in a file beside it (io/sidecar.h): axis name to value.
    std::map<std::string, float> custom;
};

}  // namespace surefoot
