#pragma once
// A limit on single requests for memory, for libraries that take what a file asks for before they look
// whether the file holds as much.

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
std::size_t allocations_of_thread();

} // namespace facetmill
