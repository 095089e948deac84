#include <surefoot/host/progress.h>

#include <cstdio>

#include <unistd.h>

namespace surefoot {
namespace {

ProgressWatch g_watch = nullptr;

}  // namespace

void watch_progress(ProgressWatch watch) noexcept { g_watch = watch; }

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)), total_(total), terminal_(total > 1 && isatty(STDERR_FILENO)) {
    if (terminal_) draw(0);
    if (g_watch) g_watch(label_, 0, total_);
}

Progress::~Progress() {
    if (terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::advance() {
    const std::size_t done = ++done_;
    if (g_watch) g_watch(label_, done, total_);
    if (!terminal_) return;
    const std::lock_guard lock(drawing_);
    draw(done);
}

void Progress::draw(std::size_t done) {
    constexpr std::size_t k_width = 30;
    const std::size_t filled = k_width * done / total_;
    const std::string bar = std::string(filled, '#') + std::string(k_width - filled, '.');
    std::fprintf(stderr, "\r%s [%s] %zu/%zu", label_.c_str(), bar.c_str(), done, total_);
    std::fflush(stderr);
}

}  // namespace surefoot
