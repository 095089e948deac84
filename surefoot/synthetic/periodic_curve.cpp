#include <surefoot/synthetic/periodic_curve.h>

#include <cassert>
#include <cmath>

namespace surefoot {

namespace {

/// Slope at a key between intervals of widths h and secants d, equation (5) of Fritsch & Butland: a weighted harmonic
/// mean, zero at extrema.
float monotone_slope(float h_before, float d_before, float h_after, float d_after) {
    if (!(d_before * d_after > 0)) return 0;
    const float a = (h_before + 2 * h_after) / (3 * (h_before + h_after));
    return d_before * d_after / (a * d_after + (1 - a) * d_before);
}

}  // namespace

PeriodicCurve::PeriodicCurve(std::vector<Key> keys) : keys_(std::move(keys)) {
    const std::size_t n = keys_.size();
    slopes_.assign(n, 0.0f);
    if (n < 2) return;
    const auto width = [&](std::size_t i) {
        const float next = i + 1 < n ? keys_[i + 1].phase : keys_[0].phase + 1;
        assert(next > keys_[i].phase);
        return next - keys_[i].phase;
    };
    const auto secant = [&](std::size_t i) { return (keys_[(i + 1) % n].value - keys_[i].value) / width(i); };
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n;
        slopes_[i] = monotone_slope(width(before), secant(before), width(i), secant(i));
    }
}

float PeriodicCurve::operator()(float phase) const noexcept {
    const std::size_t n = keys_.size();
    if (n == 0) return 0;
    phase -= std::floor(phase);
    if (phase < keys_[0].phase) phase += 1;
    std::size_t i = n - 1;
    while (i > 0 && keys_[i].phase > phase) --i;
    const std::size_t next = (i + 1) % n;
    const float width = (next > i ? keys_[next].phase : keys_[next].phase + 1) - keys_[i].phase;
    const float t = (phase - keys_[i].phase) / width, u = 1 - t;
    return keys_[i].value * u * u * (1 + 2 * t) + keys_[next].value * t * t * (3 - 2 * t) +
           width * t * u * (slopes_[i] * u - slopes_[next] * t);
}

}  // namespace surefoot
