#pragma once
// Ways to walk a course: what a character is asked for, one thing after the other.

#include <string>
#include <vector>

namespace surefoot {

/// Something to ask for, and for how long.
struct PathLeg {
    bool goes = true;  ///< at the walk's speed; false: stands
    float turn = 0;    ///< [deg/s] positive to the left
    float seconds = 1;
};

/// "straight", "curve", "eight", "start-stop".
const std::vector<std::string>& path_names();

/// straight; curve (30 deg/s, by turns to the left and to the right, so that it gets ahead); eight (two circles at that
/// rate, one to either side); start-stop (stand, go, stop and go again, over and over). Legs for `seconds` at least.
/// `turn` [deg/s] is that of a straight way, for gaits that turn by themselves. Throws Error for another name.
std::vector<PathLeg> walk_path(const std::string& name, float seconds, float turn = 0);

/// Where a path stands.
class PathClock {
  public:
    /// The leg that holds now; the last holds for good.
    const PathLeg& leg(const std::vector<PathLeg>& legs) const noexcept { return legs[at_]; }
    void advance(const std::vector<PathLeg>& legs, float dt) noexcept;

  private:
    std::size_t at_ = 0;
    float spent_ = 0;
};

}  // namespace surefoot
