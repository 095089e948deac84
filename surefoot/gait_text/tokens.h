#pragma once
// A text cut into words, with errors that show the place.

#include <cstddef>
#include <string>
#include <string_view>

namespace surefoot {

enum class TokenKind { name, number, text, sign, end };

struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text;  ///< of a text: without its quotes
    double number = 0;
    std::size_t at = 0;  ///< byte in the source
};

/// One token at a time, with one of lookahead.
class Tokens {
  public:
    /// `source` must outlive this. Throws Error where it is too long or its first token is none.
    Tokens(std::string_view source, std::string where);

    const Token& peek() const noexcept { return next_; }
    Token take();
    /// Takes the next token if it is this sign or word.
    bool accept(std::string_view text);
    /// Takes it or throws.
    Token expect(std::string_view text, const char* remedy);

    /// "file:line:column"
    std::string place(std::size_t at) const;
    [[noreturn]] void fail(std::string problem, std::size_t at, std::string_view remedy) const;

  private:
    Token scan();

    std::string_view source_;
    std::string where_;
    std::size_t at_ = 0;
    Token next_;
};

/// A token as messages show it.
std::string quoted(const Token& token);

}  // namespace surefoot
