#include "parallel/storage.hpp"

#include "parallel/parallel.hpp"
#include "platform/pages.hpp"

#include <cstdint>

namespace facetmill {

void prefault(void* memory, std::size_t bytes) {
    constexpr std::size_t piece = std::size_t{2} << 20; // size of a large page
    if (bytes < piece) return;
    const std::size_t page = page_size();
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = start / page * page, end = (start + bytes) / page * page;
    parallel_chunks(
        end - begin,
        [&](std::size_t first, std::size_t last) {
            populate_pages(reinterpret_cast<void*>(begin + first), last - first);
        },
        piece);
}

} // namespace facetmill
