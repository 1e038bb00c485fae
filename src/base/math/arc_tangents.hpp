#pragma once
// Computes the angles of many vectors at once.

#include <span>

namespace facetmill {

/// arc_tangent(y[i], x[i]) (base/math/portable_math.hpp), bit-identical, with SIMD instructions. y and x
/// must be finite, and never both 0. The spans have the same length; angles may be the same span as y or x.
void arc_tangents(std::span<const double> y, std::span<const double> x, std::span<double> angles);

} // namespace facetmill
