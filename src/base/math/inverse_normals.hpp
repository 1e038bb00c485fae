#pragma once
// Computes quantiles of the normal distribution for many numbers at once.

#include <span>

namespace facetmill {

/// inverse_normal(p[i]) (base/math/portable_math.hpp), bit-identical, four at a time with SIMD instructions.
/// The spans have the same length; x may be p.
void inverse_normals(std::span<const double> p, std::span<double> x);

} // namespace facetmill
