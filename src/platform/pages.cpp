#include "platform/pages.hpp"

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

void ask_for_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
    constexpr std::size_t least = std::size_t{2} << 20; // smaller memory contains no page of 2 MiB
    if (bytes < least) return;
    const std::size_t page = page_size();
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = start / page * page, end = (start + bytes + page - 1) / page * page;
    // A kernel without large pages refuses this, and pages stay small.
    const int error = errno;
    (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
    errno = error;
#endif
}

void populate_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_POPULATE_WRITE
    // An old kernel or a limit may refuse this, and pages are then allocated one by one.
    (void)madvise(memory, bytes, MADV_POPULATE_WRITE);
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

std::shared_ptr<const void> map_file(const Descriptor& file, std::size_t bytes) {
    void* at = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, file.number(), 0);
    if (at == MAP_FAILED) return nullptr;
    ::madvise(at, bytes, MADV_SEQUENTIAL);
    return {at, [bytes](const void* p) { ::munmap(const_cast<void*>(p), bytes); }};
}

void release_pages(std::span<const std::byte> part) noexcept {
    const std::size_t page = page_size();
    const auto first = (reinterpret_cast<std::uintptr_t>(part.data()) + page - 1) / page * page,
               last = reinterpret_cast<std::uintptr_t>(part.data() + part.size()) / page * page;
    if (first < last) (void)::madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
}

} // namespace facetmill
