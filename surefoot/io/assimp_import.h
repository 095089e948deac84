#pragma once
// FBX and Collada, in, through assimp. Not there in the browser's build.

#include <surefoot/io/clip_file.h>

#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

/// All animations of an .fbx or .dae given as bytes; `where` names it and its format. Joints as in read_gltf; axes are
/// turned to ours, units guessed. Throws Error, also with what assimp has to say.
std::vector<LoadedClip> read_fbx_or_collada(std::string_view bytes, const std::string& where,
                                            const LoadOptions& options = {});

}  // namespace surefoot
