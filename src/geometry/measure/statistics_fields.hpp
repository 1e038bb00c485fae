#pragma once
// Statistics as reports have them.

#include "geometry/measure/measure.hpp"
#include "options/fields.hpp"

#include <functional>

namespace facetmill {

/// Declares count and, of one number or more, minimum, maximum, mean, median and deviation, all times the
/// factor. For DeclareFields::object.
std::function<void(DeclareFields<Statistics>&)> statistics_fields(std::string unit = "", double factor = 1);

/// "edges 0.1 to 2 (mean 1)", times the factor; empty when nothing was counted.
[[nodiscard]] std::string range_text(const char* name, const Statistics& s, double factor = 1);

} // namespace facetmill
