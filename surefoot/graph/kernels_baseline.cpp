#include <surefoot/graph/kernels_impl.h>

namespace surefoot {

template <>
const FootKernels KernelBuilds<FootKernels>::scalar = kernels_named<Scalar>("scalar");
template <>
const FootKernels KernelBuilds<FootKernels>::baseline = kernels_named<Vector>("baseline");

}  // namespace surefoot
