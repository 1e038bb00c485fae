#pragma once
// Stands in for TBB in the `tsan` build. ThreadSanitizer sees only synchronisation that it was compiled into,
// and the packaged libtbb was not, so that the end of every loop would look like a race. Here a loop starts
// threads and joins them, which it understands. What one iteration does is ordered after another only by the
// thread that ran both: neighbours always run on different threads, so a race between chunks shows in one
// run, whatever the load.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <tbb/global_control.h>
#include <thread>
#include <vector>

namespace tbb {

struct simple_partitioner {};

/// A loop here is never cancelled by another, so there is nothing to isolate.
class task_group_context {
  public:
    enum kind_type { bound, isolated };

    explicit task_group_context(kind_type = bound) {}
};

template <class Body>
void parallel_for(std::size_t begin, std::size_t end, const Body& body, simple_partitioner = {}) {
    const std::size_t stride = std::min(global_control::allowed(), end - begin);
    std::exception_ptr failure;
    std::mutex guard;
    const auto work = [&](std::size_t first) {
        try {
            for (std::size_t i = first; i < end; i += stride) body(i);
        } catch (...) {
            const std::lock_guard lock(guard);
            if (!failure) failure = std::current_exception();
        }
    };
    std::vector<std::thread> others;
    for (std::size_t t = 1; t < stride; ++t) others.emplace_back(work, begin + t);
    if (stride > 0) work(begin);
    for (std::thread& other : others) other.join();
    if (failure) std::rethrow_exception(failure);
}

template <class Body>
void parallel_for(std::size_t begin, std::size_t end, const Body& body, simple_partitioner parts,
                  task_group_context&) {
    parallel_for(begin, end, body, parts);
}

} // namespace tbb
