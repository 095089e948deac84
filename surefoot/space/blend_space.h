#pragma once
// A blend space of 1 to 4 dimensions: samples at points, simplices between them, weights for any point asked for.
//
// Points live in axis units (m/s, deg/s, …). Immutable once built (by space/triangulate.h or from a project file) and
// shared; a character keeps only its last simplex as a hint, so a moving stick finds its simplex in O(1).
//
// Which weights? `barycentric` is the one that obeys: the samples' mean by these weights is the point asked for, and at
// most dimensions + 1 clips play. The others are what users of other tools expect; their mean may be off the point, and
// more clips play. Beyond the hull barycentric weights are clamped or, by choice, extrapolated; see Outside.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// How samples are weighed.
enum class Weighting : std::uint8_t {
    barycentric,    ///< of the simplex around the point
    gradient_band,  ///< Johansen 2009, "Automated Semi-Procedural Animation", §6.3; "freeform Cartesian" elsewhere
    gradient_band_polar,  ///< the same with the first two axes as direction and length: "freeform directional"
    axis_distance  ///< by distance, the nearest only: MechWarrior's axis blending (in Colvin & Kajala 2013, §II)
};

/// "barycentric", "gradient-band", "gradient-band-polar", "axis-distance".
std::string_view name_of(Weighting weighting) noexcept;
std::optional<Weighting> weighting_named(std::string_view name) noexcept;

/// What barycentric weights do for a point outside the hull.
enum class Outside : std::uint8_t {
    clamp,       ///< they are those of the nearest point of the hull
    extrapolate  ///< they go on beyond it as they ran up to it, some below 0, others above 1, within a bound
};

/// "clamp", "extrapolate".
std::string_view name_of(Outside outside) noexcept;
std::optional<Outside> outside_named(std::string_view name) noexcept;

struct BlendSpace {
    std::vector<Axis> axes;           ///< 1 to 4
    std::vector<SpacePoint> samples;  ///< at least one
    std::vector<Simplex> simplices;   ///< all of the same rank: triangles, or segments where samples lie on a line, …
    std::vector<Simplex> neighbours;  ///< neighbours[s][k]: the simplex across the face opposite vertex k, or -1

    /// Of each sample: itself or, for the copies that make wrapping axes seamless, the sample that it repeats a range
    /// away (copies come last, see add_wrap_copies). Empty where no axis wraps.
    std::vector<std::int32_t> copy_of;

    Weighting weighting = Weighting::barycentric;
    Outside outside = Outside::clamp;
    float extrapolation_bound = 0.25f;  ///< [Limit: 0 … 1] extrapolated weights stay within -bound … 1 + bound

    std::int32_t original(std::int32_t sample) const noexcept { return copy_of.empty() ? sample : copy_of[sample]; }
    /// Samples that are no copies; they come first.
    std::int32_t original_count() const noexcept {
        std::int32_t count = 0;
        while (count < static_cast<std::int32_t>(samples.size()) && original(count) == count) ++count;
        return count;
    }
    int dimensions() const noexcept { return static_cast<int>(axes.size()); }
};

/// Most samples that ever play at once: what extrapolating in four dimensions may need (a facet's four corners and a
/// simplex' five). Weightings that would use more keep the heaviest, see blend_weights.
inline constexpr int k_max_blend_weights = 2 * k_max_dimensions + 1;

/// Weights of samples, each named once and none of them a copy. They add up to 1, and are > 0 unless extrapolated.
struct BlendWeights {
    std::array<std::int32_t, k_max_blend_weights> samples{};  ///< -1 from `count` on
    std::array<float, k_max_blend_weights> weights{};
    int count = 0;
    std::int32_t simplex = 0;  ///< hand back as `hint` next time
    SpacePoint point{};    ///< where the weights are for: the asked point, clamped to the hull or its bounded outside
    bool clamped = false;  ///< `point` is not what was asked for
};

/// Weights at `point` under the space's weighting. Never fails, never allocates. `hint` is the simplex of the last
/// answer: a moving point is found in O(1). All weightings are continuous in the point (the other simplex' corners fade
/// in from 0), across the seam of wrapping axes too, and give a sample's own place to that sample alone.
///
/// - barycentric, clamped: the nearest point of the hull (distances in shares of each axis' range).
/// - barycentric, extrapolated: with q the nearest hull point and u the way from it to the asked point, w(q) + w(q) -
///   w(q - u): the weights run on beyond q as they ran up to it, which within one simplex is its barycentric weights
///   continued. A quarter of a range beyond the hull at most, and until a weight meets the bound; up to there the
///   samples' mean is the point asked for.
/// - gradient bands: influence of sample i = min over j of 1 - (p - i).(j - i) / |j - i|^2, at least 0, normalised.
///   Defined everywhere; O(samples^2). In polar form the pair's difference in the first two axes is (difference of
///   lengths over their mean, twice the angle). So that no direction is a seam, the angle's jump opposite a pair of
///   samples is spread over a third of the way round, and directions fade near the origin; further axes, and spaces of
///   one dimension, are Cartesian. Axes of one unit share one scale, or directions would be distorted.
/// - axis distance: of the k nearest samples (2 in one dimension, else 8), weights ((R - d) / (R d))^2, R the distance
///   of the next one (Franke & Nielson 1980); evaluated at the point clamped to the hull.
///
/// Of gradient bands with more than k_max_blend_weights samples in play the heaviest stay, each lightened by the
/// weight of the heaviest that goes (so that none comes or goes with a jump), and are normalised again. Where more than
/// eight samples are all equally near (the middle of a large ring with nothing in it), axis distance has no continuous
/// answer and takes the first of them.
BlendWeights blend_weights(const BlendSpace& space, const SpacePoint& point, std::int32_t hint = 0) noexcept;

/// What is wrong with a space (empty: nothing): sizes, indices, neighbours that do not point back, non-finite numbers.
std::string problem(const BlendSpace& space);

}  // namespace surefoot
