// The same kernels for x86-64-v4 (AVX-512). Compiled with -march=x86-64-v4, in a namespace of its own; without the
// scalar twin, so that no function of the standard library is compiled here for a machine that may not have AVX-512.
#define SUREFOOT_KERNELS kernels_v4
#include <surefoot/graph/kernels_impl.h>

namespace surefoot {

template <>
const FootKernels KernelBuilds<FootKernels>::v4 = kernels_named<Vector>("x86-64-v4");

}  // namespace surefoot
