#pragma once
// Quantiles of the normal distribution of many numbers at once.

#include <span>

namespace facetmill {

/// inverse_normal(p[i]) (base/math/portable_math.hpp) to the last bit, four side by side in the processor.
/// The spans are of one length; x may be p.
void inverse_normals(std::span<const double> p, std::span<double> x);

} // namespace facetmill
