#pragma once
// Memory pages of the system, and files mapped to them.

#include "platform/descriptor.hpp"

#include <cstddef>
#include <memory>
#include <span>

namespace facetmill {

/// The system's page size in bytes.
[[nodiscard]] std::size_t page_size() noexcept;

/// Lets the system use pages of 2 MiB for large memory: allocating and freeing then takes a fifth of the time
/// of 4 KiB pages (Linux, transparent huge pages). operator new calls it for all its memory.
void ask_for_large_pages(void* memory, std::size_t bytes) noexcept;

/// Allocates pages that will be written, all at once. memory: the beginning of a page. Does not change
/// contents; does nothing if the system does not support it.
void populate_pages(void* memory, std::size_t bytes) noexcept;

/// Makes the process reuse the memory of large freed arrays instead of returning it to the system, which
/// would have to clear the pages again. Keeps at most 256 MiB at the end of the heap. Only for GNU malloc.
/// Call it before any other work.
void keep_freed_memory() noexcept;

/// Returns all freed memory to the system now.
void give_back_freed_memory() noexcept;

/// Maps the bytes of a file for sequential reading. Null if it cannot be mapped.
[[nodiscard]] std::shared_ptr<const void> map_file(const Descriptor& file, std::size_t bytes);

/// Releases the whole pages of a part of a mapped file. Reading them again loads them from the file.
void release_pages(std::span<const std::byte> part) noexcept;

} // namespace facetmill
