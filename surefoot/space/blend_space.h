#pragma once
// A blend space of 1 to 4 dimensions: samples at points, simplices between them, weights for any point asked for.
//
// Points live in axis units (m/s, deg/s, …). Immutable once built (by space/triangulate.h or from a project file) and
// shared; a character keeps only its last simplex as a hint, so a moving stick finds its simplex in O(1).

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

inline constexpr int k_max_dimensions = 4;
using SpacePoint = std::array<float, k_max_dimensions>;  ///< unused dimensions are 0

struct Axis {
    std::string name;         ///< "speed", "turn", "forward", "lateral", "slope" or the user's own
    std::string unit;         ///< "m/s", "deg/s", "deg"
    float low = 0, high = 1;  ///< [Limit: low < high] the axis' limits; its range, for percentages, includes 0
    bool wraps = false;       ///< high is the same place as low (headings)

    friend bool operator==(const Axis&, const Axis&) = default;
};

/// Sample indices: dimensions + 1 of them, or fewer where all samples lie on a line, a plane, …; unused entries are -1.
using Simplex = std::array<std::int32_t, k_max_dimensions + 1>;

struct BlendSpace {
    std::vector<Axis> axes;           ///< 1 to 4
    std::vector<SpacePoint> samples;  ///< at least one
    std::vector<Simplex> simplices;   ///< all of the same rank: triangles, or segments where samples lie on a line, …
    std::vector<Simplex> neighbours;  ///< neighbours[s][k]: the simplex across the face opposite vertex k, or -1

    int dimensions() const noexcept { return static_cast<int>(axes.size()); }
};

/// Weights of at most dimensions + 1 samples; they are >= 0 and add up to 1.
struct BlendWeights {
    std::array<std::int32_t, k_max_dimensions + 1> samples{};
    std::array<float, k_max_dimensions + 1> weights{};
    int count = 0;
    std::int32_t simplex = 0;  ///< hand back as `hint` next time
    SpacePoint point{};        ///< where the weights are for: the asked point, clamped to the hull
    bool clamped = false;
};

/// Weights at `point`; outside the hull, those of the nearest point of the hull (distances in shares of each axis'
/// range). Never fails, never allocates. `hint` is the simplex of the last answer: a moving point is found in O(1).
BlendWeights blend_weights(const BlendSpace& space, const SpacePoint& point, std::int32_t hint = 0) noexcept;

/// What is wrong with a space (empty: nothing): sizes, indices, neighbours that do not point back, non-finite numbers.
std::string problem(const BlendSpace& space);

}  // namespace surefoot
