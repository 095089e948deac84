#pragma once
// The kernels' one text, instantiated for each instruction set and for the scalar twin (kernels_*.cpp).

#include <surefoot/harmonic/kernels.h>
#include <surefoot/math/lanes.h>

namespace surefoot {
inline namespace SUREFOOT_KERNELS {

template <class T>
void weigh(const float* coefficients, const float* weights, int terms, std::size_t count, float* values) {
    using F = Float8<T>;
    for (std::size_t i = 0; i < count; i += 8) {
        const float* from = coefficients + i;
        F sum = F::splat(weights[0]) * F::load(from);
        for (int t = 1; t < terms; ++t)
            sum += F::splat(weights[t]) * F::load(from + static_cast<std::size_t>(t) * count);
        sum.store(values + i);
    }
}

template <class T>
void waves(const float* phases, int harmonics, float* waves) {
    using F = Float8<T>;
    F sine, cosine;
    sincos(F::load(phases) * 6.28318531f, sine, cosine);
    F c = F::splat(1), s = F::splat(0);
    c.store(waves);
    for (int k = 0; k < harmonics; ++k) {
        const F next = c * cosine - s * sine;
        s = s * cosine + c * sine;
        c = next;
        c.store(waves + 16 * k + 8);
        s.store(waves + 16 * k + 16);
    }
}

template <class T>
SUREFOOT_INLINE Float8<T> series(const float* numbers, const float* wave, std::size_t stride, int length) noexcept {
    using F = Float8<T>;
    F sum = F::splat(0);
    for (int i = 0; i < length; ++i)
        sum += F::splat(wave[static_cast<std::size_t>(i) * stride]) * F::load(numbers + i * 8);
    return sum;
}

template <class T>
void sum_series(const float* numbers, const float* wave, std::size_t stride, int length, float* out) {
    series<T>(numbers, wave, stride, length).store(out);
}

template <class T>
void rotate_joints(const float* numbers, const float* wave, std::size_t stride, int length, const float* mean,
                   const std::int16_t* index, float* out) {
    using F = Float8<T>;
    const F x = series<T>(numbers, wave, stride, length);
    const F y = series<T>(numbers + length * 8, wave, stride, length);
    const F z = series<T>(numbers + length * 16, wave, stride, length);
    // exp of half the rotation vector: (v sin(a / 2) / a, cos(a / 2)); for tiny angles sin(a / 2) / a is a half.
    const F angle = sqrt(x * x + y * y + z * z);
    F sine, cosine;
    sincos(angle * 0.5f, sine, cosine);
    const Mask8<T> tiny = angle < F::splat(1e-6f);
    const F scale = select(tiny, F::splat(0.5f), sine / select(tiny, F::splat(1), angle));
    const F bx = x * scale, by = y * scale, bz = z * scale, bw = cosine;
    const F ax = F::load(mean), ay = F::load(mean + 8), az = F::load(mean + 16), aw = F::load(mean + 24);
    F q[4] = {aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
              aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz};
    const F unit = rsqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const F zero = F::splat(0);
    F rows[8] = {q[0] * unit, q[1] * unit, q[2] * unit, q[3] * unit, zero, zero, zero, zero};
    transpose(rows);
    for (int lane = 0; lane < 8; ++lane)
        if (index[lane] >= 0) rows[lane].store4(out + index[lane] * 7);
}

template <class T>
constexpr HarmonicKernels kernels_named(const char* name) {
    return {name, weigh<T>, waves<T>, sum_series<T>, rotate_joints<T>};
}

}  // namespace SUREFOOT_KERNELS
}  // namespace surefoot
