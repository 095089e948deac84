#pragma once
// A folder that a page may read and write: nothing outside of it, whatever a request says.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::studio {

struct FolderFile {
    std::string path;  ///< relative, parts joined by /
    std::uintmax_t bytes = 0;
    std::int64_t changed_ns = 0;  ///< of the file's clock: another number is another state
};

class ProjectFolder {
  public:
    /// Throws Error where `folder` is no folder.
    explicit ProjectFolder(const std::filesystem::path& folder);

    const std::filesystem::path& folder() const noexcept { return folder_; }

    /// Files in the folder and below, sorted by path; those whose name begins with a dot, and links that lead out of
    /// it, are left out. [Limit: the first 10,000]
    std::vector<FolderFile> list() const;

    /// Where a relative path leads: a place inside the folder, links resolved, that may not be there yet. Nothing where
    /// it leads out of it, or names a part that begins with a dot, is empty, or has a backslash, colon or control
    /// character.
    std::optional<std::filesystem::path> inside(std::string_view relative) const;

  private:
    std::filesystem::path folder_;  ///< canonical
};

}  // namespace surefoot::studio
