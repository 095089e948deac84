#pragma once
// Weights that come from all samples instead of one simplex. Private to the room; blend_space.h says what they are.

#include <surefoot/space/blend_space.h>

namespace surefoot {

/// Fills samples, weights and count. Under gradient_band_polar the first two axes are direction and length, unless one
/// of them wraps.
void gradient_band_weights(const BlendSpace& space, const SpacePoint& point, BlendWeights& result) noexcept;
void axis_distance_weights(const BlendSpace& space, const SpacePoint& point, BlendWeights& result) noexcept;

}  // namespace surefoot
