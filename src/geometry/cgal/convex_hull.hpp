#pragma once
// The convex hull of points. This header does not include CGAL, which does the work.

#include "base/math/vec.hpp"

#include <array>
#include <span>
#include <vector>

namespace facetmill {

/// Triangles of the convex hull of finite points, anticlockwise seen from outside. Empty for fewer than three
/// points, and for points on a line. Points in a plane give one or both sides of their hull. Deterministic.
[[nodiscard]] std::vector<std::array<Vec3, 3>> convex_hull(std::span<const Vec3> points);

} // namespace facetmill
