#include "source_tree.h"

#include <sys/wait.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace surefoot::gates {

namespace fs = std::filesystem;

namespace {

// What a runtime room may take from the standard library: no hashed containers (their order differs), no streams, no
// files, no threads, no locale.
constexpr std::array k_runtime_headers = {
    "algorithm",
    "deque",
    "map",
    "set",
    "array",
    "bit",
    "cassert",
    "cfloat",
    "climits",
    "cmath",
    "compare",
    "concepts",
    "cstddef",
    "cstdint",
    "cstring",
    "functional",
    "initializer_list",
    "iterator",
    "limits",
    "memory",
    "new",
    "numbers",
    "numeric",
    "optional",
    "span",
    "stdexcept",
    "string",
    "string_view",
    "tuple",
    "type_traits",
    "utility",
    "variant",
    "vector",
    "version",
};

// Intrinsics have one door.
constexpr std::array k_intrinsics = {"immintrin.h", "wasm_simd128.h", "arm_neon.h"};
constexpr const char* k_intrinsics_door = "surefoot/math/lanes";

// A forward header costs its reader nothing, so it may stand in a public header of an authoring room.
constexpr const char* k_forward_header = "nlohmann/json_fwd.hpp";

// Transcendental functions of libm; each also with an f or l at its end.
constexpr std::array k_transcendental = {
    "sin",   "cos",   "tan",   "asin",  "acos", "atan", "atan2", "sincos", "sinh",   "cosh",
    "tanh",  "asinh", "acosh", "atanh", "exp",  "exp2", "exp10", "expm1",  "log",    "log2",
    "log10", "log1p", "pow",   "hypot", "cbrt", "erf",  "erfc",  "tgamma", "lgamma",
};

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

std::string read_text(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Comments and the contents of string and character literals as blanks; line breaks stay where they are.
std::string code_only(const std::string& text) {
    std::string code = text;
    const auto blank = [&](std::size_t at) {
        if (code[at] != '\n') code[at] = ' ';
    };
    for (std::size_t i = 0; i < text.size();) {
        if (text.compare(i, 2, "//") == 0) {
            while (i < text.size() && text[i] != '\n') blank(i++);
        } else if (text.compare(i, 2, "/*") == 0) {
            const std::size_t end = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
            while (i < end) blank(i++);
        } else if (text.compare(i, 3, "R\"(") == 0) {
            const std::size_t end = std::min(text.find(")\"", i), text.size() - 2) + 2;
            while (i < end) blank(i++);
        } else if (text[i] == '"' || (text[i] == '\'' && (i == 0 || !is_word(text[i - 1])))) {
            const char quote = text[i++];
            while (i < text.size() && text[i] != quote && text[i] != '\n') {
                if (text[i] == '\\' && i + 1 < text.size()) blank(i++);
                blank(i++);
            }
            ++i;
        } else {
            ++i;
        }
    }
    return code;
}

std::size_t line_of(const std::string& text, std::size_t at) {
    return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

struct Source {
    std::string path;  ///< relative to the root: surefoot/rig/skeleton.h
    std::string room;
    bool header = false;
    std::string text;
};

std::vector<Source> sources_of(const fs::path& root) {
    std::vector<Source> sources;
    for (const auto& entry : fs::recursive_directory_iterator(root / "surefoot")) {
        const std::string extension = entry.path().extension().string();
        if (!entry.is_regular_file() || extension == ".md" || extension == ".txt") continue;
        const std::string path = entry.path().lexically_relative(root).generic_string();
        const std::size_t first = path.find('/') + 1, second = path.find('/', first);
        const std::string room = second == std::string::npos ? "" : path.substr(first, second - first);
        sources.push_back({path, room, extension != ".cpp", read_text(entry.path())});
    }
    std::sort(sources.begin(), sources.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    return sources;
}

struct Include {
    std::string what;  ///< without its brackets
    char bracket = 0;  ///< '<', '"', or 0 where it is neither
    std::size_t line = 0;
};

std::vector<Include> includes_of(const std::string& text) {
    // Literals are blanked, so the directive is found in the code and its name read from the text.
    static const std::regex directive(R"((^|\n)[ \t]*#[ \t]*(include|include_next|import)\b)");
    const std::string code = code_only(text);
    std::vector<Include> includes;
    for (std::sregex_iterator at(code.begin(), code.end(), directive), end; at != end; ++at) {
        const auto start = static_cast<std::size_t>(at->position() + at->length());
        std::string rest = text.substr(start, text.find('\n', start) - start);
        rest.erase(0, rest.find_first_not_of(" \t"));
        Include include{rest, 0, line_of(text, start)};
        if (!rest.empty() && (rest[0] == '<' || rest[0] == '"')) {
            include.bracket = rest[0];
            include.what = rest.substr(1, rest.find(rest[0] == '<' ? '>' : '"', 1) - 1);
        }
        includes.push_back(include);
    }
    return includes;
}

class Layering {
  public:
    explicit Layering(const fs::path& root) : rooms_(rooms_of(root)), sources_(sources_of(root)) {
        for (std::size_t i = 0; i < rooms_.size(); ++i) place_[rooms_[i].name] = i;
        for (const Source& source : sources_) known_.insert(source.path);
    }

    std::vector<std::string> breaches() {
        if (rooms_.empty()) say("surefoot/CMakeLists.txt", 1, "declares no rooms: the gate would check nothing");
        if (sources_.empty()) say("surefoot", 1, "holds no sources: the gate would check nothing");
        for (const Room& room : rooms_)
            for (const std::string& other : room.depends)
                if (!place_.contains(other) || place_[other] >= place_[room.name])
                    say("surefoot/CMakeLists.txt", 1,
                        "room '" + room.name + "' depends on '" + other + "', which is not above it");
        for (const Source& source : sources_) check(source);
        find_third_party_in_public();
        find_cycles();
        return std::move(breaches_);
    }

  private:
    void say(const std::string& file, std::size_t line, const std::string& what) {
        breaches_.push_back(file + ":" + std::to_string(line) + ": " + what);
    }

    void check(const Source& source) {
        if (!place_.contains(source.room)) {
            say(source.path, 1, "lies in no room that surefoot/CMakeLists.txt declares");
            return;
        }
        if (source.path.ends_with(".h") && source.text.find("#pragma once") == std::string::npos)
            say(source.path, 1, "has no #pragma once");
        for (const Include& include : includes_of(source.text)) {
            if (include.bracket == 0)
                say(source.path, include.line, "an include through a macro hides what is included");
            else if (include.what.starts_with("surefoot/"))
                check_own(source, include);
            else if (include.bracket == '"')
                check_beside(source, include);
            else
                check_foreign(source, include);
        }
    }

    void check_own(const Source& source, const Include& include) {
        const std::string other = include.what.substr(9, include.what.find('/', 9) - 9);
        if (!known_.contains(include.what)) {
            say(source.path, include.line, "no such file: " + include.what);
            return;
        }
        edges_[source.path].push_back(include.what);
        if (other == source.room || !place_.contains(other)) return;
        const bool below = place_[other] > place_[source.room];
        if (below) say(source.path, include.line, "room '" + source.room + "' includes '" + other + "' from below it");
        if (rooms_[place_[source.room]].runtime && !rooms_[place_[other]].runtime)
            say(source.path, include.line,
                "runtime room '" + source.room + "' includes authoring room '" + other + "'");
    }

    void check_beside(const Source& source, const Include& include) {
        const std::string path = source.path.substr(0, source.path.rfind('/') + 1) + include.what;
        if (include.what.find("..") == std::string::npos && known_.contains(path))
            edges_[source.path].push_back(path);
        else
            say(source.path, include.line, "\"" + include.what + "\" leaves its room; write <surefoot/room/file.h>");
    }

    void check_foreign(const Source& source, const Include& include) {
        const auto listed = [&](const auto& list) {
            return std::find(list.begin(), list.end(), include.what) != list.end();
        };
        if (listed(k_intrinsics)) {
            if (!source.path.starts_with(k_intrinsics_door))
                say(source.path, include.line, "intrinsics belong into " + std::string(k_intrinsics_door) + "*");
        } else if (rooms_[place_[source.room]].runtime) {
            if (!listed(k_runtime_headers))
                say(source.path, include.line, "a runtime room may not include <" + include.what + ">");
        } else if (source.header && include.what.find_first_of("./") != std::string::npos &&
                   include.what != k_forward_header) {
            third_party_[source.path] = include.what;
        }
    }

    /// A header that names third party is private: only the .cpp files of its room may include it.
    void find_third_party_in_public() {
        for (const auto& [file, targets] : edges_)
            for (const std::string& target : targets)
                if (third_party_.contains(target) && (!file.ends_with(".cpp") || room_path(file) != room_path(target)))
                    say(file, 1,
                        "takes <" + third_party_[target] + "> from " + target +
                            ", which only the .cpp files of its room may include");
    }

    static std::string room_path(const std::string& file) { return file.substr(0, file.rfind('/')); }

    void find_cycles() {
        std::map<std::string, int> state;  // 1 open, 2 done
        std::vector<std::string> path;
        const std::function<void(const std::string&)> visit = [&](const std::string& file) {
            state[file] = 1;
            path.push_back(file);
            for (const std::string& next : edges_[file]) {
                if (state[next] == 1) {
                    std::string text = "include cycle:";
                    for (auto at = std::find(path.begin(), path.end(), next); at != path.end(); ++at)
                        text += " " + *at + " ->";
                    say(file, 1, text + " " + next);
                } else if (state[next] == 0) {
                    visit(next);
                }
            }
            path.pop_back();
            state[file] = 2;
        };
        for (const Source& source : sources_)
            if (state[source.path] == 0) visit(source.path);
    }

    std::vector<Room> rooms_;
    std::vector<Source> sources_;
    std::map<std::string, std::size_t> place_;
    std::set<std::string> known_;
    std::map<std::string, std::vector<std::string>> edges_;
    std::map<std::string, std::string> third_party_;  // header -> the foreign header it names
    std::vector<std::string> breaches_;
};

bool is_transcendental(std::string name) {
    const auto listed = [&] {
        return std::find(k_transcendental.begin(), k_transcendental.end(), name) != k_transcendental.end();
    };
    if (listed()) return true;
    if (name.empty() || (name.back() != 'f' && name.back() != 'l')) return false;
    name.pop_back();
    return listed();
}

/// Transcendental functions that our math room declares: an unqualified call of these finds ours. (Should one find
/// libm's after all, the library asks for it and `libm_symbols` sees that.)
std::set<std::string> own_functions(const std::vector<Source>& sources) {
    static const std::regex declaration(R"(\b(?!return\b|else\b)\w+[&*]*\s+(\w+)\s*\()");
    std::set<std::string> names;
    for (const Source& source : sources) {
        if (source.room != "math" || !source.path.ends_with(".h")) continue;
        const std::string code = code_only(source.text);
        for (std::sregex_iterator at(code.begin(), code.end(), declaration), end; at != end; ++at)
            if (is_transcendental((*at)[1])) names.insert((*at)[1]);
    }
    return names;
}

enum class Qualifier { none, global, std, other };

/// What stands before the name at `at`: nothing, `::`, `std::`, or an object or other namespace.
Qualifier qualifier(const std::string& code, std::size_t at) {
    const auto skip = [&] {
        while (at > 0 && std::isspace(static_cast<unsigned char>(code[at - 1]))) --at;
    };
    skip();
    if (at >= 1 && code[at - 1] == '.') return Qualifier::other;
    if (at >= 2 && code[at - 1] == '>' && code[at - 2] == '-') return Qualifier::other;
    if (at < 2 || code[at - 1] != ':' || code[at - 2] != ':') return Qualifier::none;
    at -= 2;
    skip();
    std::size_t start = at;
    while (start > 0 && is_word(code[start - 1])) --start;
    const std::string name = code.substr(start, at - start);
    if (name.empty() || name == "return") return Qualifier::global;
    return name == "std" ? Qualifier::std : Qualifier::other;
}

}  // namespace

std::vector<Room> rooms_of(const fs::path& root) {
    static const std::regex call(R"(surefoot_room\(\s*([^)]*)\))");
    std::string text = read_text(root / "surefoot/CMakeLists.txt");
    text = std::regex_replace(text, std::regex("#[^\n]*"), "");
    std::vector<Room> rooms;
    for (std::sregex_iterator at(text.begin(), text.end(), call), end; at != end; ++at) {
        std::istringstream words((*at)[1]);
        Room room;
        bool depends = false;
        words >> room.name;
        for (std::string word; words >> word;) {
            if (word == "RUNTIME")
                room.runtime = true;
            else if (word == "DEPENDS" || word == "LIBRARIES")
                depends = word == "DEPENDS";
            else if (depends)
                room.depends.push_back(word);
        }
        rooms.push_back(room);
    }
    return rooms;
}

std::vector<std::string> layering_breaches(const fs::path& root) { return Layering(root).breaches(); }

std::vector<std::string> doubled_types(const fs::path& root) {
    // Formatted as ours are, what stands in a namespace is not indented.
    static const std::regex opened(R"(^(?:inline )?namespace ?([\w:]*) ?\{)"), closed(R"(^\}  // namespace)");
    static const std::regex type(
        R"(^(?:template <.*> ?)?(?:struct|class|union|enum(?: class)?) (\w+)(?: final)?(?: :[^;]*)? ?\{)");
    std::map<std::string, std::string> seen;
    std::vector<std::string> breaches;
    for (const Source& source : sources_of(root)) {
        std::vector<std::string> inside;
        std::istringstream lines(source.text);
        std::size_t number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++number;
            std::smatch match;
            if (std::regex_search(line, match, opened)) {
                inside.push_back(match[1]);
            } else if (std::regex_search(line, closed) && !inside.empty()) {
                inside.pop_back();
            } else if (std::regex_search(line, match, type) &&
                       std::find(inside.begin(), inside.end(), "") == inside.end()) {
                std::string name;
                for (const std::string& each : inside) name += each + "::";
                name += match[1];
                const std::string here = source.path + ":" + std::to_string(number);
                const auto [before, first] = seen.emplace(name, here);
                if (!first)
                    breaches.push_back(here + ": " + name + " is defined at " + before->second + ", too; rename one");
            }
        }
    }
    return breaches;
}

std::vector<std::string> libm_calls(const fs::path& root) {
    static const std::regex call(R"(\b(?:__builtin_)?([A-Za-z]\w*)\s*\()");
    static const std::regex taken(R"(\bstd\s*::\s*(\w+)\b)");  // also without a call: using std::sin, &std::sin
    const std::vector<Source> sources = sources_of(root);
    const std::set<std::string> ours = own_functions(sources);
    std::vector<std::string> breaches;
    const auto say = [&](const Source& source, std::size_t at, const std::string& name) {
        breaches.push_back(source.path + ":" + std::to_string(line_of(source.text, at)) + ": libm's " + name +
                           " differs between systems; use math/trig.h");
    };
    for (const Source& source : sources) {
        const std::string code = code_only(source.text);
        for (std::sregex_iterator at(code.begin(), code.end(), taken), end; at != end; ++at)
            if (is_transcendental((*at)[1])) say(source, static_cast<std::size_t>(at->position()), (*at)[1]);
        for (std::sregex_iterator at(code.begin(), code.end(), call), end; at != end; ++at) {
            const std::string name = (*at)[1];
            if (!is_transcendental(name)) continue;
            const auto start = static_cast<std::size_t>(at->position());
            const bool builtin = code.compare(start, 10, "__builtin_") == 0;
            const Qualifier before = qualifier(code, start);
            if (builtin || before == Qualifier::global || (before == Qualifier::none && !ours.contains(name)))
                say(source, start, name);
        }
    }
    return breaches;
}

std::vector<std::string> libm_symbols(const std::string& nm_output) {
    std::set<std::string> found;
    std::istringstream lines(nm_output);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind, name;
        words >> kind >> name;
        name = name.substr(0, name.find('@'));
        if (kind == "U" && is_transcendental(name)) found.insert(name);
    }
    return {found.begin(), found.end()};
}

std::vector<std::string> dependent_headers(const fs::path& root, const std::string& compiler, const fs::path& scratch) {
    fs::remove_all(scratch);
    fs::create_directories(scratch);
    const std::vector<Source> sources = sources_of(root);
    std::set<std::string> proven;  // a header that its own .cpp includes first compiles alone if that .cpp does
    for (const Source& source : sources) {
        const auto includes = includes_of(source.text);
        if (!source.header && !includes.empty()) proven.insert(includes[0].what);
    }
    std::string files;
    bool any = false;
    for (const Source& source : sources) {
        if (!source.path.ends_with(".h")) continue;
        any = true;
        if (proven.contains(source.path)) continue;
        std::string name = source.path + ".cpp";
        std::replace(name.begin(), name.end(), '/', '.');
        std::ofstream(scratch / name) << "#include <" << source.path << ">\n";
        files += " '" + (scratch / name).string() + "'";
    }
    if (!any) return {"no headers under " + root.string()};
    if (files.empty()) return {};
    const CommandResult result =
        run("'" + compiler + "' -std=c++20 -fsyntax-only -I'" + root.string() + "'" + files + " 2>&1");
    if (result.status == 0) return {};
    std::vector<std::string> errors;
    std::istringstream lines(result.output);
    for (std::string line; std::getline(lines, line);)
        if (line.find("error:") != std::string::npos) errors.push_back(line);
    if (errors.empty()) errors.push_back("the compiler failed: " + result.output);
    return errors;
}

CommandResult run(const std::string& command) {
    CommandResult result;
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return {-1, "could not start: " + command};
    std::array<char, 4096> buffer;
    for (std::size_t got; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        result.output.append(buffer.data(), got);
    const int status = pclose(pipe);
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return result;
}

}  // namespace surefoot::gates
