#pragma once
// Where each clip goes: which spaces a set of clips needs, and the place of every clip in them (DESIGN §6; Delicado &
// Pelechano 2019, §3.1).
//
// Clips that travel roughly where they face (|travel| <= 30 or >= 150 deg), turn on the spot or stand go to "facing"
// (speed, turn); sideways ones to "lateral" (forward, lateral), which shares the idle. Samples on one axis become a 1-D
// space. A user may ask for other axes, up to four a space: slope, pace and travel (size and direction of the velocity;
// travel wraps at +-180 deg), and any number from the clips' sidecars (io/sidecar.h).

#include <surefoot/author/project.h>

#include <span>
#include <string>
#include <vector>

namespace surefoot {

inline constexpr float k_facing_travel = 30;  ///< [deg] off straight ahead (or back) that still counts as facing
inline constexpr float k_standing_speed =
    0.1f;                                     ///< [m/s] below it a clip does not travel (two cycles this near are one)
inline constexpr float k_standing_turn = 10;  ///< [deg/s] below it a clip does not turn, for the same reason

/// Neither travels nor turns.
bool is_idle(const ClipFacts& facts);

/// Travels roughly where it faces, or straight back, or not at all.
bool is_facing(const ClipFacts& facts);

/// The value of a clip on an axis: "speed", "turn", "forward", "lateral", "slope", "pace", "travel", or a number of its
/// own by that name. NaN where it has none.
float axis_value(const ClipFacts& facts, std::string_view axis);

/// An axis of that name without limits yet; a name that is none of the measured ones is the user's own. Throws Error
/// for an empty name.
Axis make_axis(std::string_view name);

/// Limits that hold `values` and 0, rounded out to a step a person would choose; turn and lateral are symmetric, turn
/// at least 90 deg/s either way, travel the whole circle.
void set_limits(Axis& axis, std::span<const float> values);

/// Builds, places and triangulates the spaces of `project` from its clips that are not excluded. `axes` asks for
/// certain spaces ("speed,turn,style"); empty: as many as the clips need. Pinned places and axes, locked edges and
/// simplices, weighting and extrapolation of `before` (the project as the user left it, may be null) are kept; what
/// could not be kept is told in `warnings`. Where an axis is travel, a standing clip is a sample in each direction that
/// some clip moves in. Throws Error for an axis that no clip has a number for.
void place_clips(Project& project, std::span<const std::string> axes, const Project* before,
                 std::vector<std::string>& warnings);

/// Triangulates a space anew from its samples and clips, wrapping axes seamless, locked edges and simplices kept; those
/// that could not be are told and forgotten.
void triangulate_locked(const Project& project, ProjectSpace& space, std::vector<std::string>& warnings);

/// How much a clip is up to, in m/s: the one with least of it stands most nearly still, and shows what a body is like.
float liveliness(const ClipFacts& facts);

/// Whether a clip of these spaces moves straight along its facing when it is packed (PackOptions::along_travel): one of
/// a space that only knows speed does, unless a space with a sideways axis needs it as it is.
bool moves_along_facing(std::span<const ProjectSpace> spaces, std::int32_t clip, const ClipFacts& facts);

/// A place in words: "1.4 m/s forward, turning 90 deg/s to the left". `axes` and `values` run in parallel.
std::string describe_place(std::span<const Axis> axes, std::span<const float> values);

}  // namespace surefoot
