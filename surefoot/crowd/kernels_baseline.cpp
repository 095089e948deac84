#include <surefoot/crowd/kernels_impl.h>
#include <surefoot/math/processor.h>

namespace surefoot {

const GroundKernels k_scalar_ground_kernels = ground_kernels_named<Scalar>("scalar");
const GroundKernels k_baseline_ground_kernels = ground_kernels_named<Vector>("baseline");

const GroundKernels& ground_kernels() noexcept {
#if defined(SUREFOOT_HAS_KERNELS_X86_64)
    static const GroundKernels* const of_level[] = {&k_baseline_ground_kernels, &k_v3_ground_kernels,
                                                    &k_v4_ground_kernels};
    static const GroundKernels& fastest = *of_level[static_cast<int>(processor_level())];
    return fastest;
#else
    return k_baseline_ground_kernels;
#endif
}

}  // namespace surefoot
