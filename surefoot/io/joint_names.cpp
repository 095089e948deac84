#include <surefoot/io/joint_names.h>

#include <set>

namespace surefoot {

std::string shown(std::string_view word) {
    constexpr std::size_t k_longest = 40;
    std::string text(word.substr(0, k_longest));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return "'" + text + (word.size() > k_longest ? "…'" : "'");
}

void make_joint_names_unique(std::vector<std::string>& names, std::vector<std::string>& warnings) {
    std::set<std::string> taken(names.begin(), names.end());
    std::set<std::string> seen;
    for (std::size_t j = 0; j < names.size(); ++j) {
        std::string& name = names[j];
        if (!name.empty() && seen.insert(name).second) continue;
        const std::string old = name, base = old.empty() ? "joint_" + std::to_string(j) : old;
        name = base;
        for (int n = 2; taken.count(name) > 0; ++n) name = base + "_" + std::to_string(n);
        taken.insert(name);
        seen.insert(name);
        warnings.push_back(old.empty()
                               ? "joint " + std::to_string(j) + " has no name: called " + shown(name)
                               : "two joints are named " + shown(old) + ": the second is called " + shown(name));
    }
}

}  // namespace surefoot
