#pragma once
// The report fields of a measured deviation.

#include "geometry/deviation/deviation.hpp"
#include "options/fields.hpp"

namespace facetmill {

/// Both ways together and each separately, with the position of the maximum. Lengths in scene units, null
/// when infinite; the bound is null unless certified.
void declare_deviation_fields(DeclareFields<DeviationResult>& d);
/// The declared fields of a deviation.
const Fields& deviation_fields();
[[nodiscard]] Json deviation_json(const DeviationResult& deviation);

} // namespace facetmill
