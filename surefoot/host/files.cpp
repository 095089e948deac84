#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>

#include <sys/stat.h>
#include <unistd.h>

namespace surefoot {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Temporary files that exist now, where a signal handler can find them: no lock, no allocation.
struct Slot {
    std::atomic<int> state{0};  // free, being filled, holds a path
    char path[4096] = {};
};
constexpr int k_free = 0, k_filling = 1, k_held = 2;
constinit Slot g_slots[64];  // files written at the same time; any more are written without this care

Slot* hold(const std::string& path) noexcept {
    if (path.size() >= sizeof(Slot::path)) return nullptr;
    for (Slot& slot : g_slots) {
        int expected = k_free;
        if (!slot.state.compare_exchange_strong(expected, k_filling)) continue;
        std::memcpy(slot.path, path.c_str(), path.size() + 1);
        slot.state = k_held;
        return &slot;
    }
    return nullptr;
}

extern "C" void remove_held_and_die(int signal_number) {
    for (Slot& slot : g_slots)
        if (slot.state == k_held) unlink(slot.path);
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
}

/// Removes the temporary file unless it was renamed away.
class Temporary {
  public:
    explicit Temporary(fs::path file) : path(std::move(file)), slot_(hold(path.string())) {}
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        std::error_code ignored;
        if (!path.empty()) fs::remove(path, ignored);
        if (slot_) slot_->state = k_free;
    }
    fs::path path;

  private:
    Slot* slot_;
};

/// Writes all of it; false with errno set where that fails.
bool write_all(const File& file, std::string_view bytes) {
    return std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() && std::fflush(file.get()) == 0;
}

/// Short enough for any file system whatever the target is called.
std::string temporary_name() {
    static std::atomic<unsigned> count{0};
    return ".surefoot-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ".tmp";
}

}  // namespace

std::string read_file(const fs::path& path, std::size_t limit) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) throw Error("no such file", path.string(), "check the path");
    if (!fs::is_regular_file(status))
        throw Error("not a regular file", path.string(), "name a file, not a folder or device");
    File file(std::fopen(path.c_str(), "rb"));
    if (!file)
        throw Error(std::string("cannot be opened: ") + std::strerror(errno), path.string(), "check its permissions");
    // Of what was opened: another file may stand under this name by now.
    struct stat opened {};
    if (fstat(fileno(file.get()), &opened) != 0)
        throw Error(std::string("cannot be read: ") + std::strerror(errno), path.string(), "check its permissions");
    const auto size = static_cast<std::size_t>(opened.st_size);
    if (size > limit)
        throw Error("the file is " + std::to_string(size >> 20) + " MiB; at most " + std::to_string(limit >> 20) +
                        " MiB are read",
                    path.string(), "split it");
    std::string bytes(size, '\0');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    if (std::ferror(file.get())) throw Error("reading failed", path.string(), "check the disk");
    return bytes;
}

void write_file(const fs::path& path, std::string_view bytes, Durability durability) {
    std::error_code code;
    const auto fail = [&](const std::string& why) {
        throw Error("cannot be written: " + why, path.string(),
                    "check that the folder exists, is writable and has space");
    };
    const fs::file_status status = fs::status(path, code);
    if (fs::is_directory(status)) fail("it is a folder");
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        File file(std::fopen(path.c_str(), "wb"));
        if (!file || !write_all(file, bytes) || std::fclose(file.release()) != 0) fail(std::strerror(errno));
        return;
    }
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), code);
    Temporary temporary(path.parent_path() / temporary_name());
    {
        File file(std::fopen(temporary.path.c_str(), "wb"));
        if (!file) {
            const std::string why = std::strerror(errno);
            temporary.path.clear();
            fail(why);
        }
        const bool written =
            write_all(file, bytes) && (durability == Durability::may_be_lost || fsync(fileno(file.get())) == 0);
        const std::string why = std::strerror(errno);
        if (std::fclose(file.release()) != 0 || !written) fail(why);
    }
    fs::rename(temporary.path, path, code);
    if (code) fail(code.message());
    temporary.path.clear();
}

void update_file(const fs::path& path, std::string_view bytes) {
    std::error_code code;
    if (fs::is_regular_file(path, code) && fs::file_size(path, code) == bytes.size() && !code) try {
            if (read_file(path) == bytes) return;
        } catch (const Error&) {
            // Writing will say what is wrong, if anything is.
        }
    write_file(path, bytes);
}

std::string program_stamp() {
    struct stat status {};
    if (stat("/proc/self/exe", &status) != 0) return {};
    return std::to_string(status.st_size) + "." + std::to_string(status.st_mtim.tv_sec) + "." +
           std::to_string(status.st_mtim.tv_nsec);
}

void remove_temporaries_on_signals() {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(number, nullptr, &before);
        if (before.sa_handler == SIG_DFL) std::signal(number, remove_held_and_die);
    }
}

}  // namespace surefoot
