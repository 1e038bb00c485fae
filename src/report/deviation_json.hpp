#pragma once
// A measured deviation as reports have it.

#include "base/json.hpp"
#include "geometry/deviation/deviation.hpp"

namespace facetmill::report {

/// {maximum, rms, mean, bound (null unless certified), diagonal, percent: {maximum, rms, mean, bound}, seed,
/// forward, backward}; each way has its own samples, vertices, maximum, rms, mean, bound and at: {from, to,
/// face}, the place of the maximum. Lengths in scene units, null when infinite.
Json deviation_json(const DeviationResult& deviation);

} // namespace facetmill::report
