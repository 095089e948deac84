#include <surefoot/base/error.h>
#include <surefoot/gait_text/gait.h>
#include <surefoot/gait_text/tokens.h>

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }

constexpr std::size_t k_shown_bytes = 100;

/// A name, with its dots: at least one letter long.
std::size_t name_end(std::string_view source, std::size_t at) {
    const auto in_part = [&](std::size_t i) {
        return i < source.size() && (is_letter(source[i]) || is_digit(source[i]));
    };
    for (;;) {
        while (in_part(at)) ++at;
        if (at + 1 >= source.size() || source[at] != '.' || !is_letter(source[at + 1])) return at;
        ++at;
    }
}

}  // namespace

std::string quoted(const Token& token) {
    if (token.kind == TokenKind::end) return "the end of the text";
    return "'" + std::string(token.text.substr(0, 40)) + "'";
}

Tokens::Tokens(std::string_view source, std::string where) : source_(source), where_(std::move(where)) {
    if (source.size() > k_max_gait_bytes)
        throw Error("the text is longer than " + std::to_string(k_max_gait_bytes) + " bytes", where_,
                    "is it what it is taken for?");
    next_ = scan();
}

Token Tokens::take() {
    const Token token = next_;
    if (token.kind != TokenKind::end) next_ = scan();
    return token;
}

bool Tokens::accept(std::string_view text) {
    if (next_.kind == TokenKind::text || next_.kind == TokenKind::end || next_.text != text) return false;
    take();
    return true;
}

Token Tokens::expect(std::string_view text, const char* remedy) {
    const Token token = next_;
    if (!accept(text)) fail("'" + std::string(text) + "' is missing before " + quoted(token), token.at, remedy);
    return token;
}

std::string Tokens::place(std::size_t at) const {
    const std::string_view before = source_.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
    const auto column =
        1 + std::count_if(before.begin() + static_cast<std::ptrdiff_t>(start), before.end(), starts_character);
    return where_ + ":" + std::to_string(line) + ":" + std::to_string(column);
}

void Tokens::fail(std::string problem, std::size_t at, std::string_view remedy) const {
    // What is missing at the end is missing after the last word.
    if (at == source_.size())
        while (at > 0 && std::string_view(" \t\r\n").find(source_[at - 1]) != std::string_view::npos) --at;
    // The line with a caret below; of long lines the part around the place.
    std::size_t start = source_.substr(0, at).rfind('\n') + 1;
    if (at - start > k_shown_bytes) {
        start = at - k_shown_bytes / 2;
        while (start < at && !starts_character(source_[start])) ++start;
    }
    std::string line, caret;
    for (std::size_t i = start; i < source_.size() && i < start + k_shown_bytes + 20 && source_[i] != '\n'; ++i) {
        const char c = source_[i];
        if (c == '\r') continue;
        if (i > start + k_shown_bytes && starts_character(c)) break;
        line += static_cast<unsigned char>(c) < 32 && c != '\t' ? '?' : c;
        if (i < at && starts_character(c)) caret += c == '\t' ? '\t' : ' ';
    }
    throw Error(problem, place(at), std::string(remedy) + "\n    " + line + "\n    " + caret + "^");
}

Token Tokens::scan() {
    while (at_ < source_.size()) {
        const char c = source_[at_];
        if (c == '#') {
            at_ = std::min(source_.find('\n', at_), source_.size());
        } else if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
            ++at_;
        } else {
            break;
        }
    }
    Token token;
    token.at = at_;
    if (at_ == source_.size()) return token;
    const char c = source_[at_];
    const char after = at_ + 1 < source_.size() ? source_[at_ + 1] : '\0';
    std::size_t end = at_ + 1;
    if (is_letter(c)) {
        token.kind = TokenKind::name;
        end = name_end(source_, at_);
        if (end - at_ > 64) fail("this name is longer than 64 letters", at_, "choose a shorter one");
    } else if (is_digit(c) || (c == '.' && is_digit(after))) {
        token.kind = TokenKind::number;
        const auto [stop, error] =
            fast_float::from_chars(source_.data() + at_, source_.data() + source_.size(), token.number);
        if (error != std::errc{} || !(std::fabs(token.number) <= 1e30))
            fail("this number is out of range", at_, "numbers go to 1e30");
        end = static_cast<std::size_t>(stop - source_.data());
        if (end < source_.size() && (is_letter(source_[end]) || source_[end] == '.'))
            fail("a number runs into what follows", end, "write a sign or a space between them, such as 2 * pi");
    } else if (c == '"') {
        token.kind = TokenKind::text;
        end = source_.find_first_of("\"\n", end);
        if (end == std::string_view::npos || source_[end] == '\n')
            fail("this text has no closing quote on its line", at_, "close it by \"");
        token.text = source_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        return token;
    } else {
        token.kind = TokenKind::sign;
        if (after == '=' && std::string_view("<>=!").find(c) != std::string_view::npos) ++end;
        if (c == '^') fail("there is no sign ^", at_, "write x * x for the square of x");
        if (c == '!' && end == at_ + 1) fail("there is no sign !", at_, "write not");
        if (std::string_view("+-*/(),?:<>=!{}[]").find(c) == std::string_view::npos)
            fail("the language has no use for this character", at_, "it is described in docs/gaits.md");
    }
    token.text = source_.substr(at_, end - at_);
    at_ = end;
    return token;
}

}  // namespace surefoot
