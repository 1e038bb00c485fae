#pragma once
// Memory as the system gives it: in pages, and files that are mapped to them.

#include "platform/descriptor.hpp"

#include <cstddef>
#include <memory>
#include <span>

namespace facetmill {

/// Bytes of a page of memory, as the system counts them.
std::size_t page_size() noexcept;

/// Lets the system give the memory in pages of 2 MiB where it is large: to get it and to give it back then
/// takes a fifth of the time that pages of 4 KiB take (Linux, transparent huge pages). operator new asks for
/// all that it gives.
void ask_for_large_pages(void* memory, std::size_t bytes) noexcept;

/// Asks for pages that will be written, all at once. memory: the beginning of a page. Changes no contents;
/// does nothing where the system cannot.
void populate_pages(void* memory, std::size_t bytes) noexcept;

/// For the whole process, before it does anything: large arrays that were freed serve the next ones, and do
/// not go back to the system, which would clear their pages again (GNU's malloc; nothing elsewhere). Of
/// memory at the end of the heap 256 MiB at most are kept so.
void keep_freed_memory() noexcept;

/// All of it goes back now.
void give_back_freed_memory() noexcept;

/// The bytes of a file, to be read from the first to the last. Null when it cannot be mapped.
std::shared_ptr<const void> map_file(const Descriptor& file, std::size_t bytes);

/// Gives back the whole pages of a part of a mapped file. Who reads them again gets them from the file again.
void release_pages(std::span<const std::byte> part) noexcept;

} // namespace facetmill
