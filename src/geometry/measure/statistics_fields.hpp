#pragma once
// Fields of statistics in reports.

#include "geometry/measure/measure.hpp"
#include "options/fields.hpp"

#include <functional>

namespace facetmill {

/// Declares the count and, if it is not 0, minimum, maximum, mean, median and deviation, multiplied by the
/// factor. For DeclareFields::object.
std::function<void(DeclareFields<Statistics>&)> statistics_fields(std::string unit = "", double factor = 1);

/// For example "edges 0.1 to 2 (mean 1)", multiplied by the factor; empty without numbers.
[[nodiscard]] std::string range_text(const char* name, const Statistics& s, double factor = 1);

} // namespace facetmill
