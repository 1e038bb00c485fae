#pragma once
// A filter before the exact test of two triangles: nearly all neighbours on a surface are apart by signs that
// floating point is sure of.

#include "base/math/predicates.hpp"
#include "base/math/vec.hpp"

#include <array>
#include <cmath>

namespace facetmill {

/// The sign of the product of two differences of given numbers less another; 0 when floating point is unsure.
[[nodiscard]] inline int sure_sign(double left, double right) {
    const double det = left - right, size = std::abs(det);
    if (!(size > orientation_error * (std::abs(left) + std::abs(right)) && size > orientation_smallest))
        return 0;
    return det > 0 ? 1 : -1;
}

/// True when two triangles with area are sure to have no point in common but their first `shared` corners
/// (0, 1 or 2), which are the same points, and the edge between two of them. False says nothing.
bool surely_disjoint(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, int shared);

} // namespace facetmill
