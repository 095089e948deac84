#include <surefoot/harmonic/kernels_impl.h>

namespace surefoot {

const HarmonicKernels k_scalar_harmonic_kernels = kernels_named<Scalar>("scalar");
const HarmonicKernels k_baseline_harmonic_kernels = kernels_named<Vector>("baseline");

const HarmonicKernels& harmonic_kernels() noexcept {
#if defined(SUREFOOT_HAS_KERNELS_V3)
    static const HarmonicKernels& fastest =
        __builtin_cpu_supports("avx2") ? k_v3_harmonic_kernels : k_baseline_harmonic_kernels;
    return fastest;
#else
    return k_baseline_harmonic_kernels;
#endif
}

}  // namespace surefoot
