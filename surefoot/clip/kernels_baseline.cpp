#include <surefoot/clip/kernels_impl.h>
#include <surefoot/math/processor.h>

namespace surefoot {

const ClipKernels k_scalar_kernels{"scalar", blend_rotations<Scalar>, add_turns<Scalar>, local_to_model<Scalar>};
const ClipKernels k_baseline_kernels{"baseline", blend_rotations<Vector>, add_turns<Vector>, local_to_model<Vector>};

const ClipKernels& clip_kernels() noexcept {
#if defined(SUREFOOT_HAS_KERNELS_X86_64)
    static const ClipKernels* const of_level[] = {&k_baseline_kernels, &k_v3_kernels, &k_v4_kernels};
    static const ClipKernels& fastest = *of_level[static_cast<int>(processor_level())];
    return fastest;
#else
    return k_baseline_kernels;
#endif
}

}  // namespace surefoot
