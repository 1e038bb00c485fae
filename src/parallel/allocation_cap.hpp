#pragma once
// A limit on single memory requests, for libraries that allocate sizes from a file before they check the
// file's length.

#include <cstddef>

namespace facetmill {

/// While it lives, no request of this thread to operator new may be for more bytes: it throws std::bad_alloc.
/// The innermost counts.
class AllocationCap {
  public:
    explicit AllocationCap(std::size_t bytes);
    ~AllocationCap();
    AllocationCap(const AllocationCap&) = delete;
    AllocationCap& operator=(const AllocationCap&) = delete;

  private:
    std::size_t outer_;
};

/// How many requests this thread has made to operator new: work that tests can count.
[[nodiscard]] std::size_t allocations_of_thread();

} // namespace facetmill
