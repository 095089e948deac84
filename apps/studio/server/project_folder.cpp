#include "project_folder.h"

#include <surefoot/base/error.h>

#include <algorithm>
#include <system_error>

namespace surefoot::studio {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t k_most_files = 10000;

bool is_plain(std::string_view part) {
    const auto odd = [](char c) { return c == '\\' || c == ':' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    return !part.empty() && part.front() != '.' && std::none_of(part.begin(), part.end(), odd);
}

bool is_below(const fs::path& path, const fs::path& folder) {
    const auto end = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end.first == folder.end() && end.second != path.end();
}

}  // namespace

ProjectFolder::ProjectFolder(const fs::path& folder) {
    std::error_code error;
    folder_ = fs::canonical(folder, error);
    if (error || !fs::is_directory(folder_, error))
        throw Error("this is no folder", folder.string(), "name one that 'surefoot author' wrote, or an empty one");
}

std::optional<fs::path> ProjectFolder::inside(std::string_view relative) const {
    for (std::size_t at = 0; at <= relative.size();) {
        const std::size_t end = std::min(relative.find('/', at), relative.size());
        if (!is_plain(relative.substr(at, end - at))) return {};
        at = end + 1;
    }
    std::error_code error;
    const fs::path path = fs::weakly_canonical(folder_ / fs::path(relative), error);
    if (error || !is_below(path, folder_)) return {};
    // A link whose end is not there yet is not resolved by that: whoever wrote to it would write outside.
    for (fs::path part = path; part != folder_; part = part.parent_path())
        if (fs::is_symlink(fs::symlink_status(part, error))) return {};
    return path;
}

std::vector<FolderFile> ProjectFolder::list() const {
    std::vector<FolderFile> files;
    std::error_code error;
    fs::recursive_directory_iterator each(folder_, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && each != end && files.size() < k_most_files; each.increment(error)) {
        std::error_code ignored;
        const bool hidden = each->path().filename().string().front() == '.';
        if (hidden && each->is_directory(ignored)) each.disable_recursion_pending();
        if (hidden || !each->is_regular_file(ignored)) continue;
        const std::string relative = each->path().lexically_relative(folder_).generic_string();
        if (!inside(relative)) continue;
        const auto changed = each->last_write_time(ignored).time_since_epoch();
        files.push_back({relative, each->file_size(ignored),
                         std::chrono::duration_cast<std::chrono::nanoseconds>(changed).count()});
    }
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    return files;
}

}  // namespace surefoot::studio
