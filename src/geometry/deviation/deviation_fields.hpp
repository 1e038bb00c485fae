#pragma once
// A measured deviation as reports have it.

#include "geometry/deviation/deviation.hpp"
#include "options/fields.hpp"

namespace facetmill {

/// Both ways together and each for itself, with the place of the maximum. Lengths in scene units, null when
/// infinite; the bound is null unless certified.
void declare_deviation_fields(DeclareFields<DeviationResult>& d);
/// The declared fields of a deviation.
const Fields& deviation_fields();
Json deviation_json(const DeviationResult& deviation);

} // namespace facetmill
