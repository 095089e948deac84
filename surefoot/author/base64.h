#pragma once
// Bytes as text, RFC 4648. Private to the room.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace surefoot {

std::string base64(std::span<const std::uint8_t> bytes);
/// The same of bytes that are written in hexadecimal, two lower-case digits each.
std::string base64_of_hex(std::string_view digits);

}  // namespace surefoot
