#pragma once
// Edges and simplices a user draws by hand: two samples that must stay joined whatever Delaunay thinks.

#include <surefoot/space/blend_space.h>

#include <array>
#include <span>

namespace surefoot {

/// Makes the edge between samples `a` and `b` part of a triangulated 2-D space by flipping the diagonals it crosses
/// (Sloan 1993, "A fast algorithm for generating constrained Delaunay triangulations"). True where the edge is there
/// afterwards; false, with the space unchanged, where a third sample lies on it, where it crosses an edge locked
/// earlier (`locked`), or where the space is not 2-D and the edge is not there already.
/// With a wrapping axis nothing is flipped, or both sides of the seam would come to differ: true where the edge is
/// there.
bool lock_edge(BlendSpace& space, std::int32_t a, std::int32_t b,
               std::span<const std::array<std::int32_t, 2>> locked = {});

/// The same for a whole simplex: in 2-D its three edges are locked (nothing changes unless all of them can be and no
/// sample lies inside); in other dimensions nothing is flipped, and the answer tells whether the simplex is there.
/// `corners` are dimensions + 1 samples.
bool lock_simplex(BlendSpace& space, std::span<const std::int32_t> corners,
                  std::span<const std::array<std::int32_t, 2>> locked = {});

/// True where these samples, in any order, are the corners of a simplex.
bool has_simplex(const BlendSpace& space, std::span<const std::int32_t> corners) noexcept;

/// True where the two samples are corners of one simplex.
bool has_edge(const BlendSpace& space, std::int32_t a, std::int32_t b) noexcept;

}  // namespace surefoot
