#pragma once
// The blend spaces of a project for somebody to look at and to try thresholds on: what the studio's Blend space
// workspace shows.

#include <surefoot/author/lint.h>
#include <surefoot/author/project.h>
#include <surefoot/bake/character.h>

#include <span>
#include <string>
#include <vector>

namespace surefoot::wasm {

class SpaceDesk {
  public:
    /// `poses` as for `lint`.
    SpaceDesk(Project project, std::vector<PoseTable> poses);

    /// Spaces with their samples and cells, the rules with their thresholds as they are set, findings and placeholders:
    /// one JSON object (surefoot.d.mts: SpacesFacts).
    std::string describe() const;

    /// A rule's threshold, "too-close.distance=6"; empty: all back to what the project says. Throws Error, and then
    /// nothing has changed.
    void set_threshold(const std::string& text);

    /// Which clips play at a place, and how much: a JSON array, heaviest first. Throws Error where there is no such
    /// space.
    std::string weights(int space, std::span<const float> at) const;

  private:
    Project project_;
    LintSettings given_;  ///< the project's own
    std::vector<PoseTable> poses_;
    LintResult result_;
};

}  // namespace surefoot::wasm
