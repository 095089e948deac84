#include <surefoot/analysis/signal.h>
#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {
namespace {

/// Half a Gaussian kernel, weights of offsets 0, 1, 2 …, out to three sigma.
std::vector<float> half_kernel(float sigma) {
    std::vector<float> weights;
    const int reach = static_cast<int>(std::floor(3 * sigma)) + 1;
    float sum = 0;
    for (int k = 0; k <= reach; ++k) {
        const float d = static_cast<float>(k) / sigma;
        weights.push_back(exp(-0.5f * d * d));
        sum += k == 0 ? weights.back() : 2 * weights.back();
    }
    for (float& w : weights) w /= sum;
    return weights;
}

/// Sample i of a track continued by point reflection at both ends.
template <typename T>
T continued(std::span<const T> x, long i) {
    const long last = static_cast<long>(x.size()) - 1;
    const auto at = [&](long k) { return x[static_cast<std::size_t>(std::clamp(k, 0L, last))]; };
    if (i < 0) return 2.0f * at(0) - at(-i);
    if (i > last) return 2.0f * at(last) - at(2 * last - i);
    return at(i);
}

template <typename T>
std::vector<T> smooth(std::span<const T> track, float sigma) {
    std::vector<T> result(track.begin(), track.end());
    if (sigma < 0.3f || track.size() < 2) return result;
    const std::vector<float> kernel = half_kernel(sigma);
    for (long i = 0; i < static_cast<long>(track.size()); ++i) {
        T sum = kernel[0] * track[static_cast<std::size_t>(i)];
        for (long k = 1; k < static_cast<long>(kernel.size()); ++k)
            sum = sum + kernel[static_cast<std::size_t>(k)] * (continued(track, i - k) + continued(track, i + k));
        result[static_cast<std::size_t>(i)] = sum;
    }
    return result;
}

template <typename T>
std::vector<T> differentiate(std::span<const T> track, float fps) {
    std::vector<T> result(track.size());
    if (track.size() < 2) return result;
    const std::size_t last = track.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
        const std::size_t a = i > 0 ? i - 1 : 0, b = i < last ? i + 1 : last;
        result[i] = (track[b] - track[a]) * (fps / static_cast<float>(b - a));
    }
    return result;
}

}  // namespace

std::vector<Vec3> smoothed(std::span<const Vec3> track, float sigma) { return smooth(track, sigma); }
std::vector<float> smoothed(std::span<const float> track, float sigma) { return smooth(track, sigma); }
std::vector<Vec3> derivative(std::span<const Vec3> track, float fps) { return differentiate(track, fps); }
std::vector<float> derivative(std::span<const float> track, float fps) { return differentiate(track, fps); }

float percentile(std::span<const float> values, float share) {
    if (values.empty()) return 0;
    std::vector<float> copy(values.begin(), values.end());
    const float rank = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(copy.size() - 1);
    const auto nth = copy.begin() + static_cast<std::ptrdiff_t>(rank + 0.5f);
    std::nth_element(copy.begin(), nth, copy.end());
    return *nth;
}

float densest(std::span<const float> values, float width) {
    if (values.empty()) return 0;
    std::vector<float> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    std::size_t best = 0, best_count = 0, first = 0;
    for (std::size_t end = 1; end <= sorted.size(); ++end) {
        while (sorted[end - 1] - sorted[first] > width) ++first;
        if (end - first > best_count) best = first, best_count = end - first;
    }
    return sorted[best + best_count / 2];
}

void unwrap_angles(std::span<float> radians) {
    for (std::size_t i = 1; i < radians.size(); ++i)
        radians[i] = radians[i - 1] + wrap_angle(radians[i] - radians[i - 1]);
}

}  // namespace surefoot
