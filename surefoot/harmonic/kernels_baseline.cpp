#include <surefoot/harmonic/kernels_impl.h>
#include <surefoot/math/processor.h>

namespace surefoot {

const HarmonicKernels k_scalar_harmonic_kernels = kernels_named<Scalar>("scalar");
const HarmonicKernels k_baseline_harmonic_kernels = kernels_named<Vector>("baseline");

const HarmonicKernels& harmonic_kernels() noexcept {
#if defined(SUREFOOT_HAS_KERNELS_X86_64)
    static const HarmonicKernels* const of_level[] = {&k_baseline_harmonic_kernels, &k_v3_harmonic_kernels,
                                                      &k_v4_harmonic_kernels};
    static const HarmonicKernels& fastest = *of_level[static_cast<int>(processor_level())];
    return fastest;
#else
    return k_baseline_harmonic_kernels;
#endif
}

}  // namespace surefoot
