#pragma once
// Joints must be told apart by name; files do not always see to it.

#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

/// Gives joints without a name one ("joint_7"), and those whose name is taken another ("arm_2"); earlier joints keep
/// theirs. Says so in `warnings`.
void make_joint_names_unique(std::vector<std::string>& names, std::vector<std::string>& warnings);

/// What to show of a word from a file in a message: quoted, short, and nothing that a terminal would obey.
std::string shown(std::string_view word);

}  // namespace surefoot
