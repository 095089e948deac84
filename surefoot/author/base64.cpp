#include <surefoot/author/base64.h>

#include <vector>

namespace surefoot {

std::string base64(std::span<const std::uint8_t> bytes) {
    static constexpr char k_digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const bool two = i + 1 < bytes.size(), three = i + 2 < bytes.size();
        const unsigned word = static_cast<unsigned>(bytes[i]) << 16u |
                              (two ? static_cast<unsigned>(bytes[i + 1]) << 8u : 0u) | (three ? bytes[i + 2] : 0u);
        text += k_digits[word >> 18u];
        text += k_digits[word >> 12u & 63u];
        text += two ? k_digits[word >> 6u & 63u] : '=';
        text += three ? k_digits[word & 63u] : '=';
    }
    return text;
}

std::string base64_of_hex(std::string_view digits) {
    const auto value = [](char c) { return static_cast<unsigned>(c <= '9' ? c - '0' : c - 'a' + 10); };
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(value(digits[i]) << 4u | value(digits[i + 1])));
    return base64(bytes);
}

}  // namespace surefoot
