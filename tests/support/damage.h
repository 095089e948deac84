#pragma once
// Texts that something has happened to, for readers to survive.

#include <surefoot/base/random.h>

#include <string>

namespace surefoot::test {

/// One to four damages: a byte that is another, a piece that is gone, a piece that stands twice, an end that is
/// missing.
inline std::string damaged(std::string text, Random& random) {
    const int damages = 1 + static_cast<int>(random.below(4));
    for (int d = 0; d < damages && !text.empty(); ++d) {
        const std::size_t from = random.below(static_cast<std::uint32_t>(text.size()));
        const std::size_t length = random.below(40);
        switch (random.below(4)) {
            case 0:
                text[from] = static_cast<char>(random.below(256));
                break;
            case 1:
                text.erase(from, length);
                break;
            case 2:
                text.insert(from, text.substr(random.below(static_cast<std::uint32_t>(text.size())), length));
                break;
            default:
                text.resize(from);
        }
    }
    return text;
}

}  // namespace surefoot::test
