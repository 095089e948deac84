#include <surefoot/clip/kernels_impl.h>

namespace surefoot {

const ClipKernels k_scalar_kernels{"scalar", blend_rotations<Scalar>, local_to_model<Scalar>};
const ClipKernels k_baseline_kernels{"baseline", blend_rotations<Vector>, local_to_model<Vector>};

const ClipKernels& clip_kernels() noexcept {
#if defined(SUREFOOT_HAS_KERNELS_V3)
    static const ClipKernels& fastest = __builtin_cpu_supports("avx2") ? k_v3_kernels : k_baseline_kernels;
    return fastest;
#else
    return k_baseline_kernels;
#endif
}

}  // namespace surefoot
