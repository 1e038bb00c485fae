#pragma once
// Measures how far a triangle is from equilateral.

#include "base/math/vec.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

/// The aspect_ratio of a triangle with these edge lengths and area.
[[nodiscard]] inline double aspect_ratio(double x, double y, double z, double area) {
    return area > 0 ? std::max({x, y, z}) * (x + y + z) / (4 * std::sqrt(3.0) * area) : HUGE_VAL;
}

/// The longest edge over the diameter of the inscribed circle, relative to an equilateral triangle: longest
/// * perimeter / (4 sqrt(3) * area). 1 for equal sides, infinite without area. This is the meaning of
/// aspect_ratio everywhere (C. Stimpson, C. Ernst, P. Knupp, P. Pebay, D. Thompson, 'The Verdict Geometric
/// Quality Library', 2007).
[[nodiscard]] inline double aspect_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
    return aspect_ratio(length(b - a), length(c - b), length(a - c), length(cross(b - a, c - a)) / 2);
}

} // namespace facetmill
