#include <surefoot/math/processor.h>

namespace surefoot {

ProcessorLevel processor_level() noexcept {
#if defined(__x86_64__)
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
    if (!v3) return ProcessorLevel::baseline;
    const bool v4 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    return v4 ? ProcessorLevel::v4 : ProcessorLevel::v3;
#else
    return ProcessorLevel::baseline;
#endif
}

}  // namespace surefoot
