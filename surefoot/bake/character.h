#pragma once
// A project becomes a character: its clips packed, its blend spaces joined to them, its legs measured.

#include <surefoot/author/project.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/pack/pack_clip.h>
#include <surefoot/pack_file/pack.h>
#include <surefoot/rig/leg.h>

#include <filesystem>
#include <memory>
#include <span>

namespace surefoot {

struct AnalyzedClip;

struct BakeOptions {
    float error = 0;  ///< [m] how far clips may be from their motions: PackOptions::error
};

/// All that a runtime and its host need, plus what was learnt on the way.
struct Character {
    std::string name;
    std::shared_ptr<const Skeleton> skeleton;
    RoleMap roles;
    Legs legs;
    float hip_height = 0;             ///< [m] of the standing character
    std::vector<Transform> standing;  ///< model space: the first pose of the clip that stands most nearly still
    LocomotionGraph graph;
    BakeOptions options;              ///< of graph.clips
    std::vector<ClipFacts> facts;     ///< of graph.clips, in the same order
    std::vector<PackReport> packing;  ///< the same
    std::vector<std::string> warnings;
};

/// Loads the project's clips (those of its spaces) from `folder`, which holds the project file, and bakes them. Throws
/// Error where a clip is missing, does not fit the skeleton, or the project has no space.
Character bake_character(const Project& project, const std::filesystem::path& folder, const BakeOptions& options = {});

/// The same from wherever the files are. `where` stands before their names in messages.
Character bake_character(const Project& project, const ReadProjectFile& read, const std::string& where = {},
                         const BakeOptions& options = {});

/// The same from clips in memory; the spaces' `clips` index into `clips`.
Character bake_character(std::span<const AnalyzedClip> clips, std::span<const ProjectSpace> spaces,
                         const std::string& name = {}, const BakeOptions& options = {});

/// The same as a pack without a program, and back: what a host needs is in both.
Pack to_pack(const Character& character);
Character to_character(const Pack& pack);

/// Packs one more clip for the character and returns its index in `graph.clips`: one that plays by itself, in no space.
/// What does not go round keeps its root as it is. Throws Error where it does not fit the skeleton.
std::int32_t add_clip(Character& character, const Motion& motion, const ClipFacts& facts);

}  // namespace surefoot
