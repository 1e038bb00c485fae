#pragma once
// See parallel_for.h.

#include <atomic>
#include <cstddef>
#include <tbb/info.h>

namespace tbb {

/// The last one made holds.
class global_control {
  public:
    enum Parameter { max_allowed_parallelism };

    global_control(Parameter, std::size_t count) { limit = count; }

    static std::size_t allowed() { return limit.load(std::memory_order_relaxed); }

  private:
    inline static std::atomic<std::size_t> limit = static_cast<std::size_t>(info::default_concurrency());
};

} // namespace tbb
