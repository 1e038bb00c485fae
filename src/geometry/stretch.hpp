#pragma once
// How much a transform lengthens, for lengths in the world that are used in a part's own space.

#include "base/functions.hpp"
#include "base/vec.hpp"

namespace facetmill {

/// The cube root of how much volumes grow: what lengths grow by under a rotation and a uniform scale, and by
/// their geometric mean under others. 1 for a transform that flattens.
inline double mean_stretch(const Transform& t) {
    const double volume = std::abs(t.determinant());
    return volume > 0 && std::isfinite(volume) && volume != 1 ? exponential(logarithm(volume) / 3) : 1;
}

} // namespace facetmill
