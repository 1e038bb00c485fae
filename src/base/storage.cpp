#include "base/storage.hpp"

#include "base/parallel.hpp"

#include <cstdint>
#include <sys/mman.h>
#include <unistd.h>

namespace facetmill {

void prefault(void* memory, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
    constexpr std::size_t piece = std::size_t{1} << 20;
    if (bytes < piece) return;
    static const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (start + page - 1) / page * page, end = (start + bytes) / page * page;
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
