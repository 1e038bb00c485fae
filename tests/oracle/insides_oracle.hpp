#pragma once
// Whether triangles meet inside any of them, by exact constructions, independently of the tested code.

#include "base/math/vec.hpp"

#include <array>

namespace facetmill::oracle {

/// Whether some point is inside one of the triangles and in the other: whether one shrunken by 2^-60 towards
/// its middle meets the other. Sure for coordinates that are small multiples of a power of two.
bool insides_meet(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

} // namespace facetmill::oracle
