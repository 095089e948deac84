#pragma once
// A progress bar on standard error, only where that is a terminal; silent in a pipe.

#include <atomic>
#include <cstddef>
#include <mutex>
#include <string>

namespace surefoot {

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
