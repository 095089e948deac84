#pragma once
// The tools' only door to threads: oneTBB natively, serial in the browser. The runtime library never owns threads.

#include <cstddef>
#include <functional>

namespace surefoot {

/// Calls body(0) … body(count - 1), on several threads at once where there are any. Store results by index: then output
/// does not depend on the thread count. The first exception (by index) is thrown again once all have ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Upper bound for the threads of this process; 0 means one a core (also settable by the environment variable
/// SUREFOOT_THREADS, read at first use).
void set_thread_count(int threads);

}  // namespace surefoot
