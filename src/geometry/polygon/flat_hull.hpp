#pragma once
// The convex hull of points in the plane.

#include "mesh/mesh.hpp"

#include <vector>

namespace facetmill {

/// A point in a plane, and the number of the point that it comes from.
struct FlatPoint {
    double x = 0, y = 0;
    Index of = none;
};
/// The corners of the convex hull in the plane, anticlockwise, with exact signs (A. M. Andrew, "Another
/// efficient algorithm for convex hulls in two dimensions", 1979). The points must not be collinear.
[[nodiscard]] std::vector<FlatPoint> flat_hull(std::vector<FlatPoint> points);

} // namespace facetmill
