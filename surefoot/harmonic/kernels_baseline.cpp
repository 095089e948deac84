#include <surefoot/harmonic/kernels_impl.h>

namespace surefoot {

template <>
const HarmonicKernels KernelBuilds<HarmonicKernels>::scalar = kernels_named<Scalar>("scalar");
template <>
const HarmonicKernels KernelBuilds<HarmonicKernels>::baseline = kernels_named<Vector>("baseline");

}  // namespace surefoot
