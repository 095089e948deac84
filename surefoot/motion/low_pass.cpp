#include <surefoot/motion/low_pass.h>

#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {

namespace {

constexpr double k_window = 3.0;  // the kernel is cut at 3 sigma, where it has fallen to 1 %

std::vector<double> gaussian(double sigma) {
    const int reach = static_cast<int>(std::floor(k_window * sigma));
    std::vector<double> kernel(static_cast<std::size_t>(reach) + 1, 1.0);
    for (int k = 1; k <= reach; ++k) kernel[static_cast<std::size_t>(k)] = exp(-0.5 * k * k / (sigma * sigma));
    return kernel;
}

}  // namespace

std::vector<double> low_pass(const std::vector<double>& signal, double sigma) {
    const std::vector<double> kernel = gaussian(sigma);
    const int count = static_cast<int>(signal.size()), reach = static_cast<int>(kernel.size()) - 1;
    std::vector<double> result(signal.size());
    for (int i = 0; i < count; ++i) {
        // Weighted moments of offsets k and values v: the line's value at k = 0 is (m2 v0 - m1 v1) / (m0 m2 - m1^2).
        double m0 = 0, m1 = 0, m2 = 0, v0 = 0, v1 = 0;
        for (int k = std::max(-reach, -i); k <= std::min(reach, count - 1 - i); ++k) {
            const double w = kernel[static_cast<std::size_t>(std::abs(k))];
            const double v = signal[static_cast<std::size_t>(i + k)];
            m0 += w, m1 += w * k, m2 += w * k * k, v0 += w * v, v1 += w * k * v;
        }
        const double determinant = m0 * m2 - m1 * m1;
        result[static_cast<std::size_t>(i)] =
            determinant > 1e-12 * m0 * m0 ? (m2 * v0 - m1 * v1) / determinant : v0 / m0;
    }
    return result;
}

std::vector<double> low_pass_periodic(const std::vector<double>& signal, int period, double jump, double sigma) {
    const std::vector<double> kernel = gaussian(sigma);
    const int count = static_cast<int>(signal.size()), reach = static_cast<int>(kernel.size()) - 1;
    // Without its trend the signal is periodic, and the trend passes a symmetric kernel unchanged.
    const auto periodic = [&](int i) {
        const int wrapped = ((i % period) + period) % period;
        return signal[static_cast<std::size_t>(wrapped)] - jump * wrapped / period;
    };
    std::vector<double> result(signal.size());
    for (int i = 0; i < count; ++i) {
        double weight = 0, sum = 0;
        for (int k = -reach; k <= reach; ++k) {
            const double w = kernel[static_cast<std::size_t>(std::abs(k))];
            weight += w;
            sum += w * periodic(i + k);
        }
        result[static_cast<std::size_t>(i)] = sum / weight + jump * i / period;
    }
    return result;
}

}  // namespace surefoot
