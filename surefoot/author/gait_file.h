#pragma once
// The file of a fitted gait (harmonic/harmonic_gait.h): small things in keys, then one line a series, for people to
// find their joint in. Numbers are written so that they come back to the last bit.

#include <surefoot/harmonic/harmonic_gait.h>

#include <string>
#include <string_view>

namespace surefoot {

std::string gait_to_json(const HarmonicGait& gait);

/// Throws Error, which says where in the file it was unhappy; what it returns has no `problem`.
HarmonicGait gait_from_json(std::string_view text, const std::string& where);

}  // namespace surefoot
