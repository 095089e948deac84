#include <surefoot/io/clip_name.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

namespace surefoot {

namespace {

constexpr std::size_t k_longest_name = 80;

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
    while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
    return text;
}

/// Length of the valid UTF-8 sequence at the start of `text`, 0 where there is none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f) || (first == 0xf0 && byte(1) < 0x90) ||
        (first == 0xf4 && byte(1) > 0x8f))
        return 0;
    return length;
}

/// Names that Windows keeps for devices, whatever their extension.
bool is_device_name(std::string_view name) {
    const std::string stem = lower_case(name.substr(0, name.find('.')));
    if (stem == "con" || stem == "prn" || stem == "aux" || stem == "nul") return true;
    return stem.size() == 4 && (stem.starts_with("com") || stem.starts_with("lpt")) && stem[3] >= '0' && stem[3] <= '9';
}

/// "take 001", "layer0", "animation.003" without their number: "take", "layer", "animation".
std::string without_number(std::string name) {
    while (!name.empty() && (std::isdigit(static_cast<unsigned char>(name.back())) != 0 || name.back() == ' ' ||
                             name.back() == '.' || name.back() == '_' || name.back() == '-'))
        name.pop_back();
    return name;
}

/// True for one part of a name between '|' that says nothing about the clip.
bool is_generic_part(std::string_view part) {
    static constexpr std::array<std::string_view, 18> k_generic = {
        "",           "mixamo.com", "take",    "animation",      "anim",     "layer",
        "scene",      "armature",   "action",  "armatureaction", "clip",     "animationstack",
        "base layer", "baselayer",  "default", "unnamed",        "untitled", "unreal take"};
    const std::string name = without_number(lower_case(trimmed(part)));
    return std::find(k_generic.begin(), k_generic.end(), name) != k_generic.end();
}

}  // namespace

std::string file_stem(std::string_view path) {
    const std::size_t slash = path.find_last_of("/\\");
    if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
    const std::size_t dot = path.rfind('.');
    return std::string(dot == std::string_view::npos || dot == 0 ? path : path.substr(0, dot));
}

bool is_generic_clip_name(std::string_view name) {
    for (std::size_t bar = name.find('|'); bar != std::string_view::npos; bar = name.find('|')) {
        if (!is_generic_part(name.substr(0, bar))) return false;
        name.remove_prefix(bar + 1);
    }
    return is_generic_part(name);
}

std::string safe_file_name(std::string_view name) {
    std::string safe;
    for (std::size_t i = 0; i < name.size();) {
        const std::size_t length = utf8_length(name.substr(i));
        const auto c = static_cast<unsigned char>(name[i]);
        const bool control = length == 0 || c < 0x20 || c == 0x7f ||
                             (length == 2 && c == 0xc2 && static_cast<unsigned char>(name[i + 1]) < 0xa0);
        const bool special = length == 1 && std::string_view("/\\:*?\"<>|").find(name[i]) != std::string_view::npos;
        if (safe.size() + std::max<std::size_t>(length, 1) > k_longest_name) break;
        if (control || special)
            safe += '_';
        else
            safe.append(name.substr(i, length));
        i += std::max<std::size_t>(length, 1);
    }
    const auto first = safe.find_first_not_of(" .");
    safe = first == std::string::npos ? std::string() : safe.substr(first);
    while (!safe.empty() && (safe.back() == ' ' || safe.back() == '.')) safe.pop_back();
    if (safe.find_first_not_of('_') == std::string::npos) safe = "clip";
    if (is_device_name(safe)) safe.insert(0, "_");
    return safe;
}

std::string clip_name(std::string_view own_name, std::string_view file) {
    if (is_generic_clip_name(own_name)) return safe_file_name(file_stem(file));
    // "Armature|Walk|Layer0": the parts that say something.
    std::string telling;
    while (!own_name.empty()) {
        const std::size_t bar = std::min(own_name.find('|'), own_name.size());
        const std::string_view part = trimmed(own_name.substr(0, bar));
        own_name.remove_prefix(std::min(bar + 1, own_name.size()));
        if (is_generic_part(part)) continue;
        if (!telling.empty()) telling += '_';
        telling += part;
    }
    return safe_file_name(telling);
}

void make_unique(std::vector<std::string*> names) {
    std::set<std::string> taken;
    for (const std::string* name : names) taken.insert(lower_case(*name));
    std::set<std::string> seen;
    for (std::string* name : names) {
        if (seen.insert(lower_case(*name)).second) continue;
        const std::string base = *name;
        for (int n = 2;; ++n) {
            *name = base + "_" + std::to_string(n);
            if (taken.insert(lower_case(*name)).second) break;
        }
        seen.insert(lower_case(*name));
    }
}

}  // namespace surefoot
