#pragma once
// What the gates look at: the source tree under a root folder (ours, or one of tests/gates/bad_trees). Each check
// returns one sentence a breach, with file and line, and an empty list for a sound tree.

#include <filesystem>
#include <string>
#include <vector>

namespace surefoot::gates {

/// A room as surefoot/CMakeLists.txt declares it, in its order: a room may lean only on rooms above it.
struct Room {
    std::string name;
    bool runtime = false;
    std::vector<std::string> depends;
};
std::vector<Room> rooms_of(const std::filesystem::path& root);

/// Include graph: no include of a room below, none of an authoring room or of anything but a short list of standard
/// headers in a runtime room, no third party in a public header, no cycle between files, no way around the gate.
std::vector<std::string> layering_breaches(const std::filesystem::path& root);

/// Types of one name in one namespace that two files define, unnamed namespaces left out. What the compiler makes of
/// them by itself (copies, `std::vector` of one) then has one symbol, and the linker keeps either: undefined behaviour.
std::vector<std::string> doubled_types(const std::filesystem::path& root);

/// Calls of libm's transcendental functions under surefoot/ (ours are in math/trig.h): they differ between systems.
std::vector<std::string> libm_calls(const std::filesystem::path& root);

/// libm's transcendental functions among the undefined symbols that `nm` prints for a library.
std::vector<std::string> libm_symbols(const std::string& nm_output);

/// Headers under surefoot/ that do not compile alone, one text each with the compiler's first error.
std::vector<std::string> dependent_headers(const std::filesystem::path& root, const std::string& compiler,
                                           const std::filesystem::path& scratch);

/// Standard output and error of a shell command.
struct CommandResult {
    int status = 0;
    std::string output;
};
CommandResult run(const std::string& command);

}  // namespace surefoot::gates
