#pragma once
// What a clip is called, in tables and as a file.

#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

/// The file name of `path` without folders and extension.
std::string file_stem(std::string_view path);

/// True for names that say nothing: empty, or what exporters write of their own accord ("mixamo.com", "Take 001",
/// "Animation", "Armature|mixamo.com|Layer0", "Scene").
bool is_generic_clip_name(std::string_view name);

/// A name that is a safe file name on every system: no separators, control characters or Windows device names, no
/// leading dot or blank, no trailing dot or blank, valid UTF-8, 1 to 80 bytes. A name with nothing left becomes "clip".
std::string safe_file_name(std::string_view name);

/// The clip's own name, or its file's stem where its own is generic; safe as a file name. A prefix that all exporters
/// repeat ("Armature|Walk" for Walk) is dropped.
std::string clip_name(std::string_view own_name, std::string_view file);

/// Makes names unique without regard to case: the second "walk" becomes "walk_2". Earlier names keep theirs.
void make_unique(std::vector<std::string*> names);

}  // namespace surefoot
