#pragma once
// Characters as the command line names them.

#include <surefoot/author/retarget_clips.h>

#include <string>
#include <vector>

namespace surefoot::cli {

/// The character of a file (FILE or FILE#NAME, with or without animation), or of a bundled template (`surefoot rig
/// list`); "default" is the adult. Throws Error.
Actor read_actor(const std::string& name, const RoleOverrides& overrides = {});

/// Role overrides as "left_foot=Foot_L"; `option` is named where one is no such thing. Throws Error.
RoleOverrides parse_roles(const std::vector<std::string>& given, const char* option);

}  // namespace surefoot::cli
