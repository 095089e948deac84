#pragma once

namespace surefoot {

struct Other;
struct Source {
    int a, b, c;
};

class Stairs final : public Ground {};

namespace detail {
struct Hidden {};
}  // namespace detail

}  // namespace surefoot
