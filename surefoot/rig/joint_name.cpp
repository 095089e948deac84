#include <surefoot/rig/joint_name.h>

#include <algorithm>
#include <array>

namespace surefoot {

namespace {

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

// Words that name a rig, a tool or "this is a joint", never a body part.
constexpr std::array<std::string_view, 21> k_rig_words = {
    "mixamorig", "def", "bip",  "cc", "base",  "rl",    "skeleton", "armature",  "jnt",   "joint", "joints",
    "bone",      "j",   "bind", "jt", "valve", "biped", "rig",      "character", "human", "c"};

bool is_rig_word(std::string_view word) {
    return std::find(k_rig_words.begin(), k_rig_words.end(), word) != k_rig_words.end();
}

NameSide side_of(std::string_view word) {
    if (word == "l" || word == "left" || word == "lft") return NameSide::left;
    if (word == "r" || word == "right" || word == "rgt") return NameSide::right;
    return NameSide::none;
}

// "LeftUpLeg" -> left up leg; "LHipJoint" -> l hip joint; "Finger01" -> finger 01.
std::vector<std::string> split_words(std::string_view name) {
    std::vector<std::string> words;
    std::string word;
    const auto finish = [&] {
        if (!word.empty()) words.push_back(std::move(word));
        word.clear();
    };
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        if (!is_upper(c) && !is_lower(c) && !is_digit(c)) {
            finish();
            continue;
        }
        const char before = i > 0 ? name[i - 1] : ' ';
        const bool digit_edge = !word.empty() && is_digit(c) != is_digit(before);
        const bool rising = is_upper(c) && is_lower(before);
        const bool acronym_ends = is_upper(c) && is_upper(before) && i + 1 < name.size() && is_lower(name[i + 1]);
        if (digit_edge || rising || acronym_ends) finish();
        word += lower(c);
    }
    finish();
    return words;
}

}  // namespace

JointName parse_joint_name(std::string_view name) {
    const std::size_t colon = name.find_last_of(":|");
    if (colon != std::string_view::npos && colon + 1 < name.size()) name = name.substr(colon + 1);
    JointName result;
    bool after_rig_word = false;
    for (const std::string& word : split_words(name)) {
        if (is_digit(word[0])) {
            // "Bip01", "mixamorig1": the number belongs to the prefix as long as no body part was named.
            if (!(after_rig_word && result.stem.empty())) result.number = word;
        } else if (const NameSide side = side_of(word); side != NameSide::none && result.side == NameSide::none) {
            result.side = side;
        } else if (is_rig_word(word)) {
            after_rig_word = true;
            // "base" is a body word after "toe" or "spine": "toebase", "spinebase".
            if (word == "base" && !result.stem.empty()) result.stem += word;
            // "hipjoint" is CMU's strut from the root to the femur, not a hip.
            if (word == "joint" && (result.stem == "hip")) result.stem += word;
        } else {
            result.stem += word;
        }
    }
    return result;
}

}  // namespace surefoot
