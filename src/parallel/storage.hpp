#pragma once
// Allocates pages of large arrays on all threads at once. With a plain resize, a single thread would take
// page fault after page fault, which often takes longer than the work on the array.

#include <cstddef>
#include <vector>

namespace facetmill {

/// Requests the pages of the memory from the system, in parallel, before it is written. Does not change
/// contents, and does nothing if the system does not support it.
void prefault(void* memory, std::size_t bytes);

/// v.reserve(n), with the unused pages requested in parallel.
template <class T>
void reserve_large(std::vector<T>& v, std::size_t n) {
    if (n <= v.size()) return;
    v.reserve(n);
    prefault(v.data() + v.size(), (n - v.size()) * sizeof(T));
}

/// v.resize(n) and v.resize(n, value), with new pages requested in parallel.
template <class T>
void resize_large(std::vector<T>& v, std::size_t n) {
    reserve_large(v, n);
    v.resize(n);
}
template <class T>
void resize_large(std::vector<T>& v, std::size_t n, const T& value) {
    reserve_large(v, n);
    v.resize(n, value);
}

} // namespace facetmill
