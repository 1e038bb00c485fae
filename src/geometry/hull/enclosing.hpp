#pragma once
// Convex surfaces around points, certified by exact predicates.

#include "geometry/cgal/convex_hull.hpp"
#include "geometry/hull/hull.hpp"
#include "geometry/polygon/flat_hull.hpp"

#include <optional>

namespace facetmill {

/// Whether every point is inside or on the convex surface, exactly. O(points * triangles), parallel.
[[nodiscard]] bool encloses(const ConvexSurface& surface, std::span<const Vec3> points);

/// Shares of the size of a shape: the first enlargement to try, and the largest.
struct Growth {
    double first = 3.5527136788005009e-15; // 2^-48: a few roundings of a coordinate
    double most = 1;
};
/// The hull of the corners, scaled about the centre until it encloses the points (see convex_hull). None if
/// it would grow too much. The centre must be inside.
[[nodiscard]] std::optional<ConvexSurface> enlarged_around(const std::vector<Vec3>& corners,
                                                           const Vec3& centre, std::span<const Vec3> points,
                                                           const Growth& growth = {});

/// The smallest of the oriented boxes with a side on a triangle of the hull.
[[nodiscard]] FittedBox oriented_box(const ConvexSurface& hull);
/// The corners of a box; a flat box gets a thickness of 2^-40 of its size, so that it can be certified.
[[nodiscard]] std::vector<Vec3> box_corners(const FittedBox& box);

/// A polytope with at most this many corners around the hull, up to rounding.
[[nodiscard]] std::vector<Vec3> polytope_around(const ConvexSurface& hull, std::size_t max_vertices);

/// The volume of a closed surface.
[[nodiscard]] double volume_of(const ConvexSurface& surface);

} // namespace facetmill
