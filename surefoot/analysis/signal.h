#pragma once
// Small signal tools for sampled tracks. All are linear in the samples (percentile sorts).

#include <surefoot/math/vec.h>

#include <span>
#include <vector>

namespace surefoot {

/// Gaussian smoothing, `sigma` in samples. The ends are continued by point reflection (2 x0 - x), which keeps the
/// slope of a travelling track. Sigma below 0.3 samples returns the input.
std::vector<Vec3> smoothed(std::span<const Vec3> track, float sigma);
std::vector<float> smoothed(std::span<const float> track, float sigma);

/// Central differences times `fps` (one-sided at the ends); zero for a track of one sample.
std::vector<Vec3> derivative(std::span<const Vec3> track, float fps);
std::vector<float> derivative(std::span<const float> track, float fps);

/// Value below which `share` (0 to 1) of the values lie; 0 for none. Copies and partially sorts.
float percentile(std::span<const float> values, float share);
inline float median(std::span<const float> values) { return percentile(values, 0.5f); }

/// The centre of the window of `width` that holds the most values; 0 for none.
float densest(std::span<const float> values, float width);

/// Adds full turns so that no step exceeds half a turn.
void unwrap_angles(std::span<float> radians);

}  // namespace surefoot
