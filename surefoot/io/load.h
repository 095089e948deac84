#pragma once
// Clips from files and folders, whatever their format: the door through which every subcommand takes CLIPS.

#include <surefoot/io/clip_file.h>

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

struct LoadFailure {
    std::string file;   ///< as the user gave it, or as found in the folder they gave
    std::string error;  ///< what, where, what to do
};

struct LoadResult {
    std::vector<LoadedClip> clips;  ///< sorted by path bytewise, then by index in the file; names unique
    std::vector<LoadFailure> failed;
};

/// Reads every clip of `paths`: files (.bvh, .glb, .gltf, .fbx, .dae), folders (searched recursively), and `FILE#NAME`
/// or `FILE#3` (counted from 0) for one clip of a file. Files are read in parallel; the result does not depend on the
/// thread count. A file that cannot be read is listed in `failed` and the rest go on. Clips of equal skeletons share
/// one Skeleton. A sidecar beside a file gives its clips
/// numbers of the user's own (io/sidecar.h). Does not throw for bad input.
LoadResult load_clips(std::span<const std::string> paths, const LoadOptions& options = {});

/// The same from files in memory, by name, their sidecars among them; what is neither clip nor sidecar is passed over.
LoadResult load_clips_in_memory(const std::map<std::string, std::string>& files, const LoadOptions& options = {});

/// All clips of one file given as bytes; `where` is its name as shown in messages and decides the format by its
/// extension. Throws Error. External buffers of a .gltf are read from the file's own folder only.
std::vector<LoadedClip> read_clips(std::string_view bytes, const std::string& where, const LoadOptions& options = {});

/// True where the extension of `path` is one that load_clips reads.
bool is_clip_file(std::string_view path);

}  // namespace surefoot
