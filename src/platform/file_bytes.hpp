#pragma once
// Bytes of open files. All calls begin again when a signal interrupts them.

#include "platform/descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace facetmill {

/// Reads what is there, at most as much as fits; 0 at the end. None, with errno, when it cannot be read.
std::optional<std::size_t> read_some(const Descriptor& file, std::span<std::byte> to);
/// Reads until all is filled, or the file ends or cannot be read; returns how many bytes it got.
std::size_t read_whole(const Descriptor& file, std::span<std::byte> to);
/// The same from that byte on. Any thread.
std::size_t read_at(const Descriptor& file, std::uint64_t offset, std::span<std::byte> to);

/// Writes at least one byte, or says by none and errno why not.
std::optional<std::size_t> write_some(const Descriptor& file, std::span<const std::byte> bytes);
/// Writes all from that byte on; false, with errno, when it cannot. Any thread.
bool write_at(const Descriptor& file, std::uint64_t offset, std::span<const std::byte> bytes);

/// Begins to write what the system keeps of a file, without waiting; a hint.
void begin_sync(const Descriptor& file);
/// Waits until the bytes of a file, or the names in a folder, are on the disk. False, with errno, when they
/// cannot get there. True where a file system has no such call.
bool synced(const Descriptor& file);

} // namespace facetmill
