#pragma once
// The deviation of a surface from itself, for stages that changed nothing. Private to this folder.

#include "geometry/deviation/deviation.hpp"

namespace facetmill {

/// Whether both have exactly the same triangles, with finite coordinates.
bool are_same(const Surface& first, const Surface& second);

/// The one-way deviation from itself of a surface with finite coordinates: the counts of a measurement, and
/// distance 0. Without the bound that certify requests. O(samples + vertices).
[[nodiscard]] DirectedDeviation deviation_from_itself(const Surface& surface,
                                                      const DeviationSettings& settings);

} // namespace facetmill
