#pragma once
// Options that are a fixed number of numbers: the coefficients of a plane, the corners of a box.

#include "options/types.hpp"

#include <span>
#include <string_view>

namespace facetmill {

/// Reads a list of exactly so many numbers, or a text of them with commas ("0,0,1,-2", as the one-liner
/// writes it). False after adding a problem (E-TYPE: expected ..., found ...).
bool parse_numbers(const Value& value, std::span<double> out, std::string_view expected, Problems& problems);
/// Its schema.
Json numbers_schema(std::size_t count);

} // namespace facetmill
