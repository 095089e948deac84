// A crowd on all cores with std::thread: the library owns no threads, the host's own take ranges of the crowd. They
// wait for the next frame at a barrier, as making threads costs more than a frame of a small crowd does.

#include "crowd_world.h"
#include "read_pack.h"

#include <algorithm>
#include <barrier>
#include <functional>
#include <thread>

namespace {

/// Threads that stay. The caller is the last of them.
class Team {
  public:
    explicit Team(std::size_t size)
        : size_(size), begin_(static_cast<std::ptrdiff_t>(size)), end_(static_cast<std::ptrdiff_t>(size)) {
        for (std::size_t t = 0; t + 1 < size; ++t)
            threads_.emplace_back([this, t] {
                for (begin_.arrive_and_wait(); job_; begin_.arrive_and_wait()) {
                    job_(t);
                    end_.arrive_and_wait();
                }
            });
    }
    ~Team() {
        job_ = nullptr;
        begin_.arrive_and_wait();
        for (std::thread& one : threads_) one.join();
    }
    /// Returns when job(0) to job(size - 1) are done.
    void run(std::function<void(std::size_t)> job) {
        job_ = std::move(job);
        begin_.arrive_and_wait();
        job_(size_ - 1);
        end_.arrive_and_wait();
    }

  private:
    std::size_t size_;
    std::function<void(std::size_t)> job_;
    std::barrier<> begin_, end_;
    std::vector<std::thread> threads_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: crowd X.sfpack\n"), 2;
    const LoadedPack loaded = read_pack(argv[1]);
    const surefoot::LocomotionGraph& graph = loaded.pack.graph();
    const std::size_t threads = std::max(2u, std::thread::hardware_concurrency());
    std::vector<surefoot::CrowdScratch> scratch(threads, surefoot::CrowdScratch(graph));
    World alone(graph), shared(graph);
    const double alone_us = alone.play([&](const surefoot::Crowd& crowd) {
        surefoot::evaluate(graph, crowd, {0, k_crowd}, k_dt, scratch[0]);
    });
    Team team(threads);
    const double shared_us = shared.play([&](const surefoot::Crowd& crowd) {
        team.run([&](std::size_t t) {
            const std::size_t first = k_crowd * t / threads, end = k_crowd * (t + 1) / threads;
            surefoot::evaluate(graph, crowd, {first, end - first}, k_dt, scratch[t]);
        });
    });
    return compare(alone, alone_us, shared, shared_us, threads);
}
