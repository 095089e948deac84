#include <surefoot/math/trig.h>
#include <surefoot/space/influence.h>
#include <surefoot/space/lookup.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

/// The few samples with the largest keys, in order; of equal keys the first come.
template <int Capacity>
struct Top {
    std::array<double, Capacity> key{};
    std::array<std::int32_t, Capacity> sample{};
    int count = 0;

    void offer(std::int32_t s, double k) noexcept {
        if (count == Capacity && !(k > key[count - 1])) return;
        int at = count < Capacity ? count++ : Capacity - 1;
        for (; at > 0 && k > key[at - 1]; --at) {
            key[at] = key[at - 1];
            sample[at] = sample[at - 1];
        }
        key[at] = k;
        sample[at] = s;
    }
};

/// True for samples that speak for themselves: no copies, and not at the place of an earlier one.
bool counts(const BlendSpace& space, std::int32_t i) noexcept {
    if (space.original(i) != i) return false;
    return std::find(space.samples.begin(), space.samples.begin() + i, space.samples[i]) == space.samples.begin() + i;
}

void give(const double* weight, const std::int32_t* sample, int count, BlendWeights& result) noexcept {
    double sum = 0;
    for (int n = 0; n < count; ++n) sum += weight[n];
    result.samples.fill(-1);
    result.weights.fill(0);
    result.count = 0;
    for (int n = 0; n < count; ++n) {
        const auto share = static_cast<float>(weight[n] / sum);
        if (!(share > 0)) continue;
        result.samples[result.count] = sample[n];
        result.weights[result.count++] = share;
    }
}

/// Pairs of samples and a point between them, in the space that gradient bands are made in.
class Bands {
  public:
    Bands(const BlendSpace& space, const SpacePoint& point) noexcept : space_(space), d_(space.dimensions()) {
        const auto range = [&](int k) { return static_cast<double>(space.axes[k].high) - space.axes[k].low; };
        for (int k = 0; k < d_; ++k) scale_[k] = 1.0 / range(k);
        polar_ =
            space.weighting == Weighting::gradient_band_polar && d_ > 1 && !space.axes[0].wraps && !space.axes[1].wraps;
        if (polar_ && space.axes[0].unit == space.axes[1].unit) scale_[0] = scale_[1] = std::min(scale_[0], scale_[1]);
        for (int k = 0; k < d_; ++k) p_[k] = point[k] * scale_[k];
        if (!polar_) return;
        length_ = length(p_);
        double least = 1e300;
        for (std::size_t i = 0; i < space.samples.size(); ++i) {
            const double own = length(scaled(static_cast<std::int32_t>(i)));
            if (own > k_origin) least = std::min(least, own);
        }
        sense_of_direction_ = std::min(1.0, length_ / (0.5 * least));
    }

    /// Influence of sample i on the point: 1 at its own place, 0 at every other sample's.
    double influence(std::int32_t i) const noexcept {
        const ScaledPoint own = scaled(i);
        double least = 1;
        for (std::int32_t j = 0; j < static_cast<std::int32_t>(space_.samples.size()) && least > 0; ++j) {
            const ScaledPoint other = scaled(j);
            if (j == i || other == own) continue;
            least = std::min(least, 1 - share(own, other));
        }
        return std::max(least, 0.0);
    }

  private:
    static constexpr double k_origin = 1e-6;    // [ranges] nearer to it nothing has a direction
    static constexpr double k_opposite = 1e-5;  // [rad] from a straight line

    ScaledPoint scaled(std::int32_t i) const noexcept {
        ScaledPoint q{};
        for (int k = 0; k < d_; ++k) q[k] = space_.samples[i][k] * scale_[k];
        return q;
    }
    static double length(const ScaledPoint& a) noexcept { return std::sqrt(a[0] * a[0] + a[1] * a[1]); }

    /// How far the point is on the way from `own` to `other`.
    double share(const ScaledPoint& own, const ScaledPoint& other) const noexcept {
        double along = 0, square = 0;
        const auto add = [&](double to_other, double to_point) noexcept {
            along += to_other * to_point;
            square += to_other * to_other;
        };
        if (polar_) {
            const double own_length = length(own), other_length = length(other);
            const double mean = std::max(0.5 * (own_length + other_length), k_origin);
            add((other_length - own_length) / mean, (length_ - own_length) / mean);
            if (own_length > k_origin && other_length > k_origin) {
                constexpr double k_angle_weight = 2;  // Johansen's
                const double angle = angle_between(own, other);
                add(k_angle_weight * angle, k_angle_weight * angle_to_point(own, angle));
            }
        }
        for (int k = polar_ ? 2 : 0; k < d_; ++k) add(other[k] - own[k], p_[k] - own[k]);
        return square > 0 ? along / square : 0;
    }

    static double angle_between(const ScaledPoint& a, const ScaledPoint& b) noexcept {
        return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    }

    /// Angle from `own` to the point for a pair that is `angle` apart. Going once round from `own` over `other`, it
    /// grows up to `angle` and on; in the middle third of what is then left it falls back to below 0, so that it comes
    /// home as 0. Near the origin it fades to half the angle, which favours neither.
    double angle_to_point(const ScaledPoint& own, double angle) const noexcept {
        const double side = angle < 0 ? -1 : 1, apart = side * angle, third = (2 * k_pi - apart) / 3;
        double turned = length_ > 0 ? side * angle_between(own, p_) : 0;
        if (turned < 0) turned += 2 * k_pi;
        const double past = turned - apart - third;  // into the middle third
        if (apart > k_pi - k_opposite)
            turned = std::min(turned, 2 * k_pi - turned);  // straight across: either way round is the shorter one
        else if (past > third)
            turned -= 2 * k_pi;
        else if (past > 0)
            turned = apart + third - past / third * (apart + 2 * third);
        return side * (0.5 * apart + sense_of_direction_ * (turned - 0.5 * apart));
    }

    const BlendSpace& space_;
    int d_;
    bool polar_ = false;
    ScaledPoint scale_{}, p_{};
    double length_ = 0;              // of the point's first two axes
    double sense_of_direction_ = 1;  // 0 at the origin, 1 from half the length of the shortest sample on
};

double distance_to(const BlendSpace& space, const Lookup& lookup, const ScaledPoint& p, std::int32_t i) noexcept {
    double least = 1e300;
    const auto count = static_cast<std::int32_t>(space.samples.size());
    for (std::int32_t s = i; s < (space.copy_of.empty() ? i + 1 : count); ++s) {
        if (space.original(s) != i) continue;
        const ScaledPoint at = lookup.sample(s);
        double square = 0;
        for (int k = 0; k < lookup.dimensions(); ++k) square += (p[k] - at[k]) * (p[k] - at[k]);
        least = std::min(least, square);
    }
    return std::sqrt(least);
}

}  // namespace

void gradient_band_weights(const BlendSpace& space, const SpacePoint& point, BlendWeights& result) noexcept {
    const Bands bands(space, point);
    const auto count = static_cast<std::int32_t>(space.samples.size());
    Top<k_max_blend_weights + 1> top;
    for (std::int32_t i = 0; i < count; ++i) {
        if (!counts(space, i)) continue;
        double influence = 0;
        for (std::int32_t s = i; s < (space.copy_of.empty() ? i + 1 : count); ++s)
            if (space.original(s) == i) influence += bands.influence(s);
        if (influence > 0) top.offer(i, influence);
    }
    if (top.count > k_max_blend_weights) {
        const double goes = top.key[--top.count];
        // All alike: there is no heaviest. Else the lightened ones are continuous in the point.
        if (top.key[0] > goes)
            for (int n = 0; n < top.count; ++n) top.key[n] -= goes;
    }
    if (top.count == 0) return axis_distance_weights(space, point, result);  // each outdone by another, in a ring
    give(top.key.data(), top.sample.data(), top.count, result);
}

void axis_distance_weights(const BlendSpace& space, const SpacePoint& point, BlendWeights& result) noexcept {
    constexpr int k_most = 8;
    const Lookup lookup(space);
    const ScaledPoint p = lookup.scaled(point);
    Top<k_most + 1> nearest;  // by negative distance
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(space.samples.size()); ++i)
        if (counts(space, i)) nearest.offer(i, -distance_to(space, lookup, p, i));
    const int wanted = space.dimensions() == 1 ? 2 : k_most;
    const bool bounded = nearest.count > wanted;
    const double reach = bounded ? -nearest.key[wanted] : 0;
    const int count = std::min(nearest.count, wanted);
    // Relative to the nearest one's, ((R - d) / (R d))^2 stays finite.
    const double first = -nearest.key[0];
    const double first_gap = bounded ? reach - first : 1;
    double weights[k_most] = {1};
    for (int n = 1; n < count; ++n) {
        const double own = -nearest.key[n], gap = bounded ? reach - own : 1;
        const double ratio = own > 0 && first_gap > 0 ? first / own * (gap / first_gap) : 0;
        weights[n] = ratio * ratio;
    }
    give(weights, nearest.sample.data(), count, result);
}

}  // namespace surefoot
