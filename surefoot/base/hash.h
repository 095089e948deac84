#pragma once
// Hashing that is the same on every machine: determinism checks and cache keys rest on it.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace surefoot {

/// 64-bit FNV-1a over bytes, continuing from `seed`. Not for untrusted keys of hash tables.
constexpr std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t seed = 0xcbf29ce484222325ull) noexcept {
    for (const char c : bytes) seed = (seed ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return seed;
}

template <typename T>
std::uint64_t hash_span(std::span<const T> values, std::uint64_t seed = 0xcbf29ce484222325ull) noexcept {
    return hash_bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()}, seed);
}

}  // namespace surefoot
