#pragma once
// How much memory there is, and how much this process has.

#include <cstddef>
#include <cstdint>
#include <optional>

namespace facetmill {

/// The least of what the machine has available, what its cgroup leaves (v1 and v2), and what RLIMIT_AS
/// leaves. None where the system does not say.
std::optional<std::uint64_t> available_memory();

/// In use by this process, of the memory of the machine.
std::uint64_t resident_memory();
/// The most that it was so far.
std::size_t peak_memory();

} // namespace facetmill
