#pragma once
// The one reader of sizes: of limits in pipelines, and of --memory.

#include "options/value.hpp"

namespace facetmill {

/// The bytes that a scalar spells, a whole number from 0 to 2^53: "1000000", "500 kB" (1000 bytes each),
/// "500KiB" (1024), and "500K", which is "500KiB". None after adding E-TYPE or E-RANGE at its mark.
[[nodiscard]] std::optional<double> read_byte_count(const Value& value, Problems& problems);

} // namespace facetmill
