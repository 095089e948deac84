#pragma once
// Files as the tools touch them: read whole with a limit, written to a temporary file beside the target and renamed, so
// that a failure never leaves half a file.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace surefoot {

inline constexpr std::size_t k_max_file_bytes = std::size_t{2} << 30;

/// The whole file. Throws Error where it is missing, not a regular file, unreadable, or larger than `limit`.
std::string read_file(const std::filesystem::path& path, std::size_t limit = k_max_file_bytes);

enum class Durability {
    on_disk,     ///< when write_file returns, the bytes outlive a power cut
    may_be_lost  ///< for what can be made again: much quicker
};

/// Replaces `path` by `bytes` in one step, making its folder where needed. Throws Error (folder not writable, disk
/// full) and then leaves what was there before. What is no regular file (/dev/stdout, a pipe) is written to directly.
void write_file(const std::filesystem::path& path, std::string_view bytes, Durability durability = Durability::on_disk);

/// The same, but a file that holds these bytes already is left alone, its time of change included.
void update_file(const std::filesystem::path& path, std::string_view bytes);

/// Tells this build of the running program from any other (size and time of its executable); empty where that cannot
/// be told.
std::string program_stamp();

/// For programs: lets an interrupt, hang-up or termination take away the temporary files of writing, then end the
/// program as it would have. Signals that the caller was told to ignore stay ignored.
void remove_temporaries_on_signals();

}  // namespace surefoot
