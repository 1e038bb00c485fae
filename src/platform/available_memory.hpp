#pragma once
// Available memory, and memory used by this process.

#include <cstddef>
#include <cstdint>
#include <optional>

namespace facetmill {

/// The least of the memory that the machine has available, the cgroup allows (v1 and v2), and RLIMIT_AS
/// allows. None if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> available_memory();

/// Physical memory in use by this process.
[[nodiscard]] std::uint64_t resident_memory();
/// The maximum so far.
[[nodiscard]] std::size_t peak_memory();

} // namespace facetmill
