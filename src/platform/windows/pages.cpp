#include "platform/pages.hpp"

#include "platform/windows/handle.hpp"

#include <cstdint>

namespace facetmill {

std::size_t page_size() noexcept {
    static const std::size_t size = [] {
        SYSTEM_INFO about{};
        ::GetSystemInfo(&about);
        return std::size_t{about.dwPageSize};
    }();
    return size;
}

/// Large pages need a right of the user, and cannot be paged out.
void ask_for_large_pages(void*, std::size_t) noexcept {}

void populate_pages(void*, std::size_t) noexcept {}

void keep_freed_memory() noexcept {}

void give_back_freed_memory() noexcept { ::HeapCompact(::GetProcessHeap(), 0); }

std::shared_ptr<const void> map_file(const Descriptor& file, std::size_t bytes) {
    const HANDLE mapping = ::CreateFileMappingW(handle_of(file), nullptr, PAGE_READONLY, 0, 0, nullptr);
    if (!mapping) return nullptr;
    const void* at = ::MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, bytes);
    ::CloseHandle(mapping); // the view keeps the mapping
    if (!at) return nullptr;
    return {at, [](const void* view) { ::UnmapViewOfFile(view); }};
}

void release_pages(std::span<const std::byte> part) noexcept {
    const std::size_t page = page_size();
    const auto first = (reinterpret_cast<std::uintptr_t>(part.data()) + page - 1) / page * page,
               last = reinterpret_cast<std::uintptr_t>(part.data() + part.size()) / page * page;
    // Unlocking pages that are not locked removes them from the working set.
    if (first < last) ::VirtualUnlock(reinterpret_cast<void*>(first), last - first);
}

} // namespace facetmill
