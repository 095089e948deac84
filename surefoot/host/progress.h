#pragma once
// A progress bar on standard error, only where that is a terminal; silent in a pipe. A host without a terminal watches
// instead.

#include <atomic>
#include <cstddef>
#include <mutex>
#include <string>

namespace surefoot {

/// Told of each step that is done, from whichever thread did it.
using ProgressWatch = void (*)(const std::string& label, std::size_t done, std::size_t total);
/// From now on `watch` is told of all progress (null: nobody is). Not to be called while something progresses.
void watch_progress(ProgressWatch watch) noexcept;

class Progress {
  public:
    /// `label` is shown before the bar; `total` is the number of steps.
    Progress(std::string label, std::size_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// One step is done. Safe from several threads.
    void advance();

  private:
    void draw(std::size_t done);

    std::string label_;
    std::size_t total_;
    std::atomic<std::size_t> done_{0};
    std::mutex drawing_;
    bool terminal_;
};

}  // namespace surefoot
