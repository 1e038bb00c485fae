#pragma once
// How much memory there still is, so that what cannot fit is refused before it starts.

#include "platform/available_memory.hpp"

#include <string>

namespace facetmill {

/// available_memory(), and 4 GiB where the system does not say.
[[nodiscard]] std::uint64_t memory_there();

/// From now on the process is meant to take no more bytes than that (0: no limit). Call it once, at the
/// start.
void set_memory_limit(std::uint64_t bytes);
/// As available_memory, and no more than what that limit leaves beside what is in use.
[[nodiscard]] std::optional<std::uint64_t> memory_left();

/// The bytes, or what is there where they are more; a few hundred MiB are taken to be there, since to ask the
/// system costs a tenth of a millisecond.
[[nodiscard]] std::uint64_t at_most_memory_there(std::uint64_t bytes);

/// Whether so many bytes may be more than are there; fewer are taken to be there.
bool is_much_memory(double bytes);

/// Throws limit (E-MEMORY) when bytes are more than are available: "WHAT needs about 3.2 GiB, 1.9 GiB are
/// available".
void require_memory(double bytes, const std::string& what, const std::string& hint);

} // namespace facetmill
