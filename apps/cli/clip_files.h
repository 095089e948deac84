#pragma once
// How every subcommand that turns clips into clips reads and writes them.

#include <surefoot/io/load.h>
#include <surefoot/rig/leg.h>

#include <string>
#include <vector>

namespace surefoot::cli {

/// The clips of a file or folder. Files that cannot be read and warnings are told on standard error; the rest go on.
/// Throws Error where nothing is left.
std::vector<LoadedClip> read_clip_files(const std::string& path, const LoadOptions& options = {});

struct WriteOptions {
    std::string rotation_order;  ///< of a BVH; empty: that of the file the clip came from
    bool mesh = true;            ///< a .glb wears a mannequin where the skeleton has legs
    Legs legs{};                 ///< where its soles are; unknown: found in the first clip
};

/// Throws Error where the name of a file to write says neither .bvh nor .glb: before long work.
void check_clip_output(const std::string& file);

/// Writes by the extension of `file`: a BVH holds one clip, a GLB as many as there are, with their extras.
void write_clip_file(const std::vector<LoadedClip>& clips, const std::string& file, const WriteOptions& options = {});

}  // namespace surefoot::cli
