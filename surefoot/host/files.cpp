#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <unistd.h>

namespace surefoot {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Removes the temporary file unless it was renamed away.
struct Temporary {
    fs::path path;
    ~Temporary() {
        std::error_code ignored;
        if (!path.empty()) fs::remove(path, ignored);
    }
};

}  // namespace

std::string read_file(const fs::path& path, std::size_t limit) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) throw Error("no such file", path.string(), "check the path");
    if (!fs::is_regular_file(status))
        throw Error("not a regular file", path.string(), "name a file, not a folder or device");
    const auto size = fs::file_size(path, code);
    if (code) throw Error("cannot be read: " + code.message(), path.string(), "check its permissions");
    if (size > limit)
        throw Error("the file is " + std::to_string(size >> 20) + " MiB; at most " + std::to_string(limit >> 20) +
                        " MiB are read",
                    path.string(), "split it");
    File file(std::fopen(path.c_str(), "rb"));
    if (!file)
        throw Error(std::string("cannot be opened: ") + std::strerror(errno), path.string(), "check its permissions");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    if (std::ferror(file.get())) throw Error("reading failed", path.string(), "check the disk");
    return bytes;
}

void write_file(const fs::path& path, std::string_view bytes) {
    std::error_code code;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), code);
    Temporary temporary{path.parent_path() /
                        ("." + path.filename().string() + "." + std::to_string(getpid()) + ".tmp")};
    const auto fail = [&](const std::string& why) {
        throw Error("cannot be written: " + why, path.string(),
                    "check that the folder exists, is writable and has space");
    };
    {
        File file(std::fopen(temporary.path.c_str(), "wb"));
        if (!file) {
            const std::string why = std::strerror(errno);
            temporary.path.clear();
            fail(why);
        }
        const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                             std::fflush(file.get()) == 0 && fsync(fileno(file.get())) == 0;
        const std::string why = std::strerror(errno);
        if (std::fclose(file.release()) != 0 || !written) fail(why);
    }
    fs::rename(temporary.path, path, code);
    if (code) fail(code.message());
    temporary.path.clear();
}

}  // namespace surefoot
