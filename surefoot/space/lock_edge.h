#pragma once
// Edges a user draws by hand: two samples that must stay joined whatever Delaunay thinks.

#include <surefoot/space/blend_space.h>

#include <array>
#include <span>

namespace surefoot {

/// Makes the edge between samples `a` and `b` part of a triangulated 2-D space by flipping the diagonals it crosses
/// (Sloan 1993, "A fast algorithm for generating constrained Delaunay triangulations"). True where the edge is there
/// afterwards; false, with the space unchanged, where a third sample lies on it, where it crosses an edge locked
/// earlier (`locked`), or where the space is not 2-D and the edge is not there already.
bool lock_edge(BlendSpace& space, std::int32_t a, std::int32_t b,
               std::span<const std::array<std::int32_t, 2>> locked = {});

/// True where the two samples are corners of one simplex.
bool has_edge(const BlendSpace& space, std::int32_t a, std::int32_t b) noexcept;

}  // namespace surefoot
