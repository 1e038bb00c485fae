#pragma once
// A surface and itself, as before and after a stage that found nothing to do. Private to this folder.

#include "geometry/deviation/deviation.hpp"

namespace facetmill {

/// Whether both have the same triangles, number by number, and no coordinate that is not finite.
bool are_same(const Surface& first, const Surface& second);

/// The deviation of a surface without coordinates that are not finite from itself, one way: the counts that a
/// measurement has, and no distance. Without the bound that certify asks for. O(samples + vertices).
DirectedDeviation deviation_from_itself(const Surface& surface, const DeviationSettings& settings);

} // namespace facetmill
