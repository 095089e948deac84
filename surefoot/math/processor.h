#pragma once
// Which of the kernels' builds this machine runs, by the levels of x86-64 that its psABI defines.

namespace surefoot {

enum class ProcessorLevel { baseline, v3, v4 };  ///< what the target has at least; AVX2; AVX-512 (F, BW, CD, DQ, VL)

ProcessorLevel processor_level() noexcept;

}  // namespace surefoot
