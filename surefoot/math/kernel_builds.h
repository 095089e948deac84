#pragma once
// The builds of a room's kernels, and which of them this machine runs. Kernels are a struct of functions with a name,
// one text over a tag (lanes.h), built once for each instruction set (surefoot_kernels in cmake/): a room declares its
// builds by SUREFOOT_DECLARE_KERNELS(Kernels) and defines them in kernels_baseline.cpp, kernels_v3.cpp, kernels_v4.cpp.

#include <surefoot/math/processor.h>

#include <cstddef>
#include <span>

namespace surefoot {

template <class Kernels>
struct KernelBuilds {
    static const Kernels scalar;    ///< the twin that the others are held against, bit by bit
    static const Kernels baseline;  ///< what every machine of the build's target runs
    static const Kernels v3;        ///< x86-64 with AVX2; where SUREFOOT_HAS_KERNELS_X86_64
    static const Kernels v4;        ///< and with AVX-512 (F, BW, CD, DQ, VL); likewise

    /// Those that this machine runs beside the scalar twin, the fastest last.
    static std::span<const Kernels* const> here() noexcept {
#if defined(SUREFOOT_HAS_KERNELS_X86_64)
        static constexpr const Kernels* by_level[] = {&baseline, &v3, &v4};
        return {by_level, static_cast<std::size_t>(processor_level()) + 1};
#else
        static constexpr const Kernels* by_level[] = {&baseline};
        return by_level;
#endif
    }
    /// Chosen once.
    static const Kernels& fastest() noexcept {
        static const Kernels& chosen = *here().back();
        return chosen;
    }
};

}  // namespace surefoot

/// In namespace surefoot, after the struct.
#define SUREFOOT_DECLARE_KERNELS(Kernels)          \
    template <>                                    \
    const Kernels KernelBuilds<Kernels>::scalar;   \
    template <>                                    \
    const Kernels KernelBuilds<Kernels>::baseline; \
    template <>                                    \
    const Kernels KernelBuilds<Kernels>::v3;       \
    template <>                                    \
    const Kernels KernelBuilds<Kernels>::v4
