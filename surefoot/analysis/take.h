#pragma once
// What is a take: a recording that may hold several actions, rather than a clip of one.

#include <surefoot/analysis/clip_facts.h>

namespace surefoot {

inline constexpr float k_take_seconds = 8;  ///< [s] no single action of a game's clip set lasts longer

/// So long that some moment in it may be anything, a T-pose or a fall, without speaking against the rest.
inline bool lasts_like_a_take(const ClipFacts& facts) noexcept { return facts.duration > k_take_seconds; }

}  // namespace surefoot
