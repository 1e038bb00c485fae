#pragma once
// The available memory, so that work that cannot fit is refused before it starts.

#include <cstdint>
#include <optional>
#include <string>

namespace facetmill {

/// Bytes that this process may still use: the least of the machine's available memory, the limits of its
/// cgroups, and RLIMIT_AS. None if the system does not report it.
std::optional<std::uint64_t> available_memory();
/// The same, or 4 GiB if the system does not report it.
std::uint64_t memory_there();

/// From now on the process is meant to take no more bytes than that (0: no limit). Call it once, at the
/// start.
void set_memory_limit(std::uint64_t bytes);
/// As available_memory, but at most the rest of that limit after the memory in use.
std::optional<std::uint64_t> memory_left();

/// The bytes, capped at the available memory. A few hundred MiB are assumed available, because a system
/// query costs a tenth of a millisecond.
std::uint64_t at_most_memory_there(std::uint64_t bytes);

/// Whether so many bytes may exceed the available memory; smaller amounts are assumed available.
bool is_much_memory(double bytes);

/// Throws limit (E-MEMORY) when bytes are more than are available: "WHAT needs about 3.2 GiB, 1.9 GiB are
/// available".
void require_memory(double bytes, const std::string& what, const std::string& hint);

} // namespace facetmill
