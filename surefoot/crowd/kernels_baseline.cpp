#include <surefoot/crowd/kernels_impl.h>

namespace surefoot {

template <>
const GroundKernels KernelBuilds<GroundKernels>::scalar = kernels_named<Scalar>("scalar");
template <>
const GroundKernels KernelBuilds<GroundKernels>::baseline = kernels_named<Vector>("baseline");

}  // namespace surefoot
