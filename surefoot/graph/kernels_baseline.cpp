#include <surefoot/graph/kernels_impl.h>
#include <surefoot/math/processor.h>

namespace surefoot {

const FootKernels k_scalar_foot_kernels = foot_kernels_named<Scalar>("scalar");
const FootKernels k_baseline_foot_kernels = foot_kernels_named<Vector>("baseline");

const FootKernels& foot_kernels() noexcept {
#if defined(SUREFOOT_HAS_KERNELS_X86_64)
    static const FootKernels* const of_level[] = {&k_baseline_foot_kernels, &k_v3_foot_kernels, &k_v4_foot_kernels};
    static const FootKernels& fastest = *of_level[static_cast<int>(processor_level())];
    return fastest;
#else
    return k_baseline_foot_kernels;
#endif
}

}  // namespace surefoot
