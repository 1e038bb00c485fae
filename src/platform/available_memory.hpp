#pragma once
// Available memory, and memory used by this process.

#include <cstddef>
#include <cstdint>
#include <optional>

namespace facetmill {

/// The bytes that this process may still allocate: the minimum of the machine's available memory and the
/// remainders of the cgroup (v1 and v2) and RLIMIT_AS. None if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> available_memory();

/// Bytes of physical memory in use by this process; 0 if unknown.
[[nodiscard]] std::uint64_t resident_memory();
/// The maximum of resident_memory() so far, in bytes.
[[nodiscard]] std::size_t peak_memory();

} // namespace facetmill
