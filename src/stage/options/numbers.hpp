#pragma once
// Options with a fixed count of numbers: the coefficients of a plane, the corners of a box.

#include "options/types.hpp"

#include <span>
#include <string_view>

namespace facetmill {

/// Reads a list of exactly this many numbers, or a comma-separated text ("0,0,1,-2", the one-liner's syntax).
/// Returns false after adding a problem (E-TYPE: expected ..., found ...).
bool parse_numbers(const Value& value, std::span<double> out, std::string_view expected, Problems& problems);
/// Its JSON Schema.
[[nodiscard]] Json numbers_schema(std::size_t count);

} // namespace facetmill
