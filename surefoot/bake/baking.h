#pragma once
// What baking from disk and from memory share. Private to bake/.

#include <surefoot/analysis/analyze.h>
#include <surefoot/bake/character.h>

namespace surefoot {

/// A clip on its way into a character.
struct BakeSource {
    const Motion* motion;
    const ClipFacts* facts;
    bool along_travel = false;
};

/// Clips that the spaces use: indices, ascending. Throws Error where there are none or one is out of range.
std::vector<std::int32_t> used_clips(std::span<const ProjectSpace> spaces, std::size_t available);

/// The clip that stands most nearly still: soles and standing height are read off it.
std::size_t calmest(std::span<const BakeSource> sources);

/// Packs the sources (those of `used`, in its order) in parallel and joins them with the spaces. `body` is the calmest
/// of them, measured: roles, legs and standing pose come from it.
Character bake(const std::string& name, std::span<const BakeSource> sources, std::span<const ProjectSpace> spaces,
               const std::vector<std::int32_t>& used, const AnalyzedClip& body, const BakeOptions& options);

}  // namespace surefoot
