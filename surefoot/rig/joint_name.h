#pragma once
// Joint names taken apart: side, number and stem, whatever the exporter's spelling.
//
//     "mixamorig:LeftUpLeg"  left   "upleg"        "DEF-f_index.02.R"  right  "findex"  "02"
//     "Bip01 L Finger12"     left   "finger" "12"  "thigh_twist_01_l"  left   "thightwist" "01"
//     "lfemur"               left   "femur"        "CC_Base_Head"      none   "head"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

enum class NameSide : std::uint8_t { none, left, right };

struct JointName {
    std::string stem;    ///< lower case, without namespace, rig prefix, side and digits
    std::string number;  ///< last group of digits that is not part of a rig prefix; may be empty
    NameSide side = NameSide::none;
};

/// Splits at separators, changes of case and digits; strips namespaces ("rig:") and known rig prefixes.
JointName parse_joint_name(std::string_view name);

/// For names that glue the side to the stem ("lfemur", "righthand"): tries `known` on what remains.
/// Leaves `name` alone where no such reading is known.
template <typename Known>
void split_glued_side(JointName& name, const Known& known) {
    if (name.side != NameSide::none || known(name.stem)) return;
    struct Affix {
        std::string_view text;
        NameSide side;
    };
    static constexpr Affix k_affixes[] = {
        {"left", NameSide::left}, {"right", NameSide::right}, {"l", NameSide::left}, {"r", NameSide::right}};
    for (const Affix& affix : k_affixes) {
        const std::size_t n = affix.text.size();
        if (name.stem.size() <= n) continue;
        const std::string_view stem = name.stem;
        std::string rest;
        if (stem.substr(0, n) == affix.text && known(std::string(stem.substr(n))))
            rest = stem.substr(n);
        else if (stem.substr(stem.size() - n) == affix.text && known(std::string(stem.substr(0, stem.size() - n))))
            rest = stem.substr(0, stem.size() - n);
        if (rest.empty()) continue;
        name.stem = rest;
        name.side = affix.side;
        return;
    }
}

}  // namespace surefoot
