#pragma once
// The report fields of a measured deviation.

#include "geometry/deviation/deviation.hpp"
#include "options/fields.hpp"

namespace facetmill {

/// Declares both directions together and separately, with the position of the maximum. Lengths are in scene
/// units, and null if infinite. The bound is null unless certified.
void declare_deviation_fields(DeclareFields<DeviationResult>& d);
/// The declared fields of a deviation.
const Fields& deviation_fields();
[[nodiscard]] Json deviation_json(const DeviationResult& deviation);

} // namespace facetmill
