#include "parallel/storage.hpp"

#include "parallel/parallel.hpp"

#include <cerrno>
#include <cstdint>
#include <sys/mman.h>
#include <unistd.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace facetmill {

std::size_t page_size() noexcept {
    static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return size;
}

void ask_for_large_pages(void* memory, std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
    constexpr std::size_t least = std::size_t{2} << 20; // less holds no page of 2 MiB
    if (bytes < least) return;
    const std::size_t page = page_size();
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = start / page * page, end = (start + bytes + page - 1) / page * page;
    // Refused (a kernel without them): the pages are small, as they would have been.
    const int error = errno;
    (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
    errno = error;
#else
    (void)memory;
    (void)bytes;
#endif
}

void keep_freed_memory() noexcept {
#if defined(__GLIBC__)
    mallopt(M_MMAP_THRESHOLD, 1 << 30); // larger blocks get their own mapping
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

void give_back_freed_memory() noexcept {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

void prefault(void* memory, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
    constexpr std::size_t piece = std::size_t{2} << 20; // a large page
    if (bytes < piece) return;
    const std::size_t page = page_size();
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = start / page * page, end = (start + bytes) / page * page;
    parallel_chunks(
        end - begin,
        [&](std::size_t first, std::size_t last) {
            // Refused (an old kernel, a limit): the pages come one by one, as they would have.
            (void)madvise(reinterpret_cast<void*>(begin + first), last - first, MADV_POPULATE_WRITE);
        },
        piece);
#else
    (void)memory;
    (void)bytes;
#endif
}

} // namespace facetmill
