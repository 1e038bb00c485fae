#pragma once
// A limit on single memory requests, for libraries that allocate sizes from a file before they check the
// file's length.

#include <cstddef>

namespace facetmill {

/// During its lifetime, a request of this thread to operator new for more bytes throws std::bad_alloc. The
/// innermost cap applies.
class AllocationCap {
  public:
    explicit AllocationCap(std::size_t bytes);
    ~AllocationCap();
    AllocationCap(const AllocationCap&) = delete;
    AllocationCap& operator=(const AllocationCap&) = delete;

  private:
    std::size_t outer_;
};

/// The number of requests of this thread to operator new, so that tests can count work.
[[nodiscard]] std::size_t allocations_of_thread();

} // namespace facetmill
