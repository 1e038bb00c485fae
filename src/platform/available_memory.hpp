#pragma once
// Available memory, and memory used by this process.

#include <cstddef>
#include <cstdint>
#include <optional>

namespace facetmill {

/// The bytes that this process may still take: the least of the machine's available memory, and what the
/// cgroup (v1 and v2) and RLIMIT_AS leave. None if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> available_memory();

/// Bytes of physical memory in use by this process; 0 if unknown.
[[nodiscard]] std::uint64_t resident_memory();
/// The maximum of that so far, in bytes.
[[nodiscard]] std::size_t peak_memory();

} // namespace facetmill
