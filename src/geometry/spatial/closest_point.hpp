#pragma once
// Finds the point of a surface closest to a query, and its face.

#include "geometry/spatial/face_tree.hpp"

#include <span>

namespace facetmill {

/// A point of the surface. If several faces are at the same distance (at an edge or a vertex), the lowest
/// face is reported.
struct Closest {
    Vec3 point;
    double distance = HUGE_VAL; ///< infinity if the surface is empty, or the query is not finite
    Index face = none;
    Index triangle = none; ///< in the tree's order: a hint for the next query nearby
};

/// The point of the triangle closest to p. Degenerate triangles are allowed: the result is always a point of
/// the triangle, up to the rounding of its coordinates relative to p. Requires differences of coordinates
/// between 1e-70 and 1e70.
[[nodiscard]] Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// The closest point of one triangle, given by its index in the tree's order.
[[nodiscard]] Closest closest_on(const FaceTree& tree, Index triangle, const Vec3& p);

/// Searches from the triangle `hint` outward, if given. `enough` stops the search at the first point found
/// within this distance. That point may not be the closest, because triangles near the hint are tried first.
/// About a microsecond on millions of faces.
[[nodiscard]] Closest closest_point(const FaceTree& tree, const Vec3& p, Index hint = none,
                                    double enough = -1);

/// An order in which each point is near the previous point, so that the previous answer is a good hint.
[[nodiscard]] std::vector<Index> order_of_queries(std::span<const Vec3> points);

/// The triangle to report if a point is on several: the triangle of the lowest face, or any. `any` is for
/// callers that need only the distance, if thousands of triangles may coincide.
enum class OfSeveral { lowest, any };
/// Queries many points in parallel. They are visited along a curve through their box, each with the previous
/// answer as a hint. The result is in the order of the points, and does not depend on the number of threads.
[[nodiscard]] std::vector<Closest> closest_points(const FaceTree& tree, std::span<const Vec3> points,
                                                  OfSeveral which = OfSeveral::lowest);

} // namespace facetmill
