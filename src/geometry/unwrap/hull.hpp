#pragma once
// The convex hull of a chart, and the smallest rectangle around it.

#include "geometry/polygon/polygon.hpp"

namespace facetmill::unwrap_room {

/// The corners of the convex hull, anticlockwise (A. M. Andrew, "Another efficient algorithm for convex hulls
/// in two dimensions", 1979).
[[nodiscard]] std::vector<Vec2> convex_hull_of(const std::vector<Vec2>& points);

/// The unit vector along the longer side of the smallest rectangle around a hull (G. Toussaint, "Solving
/// geometric problems with the rotating calipers", 1983).
[[nodiscard]] Vec2 axis_of_smallest_rectangle(const std::vector<Vec2>& hull);

} // namespace facetmill::unwrap_room
