#pragma once
// Reads and writes bytes of open files. All calls restart after interruption by a signal.

#include "platform/descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace facetmill {

/// Reads available bytes, at most the size of the span; 0 at the end. None, with errno, on failure.
[[nodiscard]] std::optional<std::size_t> read_some(const Descriptor& file, std::span<std::byte> to);
/// Reads until the span is full, the file ends, or an error occurs; returns the number of bytes read.
[[nodiscard]] std::size_t read_whole(const Descriptor& file, std::span<std::byte> to);
/// Like read_some, from an offset.
[[nodiscard]] std::optional<std::size_t> read_some_at(const Descriptor& file, std::uint64_t offset,
                                                      std::span<std::byte> to);
/// Like read_whole, from an offset. May be called from any thread.
[[nodiscard]] std::size_t read_at(const Descriptor& file, std::uint64_t offset, std::span<std::byte> to);

/// Writes at least one byte; none, with errno, on failure.
[[nodiscard]] std::optional<std::size_t> write_some(const Descriptor& file, std::span<const std::byte> bytes);
/// Like write_some, at an offset.
[[nodiscard]] std::optional<std::size_t> write_some_at(const Descriptor& file, std::uint64_t offset,
                                                       std::span<const std::byte> bytes);
/// Writes all bytes at an offset; false, with errno, on failure. May be called from any thread.
bool write_at(const Descriptor& file, std::uint64_t offset, std::span<const std::byte> bytes);

/// Starts writing cached data of a file to disk, without waiting; only a hint.
void begin_sync(const Descriptor& file);
/// Waits until the bytes of a file, or the names in a folder, are on disk. False, with errno, on failure.
/// True if the file system does not support it.
bool synced(const Descriptor& file);

} // namespace facetmill
