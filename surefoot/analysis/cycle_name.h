#pragma once
// Readable names for cycles that the program cuts itself.

#include <surefoot/analysis/clip_facts.h>

#include <string>

namespace surefoot {

/// "idle", "turn_left_90", "walk_1.40mps", "jog_2.6mps_right_35", "strafe_left_0.80mps", "back_1.10mps",
/// "crouch_walk_0.90mps": what the clip does, by its facts alone. Turn rates below 8 deg/s are not named.
/// `airborne`: both feet are off the ground at some time.
std::string cycle_name(const ClipFacts& facts, float leg_length, bool airborne);

}  // namespace surefoot
