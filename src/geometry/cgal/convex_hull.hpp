#pragma once
// Convex hulls and smallest balls. This header does not include CGAL, which does the work.

#include "mesh/mesh.hpp"

#include <array>
#include <span>
#include <vector>

namespace facetmill {

/// A closed convex surface: triangles over points, anticlockwise seen from outside.
struct ConvexSurface {
    std::vector<Vec3> points;
    std::vector<std::array<Index, 3>> triangles;
};

/// The convex hull of finite points that are not all in one plane (C. B. Barber, D. P. Dobkin and H.
/// Huhdanpaa, "The quickhull algorithm for convex hulls", 1996, with exact predicates). Its vertices are
/// input points, sorted by x, y and z, so it does not depend on the order of the input.
[[nodiscard]] ConvexSurface convex_surface(std::span<const Vec3> points);

struct Ball {
    Vec3 centre;
    double radius = 0;
};

/// The smallest ball around points, up to rounding (B. Gaertner, "Fast and robust smallest enclosing balls",
/// 1999). The radius reaches the farthest point as measured from the rounded centre.
[[nodiscard]] Ball smallest_ball(std::span<const Vec3> points);

} // namespace facetmill
