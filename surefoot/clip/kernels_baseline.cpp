#include <surefoot/clip/kernels_impl.h>

namespace surefoot {

const ClipKernels k_scalar_kernels{"scalar", blend_rotations<Scalar>, local_to_model<Scalar>};
const ClipKernels k_baseline_kernels{"baseline", blend_rotations<Vector>, local_to_model<Vector>};

}  // namespace surefoot
