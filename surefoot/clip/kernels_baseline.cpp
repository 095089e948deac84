#include <surefoot/clip/kernels_impl.h>

namespace surefoot {

template <>
const ClipKernels KernelBuilds<ClipKernels>::scalar = kernels_named<Scalar>("scalar");
template <>
const ClipKernels KernelBuilds<ClipKernels>::baseline = kernels_named<Vector>("baseline");

}  // namespace surefoot
