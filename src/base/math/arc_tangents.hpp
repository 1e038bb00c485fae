#pragma once
// Angles of many vectors at once.

#include <span>

namespace facetmill {

/// arc_tangent(y[i], x[i]) (base/math/portable_math.hpp) to the last bit, side by side in the processor; y
/// and x are finite, and never both 0. The spans are of one length; angles may be one of them.
void arc_tangents(std::span<const double> y, std::span<const double> x, std::span<double> angles);

} // namespace facetmill
