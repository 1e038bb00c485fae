#pragma once
// Available memory, to refuse work that cannot fit before it starts.

#include "platform/available_memory.hpp"

#include <string>

namespace facetmill {

/// available_memory(), or 4 GiB if the system does not report it.
[[nodiscard]] std::uint64_t memory_there();

/// Sets the memory limit of the process in bytes (0: no limit). Call it once, at the start.
void set_memory_limit(std::uint64_t bytes);
/// Like available_memory, but at most the memory limit minus the memory in use.
[[nodiscard]] std::optional<std::uint64_t> memory_left();

/// The minimum of the bytes and the available memory. A few hundred MiB are assumed to be available, because
/// asking the system takes a tenth of a millisecond.
[[nodiscard]] std::uint64_t at_most_memory_there(std::uint64_t bytes);

/// Whether this many bytes may exceed the available memory. Small amounts are assumed to be available.
bool is_much_memory(double bytes);

/// Throws a limit error (E-MEMORY) if the bytes exceed the available memory: "WHAT needs about 3.2 GiB, 1.9
/// GiB are available".
void require_memory(double bytes, const std::string& what, const std::string& hint);

} // namespace facetmill
