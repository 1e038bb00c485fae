#pragma once
// Reads sizes, for limits in pipelines and for --memory.

#include "options/value.hpp"

namespace facetmill {

/// The bytes that a scalar spells, a whole number from 0 to 2^53: "1000000", "500 kB" (1000 bytes each),
/// "500KiB" (1024), and "500K", which is "500KiB". If invalid, adds E-TYPE or E-RANGE at its mark and
/// returns none.
[[nodiscard]] std::optional<double> read_byte_count(const Value& value, Problems& problems);

} // namespace facetmill
