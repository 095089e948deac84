#include <surefoot/ik/swing_hump.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr int k_controls = k_hump_free + 4;
constexpr double k_end_weight = 3;    // bends at lift and strike hurt the knee most
constexpr double k_softness = 2e-4;   // of the mean response: constraints at the very ends give rather than explode
constexpr double k_tolerance = 2e-5;  // [m] a violation smaller than this is left alone
constexpr int k_rounds = 400;

using Controls = std::array<double, k_controls>;

/// Control points from start value, start slope (per unit of s) and the free coefficients. Value and slope of a uniform
/// cubic B-spline at a knot are (c0 + 4 c1 + c2) / 6 and (c2 - c0) / 2 per span; at the end both are zero.
template <typename Free>
Controls controls(double value, double slope, const Free& free) noexcept {
    Controls c{};
    for (int i = 0; i < k_hump_free; ++i) c[static_cast<std::size_t>(i + 2)] = free[static_cast<std::size_t>(i)];
    const double span_slope = slope / k_hump_spans;
    c[0] = c[2] - 2 * span_slope;
    c[1] = (6 * value - c[0] - c[2]) / 4;
    c[k_controls - 1] = c[k_controls - 3];
    c[k_controls - 2] = -0.5 * c[k_controls - 3];
    return c;
}

struct Place {
    int span;
    double t;
};
Place locate(double s) noexcept {
    const double x = std::clamp(s, 0.0, 1.0) * k_hump_spans;
    const int span = std::min(static_cast<int>(x), k_hump_spans - 1);
    return {span, x - span};
}

double spline(const Controls& c, double s) noexcept {
    const Place place = locate(s);
    const double t = place.t;
    const auto at = [&](int k) { return c[static_cast<std::size_t>(place.span + k)]; };
    const double r = 1 - t;
    return (r * r * r * at(0) + (3 * t * t * t - 6 * t * t + 4) * at(1) +
            (-3 * t * t * t + 3 * t * t + 3 * t + 1) * at(2) + t * t * t * at(3)) /
           6;
}

double spline_slope(const Controls& c, double s) noexcept {
    const Place place = locate(s);
    const double t = place.t;
    const auto at = [&](int k) { return c[static_cast<std::size_t>(place.span + k)]; };
    const double r = 1 - t;
    return (-r * r * at(0) + (3 * t * t - 4 * t) * at(1) + (-3 * t * t + 2 * t + 1) * at(2) + t * t * at(3)) / 2 *
           k_hump_spans;
}

double share(int sample) noexcept { return static_cast<double>(sample) / (k_hump_samples - 1); }

/// Solves M x = b for several right-hand sides by Cholesky; M is symmetric positive definite.
struct Cholesky {
    double l[k_hump_free][k_hump_free] = {};
    explicit Cholesky(const double (&m)[k_hump_free][k_hump_free]) noexcept {
        for (int i = 0; i < k_hump_free; ++i)
            for (int j = 0; j <= i; ++j) {
                double sum = m[i][j];
                for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
                l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
            }
    }
    void solve(std::array<double, k_hump_free>& x) const noexcept {
        for (int i = 0; i < k_hump_free; ++i) {
            double sum = x[static_cast<std::size_t>(i)];
            for (int k = 0; k < i; ++k) sum -= l[i][k] * x[static_cast<std::size_t>(k)];
            x[static_cast<std::size_t>(i)] = sum / l[i][i];
        }
        for (int i = k_hump_free - 1; i >= 0; --i) {
            double sum = x[static_cast<std::size_t>(i)];
            for (int k = i + 1; k < k_hump_free; ++k) sum -= l[k][i] * x[static_cast<std::size_t>(k)];
            x[static_cast<std::size_t>(i)] = sum / l[i][i];
        }
    }
};

/// Second difference about each sample of a function known at the samples; before the start it goes on straight, after
/// the end it is zero.
template <typename At>
double bend(const At& at, double start_slope, int sample) noexcept {
    const double before = sample > 0 ? at(sample - 1) : at(0) - start_slope / (k_hump_samples - 1);
    const double after = sample + 1 < k_hump_samples ? at(sample + 1) : 0.0;
    return before - 2 * at(sample) + after;
}

}  // namespace

float Hump::at(float s) const noexcept {
    if (s >= 1) return 0;
    return static_cast<float>(
        spline(controls(static_cast<double>(start_value), static_cast<double>(start_slope), coefficients),
               static_cast<double>(s)));
}

std::array<float, k_hump_samples> Hump::at_samples() const noexcept {
    const Controls c = controls(static_cast<double>(start_value), static_cast<double>(start_slope), coefficients);
    std::array<float, k_hump_samples> values{};  // the last one is 0
    for (int i = 0; i + 1 < k_hump_samples; ++i)
        values[static_cast<std::size_t>(i)] = static_cast<float>(
            spline(c, static_cast<double>(static_cast<float>(i) / static_cast<float>(k_hump_samples - 1))));
    return values;
}

float Hump::slope(float s) const noexcept {
    if (s >= 1) return 0;
    return static_cast<float>(
        spline_slope(controls(static_cast<double>(start_value), static_cast<double>(start_slope), coefficients),
                     static_cast<double>(s)));
}

SwingSolver::SwingSolver() {
    const Row none{};
    std::array<Row, k_hump_samples> bends;
    for (int k = 0; k < k_hump_free; ++k) {
        Row unit{};
        unit[static_cast<std::size_t>(k)] = 1;
        const Controls c = controls(0, 0, unit);
        for (int i = 0; i < k_hump_samples; ++i) {
            basis_[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = spline(c, share(i));
            bends[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
                bend([&](int j) { return spline(c, share(j)); }, 0, i);
        }
    }
    const Controls by_value = controls(1, 0, none), by_slope = controls(0, 1, none);
    for (int i = 0; i < k_hump_samples; ++i) {
        const auto n = static_cast<std::size_t>(i);
        from_value_[n] = spline(by_value, share(i));
        from_slope_[n] = spline(by_slope, share(i));
        bend_value_[n] = bend([&](int j) { return spline(by_value, share(j)); }, 0, i);
        bend_slope_[n] = bend([&](int j) { return spline(by_slope, share(j)); }, 1, i);
        weight_[n] = i < 2 || i > k_hump_samples - 3 ? k_end_weight : 1.0;
    }
    double q[k_hump_free][k_hump_free] = {};
    for (std::size_t i = 0; i < k_hump_samples; ++i)
        for (std::size_t a = 0; a < k_hump_free; ++a)
            for (std::size_t b = 0; b < k_hump_free; ++b) q[a][b] += weight_[i] * bends[i][a] * bends[i][b];
    const Cholesky factor(q);
    for (std::size_t i = 0; i < k_hump_samples; ++i) {
        for (std::size_t k = 0; k < k_hump_free; ++k) {
            to_free_[i][k] = -weight_[i] * bends[i][k];
            response_[i][k] = basis_[i][k];
        }
        factor.solve(to_free_[i]);
        factor.solve(response_[i]);
    }
    double total = 0;
    for (std::size_t i = 0; i < k_hump_samples; ++i)
        for (std::size_t j = 0; j < k_hump_samples; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k < k_hump_free; ++k) sum += basis_[i][k] * response_[j][k];
            gram_[i][j] = sum;
            if (i == j) total += sum;
        }
    softness_ = k_softness * total / k_hump_samples;
}

Hump SwingSolver::solve(const HumpTask& task) const noexcept {
    const double value = static_cast<double>(task.start_value), slope = static_cast<double>(task.start_slope);
    // Without constraints: the least bent sum of base and hump.
    Row free{};
    for (std::size_t i = 0; i < k_hump_samples; ++i) {
        const double base = static_cast<double>(task.base[i]) - 2 * static_cast<double>(task.base[i + 1]) +
                            static_cast<double>(task.base[i + 2]);
        const double bends = base + value * bend_value_[i] + slope * bend_slope_[i];
        for (std::size_t k = 0; k < k_hump_free; ++k) free[k] += to_free_[i][k] * bends;
    }
    // How far each sample is below what it needs; then Hildreth's dual ascent, one multiplier at a time.
    std::array<double, k_hump_samples> lacking, multiplier{};
    for (std::size_t i = 0; i < k_hump_samples; ++i) {
        double height = static_cast<double>(task.base[i + 1]) + value * from_value_[i] + slope * from_slope_[i];
        for (std::size_t k = 0; k < k_hump_free; ++k) height += basis_[i][k] * free[k];
        lacking[i] = static_cast<double>(task.need[i]) - height;
    }
    for (int round = 0; round < k_rounds; ++round) {
        double moved = 0;
        for (std::size_t i = 1; i + 1 < k_hump_samples; ++i) {  // the ends are given
            const double violation = lacking[i] - softness_ * multiplier[i];
            if (violation < k_tolerance && multiplier[i] <= 0) continue;
            const double next = std::max(0.0, multiplier[i] + violation / (gram_[i][i] + softness_));
            const double step = next - multiplier[i];
            if (step == 0) continue;
            multiplier[i] = next;
            for (std::size_t j = 0; j < k_hump_samples; ++j) lacking[j] -= gram_[i][j] * step;
            moved = std::max(moved, std::fabs(step) * gram_[i][i]);
        }
        if (moved < k_tolerance) break;
    }
    for (std::size_t i = 0; i < k_hump_samples; ++i)
        for (std::size_t k = 0; k < k_hump_free; ++k) free[k] += response_[i][k] * multiplier[i];
    Hump hump;
    hump.start_value = task.start_value;
    hump.start_slope = task.start_slope;
    for (std::size_t k = 0; k < k_hump_free; ++k) hump.coefficients[k] = static_cast<float>(free[k]);
    return hump;
}

}  // namespace surefoot
