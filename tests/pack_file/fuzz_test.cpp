// Packs that something has happened to. Whatever `open` lets through must play.

#include <surefoot/base/random.h>
#include <surefoot/pack_file/format.h>

#include "tests/pack_file/support.h"

namespace surefoot {
namespace {

/// With a checksum and a size that hold, so that they hide nothing.
void mend_header(std::vector<std::byte>& bytes) {
    if (bytes.size() < sizeof(PackHeader)) return;
    bytes.resize(aligned_to_64(bytes.size()));
    PackHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    header.size = bytes.size();
    header.checksum = pack_checksum(std::span(bytes).subspan(k_checksum_from));
    std::memcpy(bytes.data(), &header, sizeof header);
}

class PackFuzz : public testing::Test {
  protected:
    static const std::vector<std::byte>& bytes() {
        static const std::vector<std::byte> bytes = pack_bytes(test::small_pack());
        return bytes;
    }
    static PackHeader header() {
        PackHeader header;
        std::memcpy(&header, bytes().data(), sizeof header);
        return header;
    }
    /// True where it opened; then it plays.
    static bool survives(std::span<const std::byte> bytes) {
        std::string why;
        const std::optional<Pack> pack = Pack::open(bytes, &why);
        EXPECT_EQ(pack.has_value(), why.empty());
        if (!pack) return false;
        EXPECT_EQ(problem(*pack), "");
        test::Played(*pack, 10);
        return true;
    }
};

TEST_F(PackFuzz, survives_every_kind_of_end) {
    for (std::size_t size = 0; size < bytes().size(); size += size < 80 ? 1 : 997)
        EXPECT_FALSE(survives(std::span(bytes()).subspan(0, size)));
    // Definitions that end anywhere, in a file that is whole.
    const PackHeader whole = header();
    for (std::size_t size = 0; size < whole.definitions_size; size += 1 + size / 16) {
        std::vector<std::byte> cut = bytes();
        PackHeader shorter = whole;
        shorter.definitions_size = size;
        std::memcpy(cut.data(), &shorter, sizeof shorter);
        mend_header(cut);
        EXPECT_FALSE(survives(cut)) << size;
    }
}

TEST_F(PackFuzz, survives_bits_that_flip) {
    Random random(1);
    const PackHeader whole = header();
    int opened = 0;
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::byte> damaged = bytes();
        const bool in_definitions = i % 4 != 0;
        for (int flips = 1 + i % 3; flips > 0; --flips) {
            const auto from = static_cast<std::uint32_t>(in_definitions ? whole.definitions : k_checksum_from);
            const auto until = static_cast<std::uint32_t>(in_definitions ? whole.size : whole.definitions);
            damaged[from + random.below(until - from)] ^= static_cast<std::byte>(1u << random.below(8));
        }
        EXPECT_FALSE(Pack::open(damaged));  // the checksum tells
        mend_header(damaged);
        opened += survives(damaged);
    }
    EXPECT_GT(opened, 100);  // else the checks would not have been reached
}

TEST_F(PackFuzz, survives_numbers_that_are_another) {
    Random random(2);
    const PackHeader whole = header();
    const std::uint32_t numbers[] = {0, 1, 0xffffffffu, 0x7fffffffu, 0x80000000u, 0xffffu, 0x7f7fffffu, 0x00000001u};
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::byte> damaged = bytes();
        const std::size_t at = whole.definitions + random.below(static_cast<std::uint32_t>(whole.definitions_size - 4));
        std::memcpy(damaged.data() + at, &numbers[random.below(8)], i % 2 == 0 ? 4 : 2);
        mend_header(damaged);
        survives(damaged);
    }
}

TEST_F(PackFuzz, survives_headers_and_random_bytes) {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::byte> noise(random.below(3) == 0 ? random.below(200) : 64 * (1 + random.below(64)));
        for (std::byte& byte : noise) byte = static_cast<std::byte>(random.below(256));
        PackHeader header;
        header.definitions = i % 5 == 0 ? random.next() : 64 * random.below(32);
        header.definitions_size = i % 7 == 0 ? ~std::uint64_t{0} - random.below(200) : random.below(4000);
        if (!noise.empty()) std::memcpy(noise.data(), &header, std::min(noise.size(), sizeof header));
        mend_header(noise);
        EXPECT_FALSE(survives(noise));
    }
}

}  // namespace
}  // namespace surefoot
