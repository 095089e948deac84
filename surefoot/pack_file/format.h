#pragma once
// The frame of a pack: header, tables, definitions. docs/packs.md says the same for others. Private to the room.
//
//     0    header, 64 bytes
//     64   tables of keyframes, each from a multiple of 64 bytes on
//     …    definitions: the fields of a Pack in the order of fields.h
//     …    zeros up to a multiple of 64
//
// All numbers are little-endian. In the definitions a number takes its own size, unaligned; a bool or an enumeration a
// byte; a text or a list its count (u32) before it; an alternative its index (u8). What is shared (skeletons, fitted
// gaits) is written where it comes first, as the number (u32) of those before it plus one; later, that number alone; 0
// is none. A table is its offset (u64) and count (u64).

#include <surefoot/base/hash.h>
#include <surefoot/pack_file/pack.h>

#include <array>
#include <bit>
#include <cstring>

namespace surefoot {

static_assert(std::endian::native == std::endian::little,
              "packs are little-endian and are read where they lie: big-endian machines need a copy");

/// A number that editors and transfers in text mode would damage, as PNG's is.
inline constexpr std::array<unsigned char, 8> k_pack_magic{0x8a, 'S', 'F', 'P', 'K', '\r', '\n', 0x1a};

struct PackHeader {
    std::array<unsigned char, 8> magic = k_pack_magic;
    std::uint32_t version = k_pack_version;
    std::uint32_t reserved = 0;
    std::uint64_t size = 0;              ///< [bytes] of the whole
    std::uint64_t checksum = 0;          ///< of all bytes from `definitions` on
    std::uint64_t definitions = 0;       ///< [bytes] where they begin
    std::uint64_t definitions_size = 0;  ///< [bytes]
    std::array<std::uint64_t, 2> zero{};
};
static_assert(sizeof(PackHeader) == 64 && std::is_trivially_copyable_v<PackHeader>);
inline constexpr std::size_t k_checksum_from = offsetof(PackHeader, definitions);

/// FNV-1a over words of eight bytes (a whole number of them): a damaged file is noticed, an attacker is not kept out.
inline std::uint64_t pack_checksum(std::span<const std::byte> bytes) noexcept {
    std::uint64_t sum = 0xcbf29ce484222325ull;
    for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
        std::uint64_t word;
        std::memcpy(&word, bytes.data() + i, 8);
        sum = (sum ^ word) * 0x100000001b3ull;
        sum ^= sum >> 29;  // lets high bits reach the low ones, which a product alone does not
    }
    return sum;
}

constexpr std::size_t aligned_to_64(std::size_t size) noexcept {
    return (size + k_pack_alignment - 1) / k_pack_alignment * k_pack_alignment;
}

/// Makes what is made from definitions; false, with a sentence, where they are not sound.
bool rebuild(Pack& pack, std::string& problem);

}  // namespace surefoot
