#pragma once
// A GLB file of any JSON text and floats, however wrong.

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot::test {

inline std::string glb_bytes(std::string json, const std::vector<float>& floats) {
    const auto word = [](std::size_t value) {
        std::string bytes;
        for (int i = 0; i < 4; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
        return bytes;
    };
    json.resize((json.size() + 3) & ~std::size_t{3}, ' ');
    const std::string binary(reinterpret_cast<const char*>(floats.data()), floats.size() * sizeof(float));
    return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size()) + "JSON" + json +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
}

}  // namespace surefoot::test
