#include <surefoot/base/error.h>
#include <surefoot/graph_text/json_edit.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace surefoot {
namespace {

struct Range {
    std::size_t begin = 0, end = 0;
};

/// Finds places in a text that is known to be sound JSON.
class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    Range value_at(std::size_t at) const { return {skip_space(at), end_of(skip_space(at))}; }

    struct Member {
        std::string key;
        std::size_t begin = 0;  ///< of the key, or of an array's value
        Range value;
    };
    /// Of an object; of an array with its indices as keys.
    std::vector<Member> members(Range of) const {
        std::vector<Member> all;
        const bool object = text_[of.begin] == '{';
        std::size_t at = skip_space(of.begin + 1);
        while (at + 1 < of.end && text_[at] != '}' && text_[at] != ']') {
            Member member{std::to_string(all.size()), at, {}};
            if (object) {
                const std::size_t end = end_of(at);
                member.key = nlohmann::json::parse(text_.substr(at, end - at)).get<std::string>();
                at = skip_space(end) + 1;  // the colon
            }
            member.value = value_at(at);
            all.push_back(member);
            at = skip_space(member.value.end);
            if (at < of.end && text_[at] == ',') at = skip_space(at + 1);
        }
        return all;
    }
    bool is_container(Range value) const { return text_[value.begin] == '{' || text_[value.begin] == '['; }
    bool is_object(Range value) const { return text_[value.begin] == '{'; }

  private:
    std::size_t skip_space(std::size_t at) const {
        const std::size_t next = text_.find_first_not_of(" \t\r\n", at);
        return next == std::string_view::npos ? text_.size() : next;
    }
    std::size_t end_of_string(std::size_t at) const {
        for (++at; text_[at] != '"'; ++at)
            if (text_[at] == '\\') ++at;
        return at + 1;
    }
    std::size_t end_of(std::size_t at) const {
        if (text_[at] == '"') return end_of_string(at);
        if (text_[at] != '{' && text_[at] != '[') return std::min(text_.find_first_of(" \t\r\n,]}", at), text_.size());
        for (int depth = 0;;) {
            const char c = text_[at];
            at = c == '"' ? end_of_string(at) : at + 1;
            if (c == '{' || c == '[') ++depth;
            if ((c == '}' || c == ']') && --depth == 0) return at;
        }
    }

    std::string_view text_;
};

std::vector<std::string> keys_of(std::string_view pointer) {
    std::vector<std::string> keys;
    for (std::size_t at = 0; at < pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
        std::string key;
        for (std::size_t i = at + 1; i < end; ++i)
            if (pointer[i] == '~' && i + 1 < end)
                key += pointer[++i] == '1' ? '/' : '~';
            else
                key += pointer[i];
        keys.push_back(std::move(key));
        at = end;
    }
    return keys;
}

/// The new member goes after the last one, on a line of its own where that one has one.
std::string added(std::string_view text, Range object, const std::vector<Scanner::Member>& members,
                  const std::string& key, std::string_view value) {
    const bool array = text[object.begin] == '[';
    const std::string member = (array ? "" : nlohmann::json(key).dump() + ": ") + std::string(value);
    std::string out(text);
    if (members.empty()) return out.insert(object.begin + 1, member);
    const Scanner::Member& last = members.back();
    const std::size_t before = text.find_last_not_of(" \t\r\n", last.begin - 1) + 1;
    const std::string_view gap = text.substr(before, last.begin - before);
    const bool own_line = gap.find('\n') != std::string_view::npos;
    return out.insert(last.value.end, "," + (own_line ? std::string(gap) : " ") + member);
}

}  // namespace

std::string with_json_value(std::string_view text, std::string_view pointer, std::string_view value) {
    if (!nlohmann::json::accept(text)) throw Error("the text is no JSON", "", "mend it first");
    if (!nlohmann::json::accept(value)) throw Error("the value is no JSON", std::string(value), "");
    const Scanner scanner(text);
    const std::vector<std::string> keys = keys_of(pointer);
    Range at = scanner.value_at(0);
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const auto members = scanner.is_container(at) ? scanner.members(at) : std::vector<Scanner::Member>{};
        std::optional<Range> found;
        for (const Scanner::Member& member : members)
            if (member.key == keys[k]) found = member.value;
        if (!found) {
            const bool takes = scanner.is_object(at) || (scanner.is_container(at) && keys[k] == "-");
            if (k + 1 == keys.size() && takes) return added(text, at, members, keys[k], value);
            throw Error("there is nothing of that name", std::string(pointer), "it has no '" + keys[k] + "'");
        }
        at = *found;
    }
    return std::string(text.substr(0, at.begin)) + std::string(value) + std::string(text.substr(at.end));
}

std::string without_json_value(std::string_view text, std::string_view pointer) {
    if (!nlohmann::json::accept(text)) throw Error("the text is no JSON", "", "mend it first");
    const Scanner scanner(text);
    Range at = scanner.value_at(0), gone;
    for (const std::string& key : keys_of(pointer)) {
        const auto members = scanner.is_container(at) ? scanner.members(at) : std::vector<Scanner::Member>{};
        std::size_t m = 0;
        while (m < members.size() && members[m].key != key) ++m;
        if (m == members.size())
            throw Error("there is nothing of that name", std::string(pointer), "it has no '" + key + "'");
        // What follows moves up to its place; the last one takes the comma before it along.
        const Range own{members[m].begin, members[m].value.end};
        gone = m + 1 < members.size() ? Range{own.begin, members[m + 1].begin}
                                      : Range{m > 0 ? members[m - 1].value.end : own.begin, own.end};
        at = members[m].value;
    }
    if (gone.end == 0) throw Error("a text is not without all of itself", std::string(pointer), "name a place in it");
    return std::string(text.substr(0, gone.begin)) + std::string(text.substr(gone.end));
}

}  // namespace surefoot
