#pragma once
// Numbers that a person sets for clips, in a file beside them: walk.surefoot.json beside walk.bvh (or .glb, .fbx, …).
//
//     { "style": 0.3, "load_kg": 12 }
//
// Each number is the clip's value on an axis of that name (`surefoot author --axes speed,turn,style`). In a file of
// many clips they hold for all of them, and "clips" may say otherwise for some:
//
//     { "style": 0, "clips": { "Walk_Tired": { "style": 1 } } }

#include <surefoot/io/clip_file.h>

#include <span>
#include <string>
#include <string_view>

namespace surefoot {

/// The sidecar's path for a clip file: the extension exchanged.
std::string sidecar_path(std::string_view clip_file);

/// Gives the clips of one file their numbers from the text of its sidecar; `where` names that for messages. Throws
/// Error where it is no JSON object, names something that is measured (speed, turn, …), holds anything but finite
/// numbers, or speaks of a clip that is not in the file.
void apply_sidecar(std::string_view json, const std::string& where, std::span<LoadedClip> clips);

}  // namespace surefoot
