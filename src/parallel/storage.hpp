#pragma once
// Large arrays whose pages come from the system by all threads at once. A vector that grows by resize alone
// takes its pages one fault at a time on one thread, which costs more than the work on many of them.

#include <cstddef>
#include <vector>

namespace facetmill {

/// Asks the system for the pages of the memory, in parallel, before it is written. Changes no contents; does
/// nothing where the system cannot.
void prefault(void* memory, std::size_t bytes);

/// v.reserve(n), the pages of what is not in use yet asked for in parallel.
template <class T>
void reserve_large(std::vector<T>& v, std::size_t n) {
    if (n <= v.size()) return;
    v.reserve(n);
    prefault(v.data() + v.size(), (n - v.size()) * sizeof(T));
}

/// v.resize(n), and v.resize(n, value), likewise.
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
