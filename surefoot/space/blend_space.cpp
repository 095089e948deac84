#include <surefoot/space/influence.h>
#include <surefoot/space/lookup.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace surefoot {
namespace {

/// Finite, and wrapping axes turned back into their range.
SpacePoint tamed(const BlendSpace& space, const SpacePoint& point) noexcept {
    constexpr float k_far = 1000;  // ranges: farther out the nearest hull point is the same for all practical purposes
    SpacePoint p{};
    for (int k = 0; k < space.dimensions(); ++k) {
        const Axis& axis = space.axes[k];
        const float range = axis.high - axis.low, low = axis.low - k_far * range, high = axis.high + k_far * range;
        p[k] = point[k] != point[k] ? 0.0f : point[k] < low ? low : point[k] > high ? high : point[k];
        if (axis.wraps) p[k] -= std::floor((p[k] - axis.low) / range) * range;
    }
    return p;
}

/// Weights being collected: copies count for their originals, what weighs nothing is left out.
class Collector {
  public:
    explicit Collector(const BlendSpace& space) noexcept : space_(space) {}

    void add(std::int32_t sample, double weight) noexcept {
        sample = space_.original(sample);
        int at = 0;
        while (at < count_ && samples_[at] != sample) ++at;
        if (at == k_most) return;  // not reached: two simplices have no more corners
        if (at == count_) {
            samples_[count_] = sample;
            weights_[count_++] = 0;
        }
        weights_[at] += weight;
    }
    void add(const Located& found, double factor) noexcept {
        const Simplex& simplex = space_.simplices[found.simplex];
        for (int k = 0; k < k_corners; ++k)
            if (found.weights[k] > 0) add(simplex[k], factor * found.weights[k]);
    }
    int count() const noexcept { return count_; }
    double weight(int at) const noexcept { return weights_[at]; }
    std::int32_t sample(int at) const noexcept { return samples_[at]; }
    double weight_of(std::int32_t sample) const noexcept {
        for (int at = 0; at < count_; ++at)
            if (samples_[at] == sample) return weights_[at];
        return 0;
    }

    /// Brought to a sum of one; rounding dust beyond the capacity of an answer goes.
    void give(BlendWeights& result) noexcept {
        const auto size = [&](int at) { return std::fabs(weights_[at]); };
        while (count_ > k_max_blend_weights) {
            int least = 0;
            for (int at = 1; at < count_; ++at)
                if (size(at) < size(least)) least = at;
            --count_;
            samples_[least] = samples_[count_];
            weights_[least] = weights_[count_];
        }
        double sum = 0;
        for (int at = 0; at < count_; ++at) sum += weights_[at];
        result.samples.fill(-1);
        result.weights.fill(0);
        result.count = 0;
        for (int at = 0; at < count_; ++at) {
            const auto weight = static_cast<float>(weights_[at] / sum);
            if (weight == 0) continue;
            result.samples[result.count] = samples_[at];
            result.weights[result.count++] = weight;
        }
    }

  private:
    static constexpr int k_most = 2 * k_corners;
    const BlendSpace& space_;
    std::array<std::int32_t, k_most> samples_{};
    std::array<double, k_most> weights_{};
    int count_ = 0;
};

/// A point of the lookup in axis units, wrapping axes turned back into their range.
SpacePoint unscaled(const BlendSpace& space, const ScaledPoint& p) noexcept {
    SpacePoint point{};
    for (int k = 0; k < space.dimensions(); ++k)
        point[k] = static_cast<float>(p[k] * (static_cast<double>(space.axes[k].high) - space.axes[k].low));
    return tamed(space, point);
}

/// The weights of `found` continued from the hull point q towards the asked point: see blend_weights.
void extrapolate(const BlendSpace& space, const Lookup& lookup, const ScaledPoint& asked, const Located& found,
                 BlendWeights& result) noexcept {
    constexpr double k_least_run_up = 0.05, k_farthest = 0.25;  // of a range
    const int d = lookup.dimensions();
    const ScaledPoint q = lookup.mean(found);
    double length = 0;
    for (int k = 0; k < d; ++k) length += (asked[k] - q[k]) * (asked[k] - q[k]);
    length = std::sqrt(length);
    if (!(length > 0)) return;
    // Changes over as much of the hull as lies before them: slivers, whose weights rush, are not magnified.
    const double ahead = std::min(length, k_farthest), run_up = std::max(ahead, k_least_run_up);
    ScaledPoint back = q;
    for (int k = 0; k < d; ++k) back[k] -= (asked[k] - q[k]) * (run_up / length);
    const Located before = lookup.locate(back, found.simplex);

    Collector at_hull(space), change(space);
    at_hull.add(found, 1);
    change.add(found, 1);
    change.add(before, -1);
    const double bound = space.extrapolation_bound;
    double reach = ahead / run_up;
    for (int n = 0; n < change.count(); ++n) {
        const double start = at_hull.weight_of(change.sample(n)), rate = change.weight(n);
        if (rate * reach > 1 + bound - start) reach = (1 + bound - start) / rate;
        if (rate * reach < -bound - start) reach = (-bound - start) / rate;
    }
    const ScaledPoint start = lookup.mean(before);
    ScaledPoint reached = q;
    double off = 0;
    for (int k = 0; k < d; ++k) {
        reached[k] += reach * (q[k] - start[k]);
        off = std::max(off, std::fabs(reached[k] - asked[k]));
    }
    Collector total(space);
    total.add(found, 1 + reach);
    total.add(before, -reach);
    total.give(result);
    constexpr double k_same = 1e-6;  // of a range
    result.clamped = off > k_same;
    result.point = unscaled(space, result.clamped ? reached : asked);
}

}  // namespace

BlendWeights blend_weights(const BlendSpace& space, const SpacePoint& point, std::int32_t hint) noexcept {
    BlendWeights result;
    result.samples.fill(-1);
    if (space.simplices.empty()) {  // never triangulated: all that can be said is the first sample
        if (space.samples.empty()) return result;
        result.samples[0] = 0;
        result.weights[0] = 1;
        result.count = 1;
        result.point = space.samples[0];
        result.clamped = true;
        return result;
    }
    const SpacePoint asked = tamed(space, point);
    const Lookup lookup(space);
    const ScaledPoint p = lookup.scaled(asked);
    const Located found = lookup.locate(p, hint);
    result.simplex = found.simplex;
    result.clamped = found.outside;
    result.point = found.outside ? unscaled(space, lookup.mean(found)) : asked;
    switch (space.weighting) {
        case Weighting::gradient_band:
        case Weighting::gradient_band_polar:
            gradient_band_weights(space, asked, result);
            return result;
        case Weighting::axis_distance:
            axis_distance_weights(space, result.point, result);
            return result;
        case Weighting::barycentric:
            break;
    }
    Collector weights(space);
    weights.add(found, 1);
    weights.give(result);
    if (found.outside && space.outside == Outside::extrapolate) extrapolate(space, lookup, p, found, result);
    return result;
}

namespace {

constexpr std::string_view k_weightings[] = {"barycentric", "gradient-band", "gradient-band-polar", "axis-distance"};
constexpr std::string_view k_outsides[] = {"clamp", "extrapolate"};

}  // namespace

std::string_view name_of(Weighting weighting) noexcept { return k_weightings[static_cast<std::size_t>(weighting)]; }
std::optional<Weighting> weighting_named(std::string_view name) noexcept {
    for (std::size_t i = 0; i < std::size(k_weightings); ++i)
        if (k_weightings[i] == name) return static_cast<Weighting>(i);
    return std::nullopt;
}
std::string_view name_of(Outside outside) noexcept { return k_outsides[static_cast<std::size_t>(outside)]; }
std::optional<Outside> outside_named(std::string_view name) noexcept {
    for (std::size_t i = 0; i < std::size(k_outsides); ++i)
        if (k_outsides[i] == name) return static_cast<Outside>(i);
    return std::nullopt;
}

std::string problem(const BlendSpace& space) {
    const int d = space.dimensions();
    if (d < 1 || d > k_max_dimensions) return "a blend space has 1 to 4 axes, not " + std::to_string(d);
    for (const Axis& axis : space.axes)
        if (!std::isfinite(axis.low) || !std::isfinite(axis.high) || !(axis.low < axis.high))
            return "axis \"" + axis.name + "\" needs a low limit below its high one";
    if (space.samples.empty()) return "a blend space needs at least one sample";
    for (std::size_t i = 0; i < space.samples.size(); ++i)
        for (int k = 0; k < d; ++k)
            if (!std::isfinite(space.samples[i][k]))
                return "sample " + std::to_string(i) + " has no finite place on axis \"" + space.axes[k].name + "\"";
    if (!(space.extrapolation_bound >= 0 && space.extrapolation_bound <= 1))
        return "the bound of extrapolation must lie between 0 and 1";
    if (!space.copy_of.empty() && space.copy_of.size() != space.samples.size())
        return "there are " + std::to_string(space.samples.size()) + " samples but " +
               std::to_string(space.copy_of.size()) + " of them are known as originals or copies";
    const std::int32_t originals = space.original_count();
    for (std::size_t i = 0; i < space.copy_of.size(); ++i) {
        const std::int32_t of = space.copy_of[i];
        if (of < 0 || of > static_cast<std::int32_t>(i) || space.copy_of[of] != of)
            return "sample " + std::to_string(i) + " is a copy of something that is no original";
        if (of == static_cast<std::int32_t>(i) && of >= originals)
            return "sample " + std::to_string(i) + " is an original behind copies";
    }
    if (space.neighbours.size() != space.simplices.size())
        return "there are " + std::to_string(space.simplices.size()) + " simplices but neighbours of " +
               std::to_string(space.neighbours.size());
    const auto samples = static_cast<std::int32_t>(space.samples.size());
    const auto simplices = static_cast<std::int32_t>(space.simplices.size());
    int rank = -1;
    for (std::int32_t s = 0; s < simplices; ++s) {
        const std::string where = "simplex " + std::to_string(s);
        int corners = 0;
        while (corners < k_corners && space.simplices[s][corners] >= 0) ++corners;
        if (corners < 1 || corners > d + 1) return where + " has " + std::to_string(corners) + " corners";
        if (rank >= 0 && corners != rank) return where + " has another number of corners than the ones before";
        rank = corners;
        for (int k = 0; k < k_corners; ++k) {
            const std::int32_t sample = space.simplices[s][k], next = space.neighbours[s][k];
            if (k >= corners ? sample != -1 || next != -1 : sample >= samples || next < -1 || next >= simplices)
                return where + " names a sample or neighbour that does not exist";
            for (int j = 0; j < k; ++j)
                if (k < corners && space.simplices[s][j] == sample) return where + " names a sample twice";
        }
    }
    for (std::int32_t s = 0; s < simplices; ++s)
        for (int k = 0; k < rank; ++k) {
            const std::int32_t next = space.neighbours[s][k];
            if (next < 0) continue;
            const Simplex& back = space.neighbours[next];
            if (std::find(back.begin(), back.begin() + rank, s) == back.begin() + rank)
                return "simplex " + std::to_string(next) + " is a neighbour of simplex " + std::to_string(s) +
                       " but not the other way round";
        }
    return {};
}

}  // namespace surefoot
