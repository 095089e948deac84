#pragma once
// Ways to walk a course: what a character is asked for, one thing after the other.

#include <surefoot/ik/foot_placement.h>

#include <string>
#include <vector>

namespace surefoot {

/// Something to ask for, and for how long.
struct PathLeg {
    bool goes = true;  ///< at the walk's speed; false: stands
    float turn = 0;    ///< [deg/s] positive to the left
    float seconds = 1;
    // What a host adds to the root by itself, that no clip knows of:
    float host_turn = 0;   ///< [deg/s] positive to the left
    float host_slide = 0;  ///< [m/s] to the left
};

/// "straight", "curve", "eight", "start-stop", "turns", "host-turns".
const std::vector<std::string>& path_names();

/// straight; curve (30 deg/s, by turns to the left and to the right, so that it gets ahead); eight (two circles at that
/// rate, one to either side); start-stop (stand, go, stop and go again, over and over); turns (go, stop, turn on the
/// spot by 180 degrees to the left at 60 deg/s and back at 45, and go on); host-turns (go, stop, and while it stands
/// its host turns it by 180 degrees to the left at 90 deg/s and back at 45, and slides it half a metre to the left and
/// back). Legs for `seconds` at least. `turn` [deg/s] is that of a straight way, for gaits that turn by themselves.
/// Throws Error for another name.
std::vector<PathLeg> walk_path(const std::string& name, float seconds, float turn = 0);

/// What a host adds to a root by itself, steadily.
struct HostWay {
    float turn = 0;   ///< [deg/s] positive to the left
    float slide = 0;  ///< [m/s] to the left

    RootFrame in(float seconds) const noexcept;
    friend bool operator==(const HostWay&, const HostWay&) = default;
};

/// What a path asks for now, no faster than a limit.
class Steering {
  public:
    /// No legs: straight ahead.
    explicit Steering(std::vector<PathLeg> legs);

    /// Back to the first leg; the limit stays.
    void restart() noexcept { at_ = 0, spent_ = 0; }
    /// The last leg holds for good.
    void advance(float dt) noexcept;
    void limit_speed(float mps) noexcept { limit_ = mps; }
    /// Takes over from the path: from now on it goes, and turns as said [deg/s].
    void take_over(float turn) noexcept;

    /// [m/s] of who would go at `asked`, which may be backward.
    float speed(float asked) const noexcept;
    /// [deg/s] positive to the left.
    float turn() const noexcept { return legs_[at_].turn; }
    HostWay host() const noexcept { return {legs_[at_].host_turn, legs_[at_].host_slide}; }
    /// True where some leg of the path has a host that adds something.
    bool has_host() const noexcept;

  private:
    std::vector<PathLeg> legs_;
    std::size_t at_ = 0;
    float spent_ = 0;                 // [s] in the leg
    float limit_ = k_no_speed_limit;  // [m/s]
};

}  // namespace surefoot
