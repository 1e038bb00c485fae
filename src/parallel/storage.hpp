#pragma once
// Large arrays whose pages come from the system by all threads at once. A vector that grows by resize alone
// takes its pages one fault at a time on one thread, which costs more than the work on many of them.

#include <cstddef>
#include <vector>

namespace facetmill {

/// Bytes of a page of memory, as the system counts them.
std::size_t page_size() noexcept;

/// Lets the system use pages of 2 MiB for large memory. Allocating and freeing it then takes a fifth of the
/// time for pages of 4 KiB (Linux, transparent huge pages). operator new calls it for all its memory.
void ask_for_large_pages(void* memory, std::size_t bytes) noexcept;

/// For the whole process; call it at the start. Freed large arrays are reused and do not return to the
/// system, which would clear their pages again (GNU's malloc; no effect elsewhere). At most 256 MiB at the
/// end of the heap are kept.
void keep_freed_memory() noexcept;

/// All of it goes back now.
void give_back_freed_memory() noexcept;

/// Asks the system for the pages of the memory, in parallel, before it is written. Changes no contents; does
/// nothing where the system cannot.
void prefault(void* memory, std::size_t bytes);

/// v.reserve(n), and requests the unused pages in parallel.
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
