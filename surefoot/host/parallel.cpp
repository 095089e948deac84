#include <surefoot/host/parallel.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <memory>
#include <vector>

#ifndef __EMSCRIPTEN__
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#endif

namespace surefoot {

#ifndef __EMSCRIPTEN__
namespace {

std::unique_ptr<tbb::global_control> g_limit;

void limit_from_environment() {
    static const bool once = [] {
        const char* text = std::getenv("SUREFOOT_THREADS");
        const int threads = text ? std::atoi(text) : 0;
        if (threads > 0 && !g_limit) set_thread_count(threads);
        return true;
    }();
    (void)once;
}

}  // namespace

void set_thread_count(int threads) {
    g_limit.reset();
    if (threads > 0)
        g_limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                        static_cast<std::size_t>(std::min(threads, 256)));
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    limit_from_environment();
    std::vector<std::exception_ptr> errors(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        try {
            body(i);
        } catch (...) {
            errors[i] = std::current_exception();
        }
    });
    for (const auto& error : errors)
        if (error) std::rethrow_exception(error);
}
#else
void set_thread_count(int) {}
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    for (std::size_t i = 0; i < count; ++i) body(i);
}
#endif

}  // namespace surefoot
