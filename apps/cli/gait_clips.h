#pragma once
// Gaits where clips are taken: "walk.gait" and "bhatti2017#run@speed=3" beside files and folders.

#include "parameters.h"

#include <surefoot/author/retarget_clips.h>
#include <surefoot/gait_clip/gait_clip.h>
#include <surefoot/io/load.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace surefoot::cli {

inline constexpr Bundle k_gaits{"gait", bundled_gait, bundled_gait_names};
/// A file, or a gait that the program carries. Throws Error.
Gait read_gait_named(const std::string& name, GaitOutputs outputs = GaitOutputs::controls);

/// A gait as a command line names it: GAIT[#PRESET][@NAME=VALUE,…], where NAME is speed, turn, slope or a parameter.
/// Of fitted gaits the preset is a personality, and parameters are sliders.
struct GaitRequest {
    std::string gait, preset;
    std::vector<std::string> set;              ///< parameters, name=value
    std::optional<double> speed, turn, slope;  ///< [m/s, deg/s, deg] where asked for
};
/// True where the text, up to # and @, ends in ".gait" or names a gait that the program carries and no file.
bool names_gait(const std::string& text);
/// Needs names_gait(text). Throws Error for what is no number.
GaitRequest parse_gait_request(const std::string& text);

/// Someone whom gaits move.
GaitActor gait_actor(const Actor& actor);

/// A played gait as a clip to write or to author, with its facts and where it comes from. `source` is how a user named
/// it.
LoadedClip as_loaded(AnalyzedClip clip, const std::string& source);

/// As load_clips, with gaits among the paths, played on `actor` (none: on the generated biped), after the files. A gait
/// that cannot be read or played is listed in `failed`.
LoadResult load_clips_and_gaits(std::span<const std::string> paths, const LoadOptions& options = {},
                                const Actor* actor = nullptr);

}  // namespace surefoot::cli
