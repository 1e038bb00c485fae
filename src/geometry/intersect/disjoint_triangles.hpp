#pragma once
// A filter before the exact test of two triangles. Certain floating-point signs prove that nearly all
// neighbours on a surface are disjoint.

#include "base/math/predicates.hpp"
#include "base/math/vec.hpp"

#include <array>
#include <cmath>

namespace facetmill {

/// The sign of left - right, each a product of two differences of given numbers; 0 if floating point is
/// uncertain.
[[nodiscard]] inline int sure_sign(double left, double right) {
    const double det = left - right, size = std::abs(det);
    if (!(size > orientation_error * (std::abs(left) + std::abs(right)) && size > orientation_smallest))
        return 0;
    return det > 0 ? 1 : -1;
}

/// True if two triangles with area certainly have no common point except their first `shared` corners (0, 1
/// or 2) and the edge between them. These corners must be the same points. False implies nothing.
bool surely_disjoint(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, int shared);

} // namespace facetmill
