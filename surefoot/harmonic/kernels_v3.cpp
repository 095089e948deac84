// The same kernels for x86-64-v3 (AVX2). Compiled with -march=x86-64-v3, in a namespace of its own; without the scalar
// twin, so that no function of the standard library is compiled here for a machine that may not have AVX2.
#define SUREFOOT_KERNELS kernels_v3
#include <surefoot/harmonic/kernels_impl.h>

namespace surefoot {

template <>
const HarmonicKernels KernelBuilds<HarmonicKernels>::v3 = kernels_named<Vector>("x86-64-v3");

}  // namespace surefoot
