#pragma once
// How far a triangle is from one of equal sides.

#include "base/vec.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

/// The longest edge over the diameter of the inscribed circle, in proportion to what a triangle of equal
/// sides has: longest * perimeter / (4 sqrt(3) * area). 1 for equal sides, infinite without area. What
/// aspect_ratio means everywhere (C. Stimpson, C. Ernst, P. Knupp, P. Pebay, D. Thompson, 'The Verdict
/// Geometric Quality Library', 2007).
inline double aspect_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double x = length(b - a), y = length(c - b), z = length(a - c),
                 area = length(cross(b - a, c - a)) / 2;
    const double longest = std::max({x, y, z});
    return area > 0 ? longest * (x + y + z) / (4 * std::sqrt(3.0) * area) : HUGE_VAL;
}

} // namespace facetmill
