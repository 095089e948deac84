#pragma once
// A small seeded generator with the same stream on every machine (std distributions differ between libraries).

#include <cstdint>

namespace surefoot {

/// PCG32 (M. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms", 2014).
class Random {
  public:
    explicit Random(std::uint64_t seed) noexcept : state_(seed + k_increment) { next(); }

    std::uint32_t next() noexcept {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ull + k_increment;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
        const auto turn = static_cast<std::uint32_t>(old >> 59u);
        return (shifted >> turn) | (shifted << ((32u - turn) & 31u));
    }
    /// Uniform in [0, 1).
    float unit() noexcept { return static_cast<float>(next() >> 8) * (1.0f / 16777216.0f); }
    /// Uniform in [low, high).
    float between(float low, float high) noexcept { return low + (high - low) * unit(); }
    /// Uniform in [0, count); `count` > 0.
    std::uint32_t below(std::uint32_t count) noexcept {
        return static_cast<std::uint32_t>((static_cast<std::uint64_t>(next()) * count) >> 32u);
    }

  private:
    static constexpr std::uint64_t k_increment = 1442695040888963407ull;
    std::uint64_t state_;
};

}  // namespace surefoot
