#pragma once
// The point of a surface that is closest to a given one, and the face that it is on.

#include "geometry/spatial/face_tree.hpp"

#include <span>

namespace facetmill {

/// A point of the surface. Of several faces at the same distance (at an edge or a vertex) it is the lowest.
struct Closest {
    Vec3 point;
    double distance = HUGE_VAL; ///< infinity when the surface is empty, or the query not finite
    Index face = none;
    Index triangle = none; ///< in the tree's order: a hint for the next query nearby
};

/// The point of the triangle closest to p. For any triangle, degenerate ones included: what is returned is
/// always a point of the triangle up to the rounding of its coordinates relative to p. Differences of
/// coordinates between 1e-70 and 1e70.
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// The point of one triangle of the tree, named in the tree's order.
Closest closest_on(const FaceTree& tree, Index triangle, const Vec3& p);

/// Searched from the triangle `hint` outward, if there is one. `enough` stops the search at the first point
/// found that is no farther; it need not be the closest then: what lies beside the hint is tried first. About
/// a microsecond on millions of faces.
Closest closest_point(const FaceTree& tree, const Vec3& p, Index hint = none, double enough = -1);

/// An order of points in which each is near the one before, so that its answer is a good hint.
std::vector<Index> order_of_queries(std::span<const Vec3> points);

/// Of several triangles that a point lies on: the one of the lowest face, or any, where only the distance is
/// of use and thousands may lie in one place.
enum class OfSeveral { lowest, any };
/// For many points, in parallel: they are visited along a curve through their box, each with the one before
/// as a hint. The result is in the order of the points and the same for any number of threads.
std::vector<Closest> closest_points(const FaceTree& tree, std::span<const Vec3> points,
                                    OfSeveral which = OfSeveral::lowest);

} // namespace facetmill
