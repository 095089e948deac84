// The same kernels for x86-64-v4 (AVX-512). Compiled with -march=x86-64-v4, in a namespace of its own; without the
// scalar twin, so that no function of the standard library is compiled here for a machine that may not have AVX-512.
#define SUREFOOT_KERNELS kernels_v4
#include <surefoot/clip/kernels_impl.h>

namespace surefoot {

const ClipKernels k_v4_kernels{"x86-64-v4", blend_rotations<Vector>, add_turns<Vector>, local_to_model<Vector>};

}  // namespace surefoot
