#pragma once
// The kernels of this room, as raw as they are (clip/kernels.h says why). Private to harmonic/; the public face is
// harmonic_lanes.h. Eight lanes are eight joints, eight phases or eight series; every kernel has a scalar twin with the
// same bits.

#include <surefoot/math/kernel_builds.h>

#include <cstddef>
#include <cstdint>

namespace surefoot {

struct HarmonicKernels {
    const char* name;
    /// values[i] = sum over terms of weights[t] * coefficients[t * count + i]; count is a multiple of 8, terms at
    /// least 1.
    void (*weigh)(const float* coefficients, const float* weights, int terms, std::size_t count, float* values);
    /// Eight phases [cycles, 0 to 1] at once: waves[i * 8 + phase] = 1, cos 2 pi p, sin 2 pi p, cos 4 pi p, …: 1 + 2 *
    /// harmonics rows.
    void (*waves)(const float* phases, int harmonics, float* waves);
    /// Sums of eight series whose numbers lie side by side: out[lane] = sum over i of wave[i * stride] * numbers[i * 8
    /// + lane], `length` of them.
    void (*sum_series)(const float* numbers, const float* wave, std::size_t stride, int length, float* out);
    /// Eight joints: the rotation vectors of three blocks of series (x, y, z) applied after their means (x8 y8 z8 w8);
    /// the rotation of lane l goes to out + index[l] * 7, where index[l] >= 0.
    void (*rotate_joints)(const float* numbers, const float* wave, std::size_t stride, int length, const float* mean,
                          const std::int16_t* index, float* out);
};

SUREFOOT_DECLARE_KERNELS(HarmonicKernels);

}  // namespace surefoot
