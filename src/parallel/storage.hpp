#pragma once
// Large arrays whose pages come from the system by all threads at once. A vector that grows by resize alone
// takes its pages one fault at a time on one thread, which costs more than the work on many of them.

#include <cstddef>
#include <vector>

namespace facetmill {

/// Bytes of a page of memory, as the system counts them.
std::size_t page_size() noexcept;

/// Lets the system give the memory in pages of 2 MiB where it is large: to get it and to give it back then
/// takes a fifth of the time that pages of 4 KiB take (Linux, transparent huge pages). operator new asks for
/// all that it gives.
void ask_for_large_pages(void* memory, std::size_t bytes) noexcept;

/// For the whole process, before it does anything: large arrays that were freed serve the next ones, and do
/// not go back to the system, which would clear their pages again (GNU's malloc; nothing elsewhere). Of
/// memory at the end of the heap 256 MiB at most are kept so.
void keep_freed_memory() noexcept;

/// All of it goes back now.
void give_back_freed_memory() noexcept;

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
