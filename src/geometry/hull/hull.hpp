#pragma once
// Convex hulls, and simpler convex shapes that enclose them, for collisions.

#include "mesh/mesh.hpp"

#include <span>
#include <variant>

namespace facetmill {

enum class HullShape { hull, box, sphere, capsule };

struct HullSettings {
    HullShape shape = HullShape::hull;
    std::size_t max_vertices = 0; ///< 0: any number, so the hull is exact; otherwise at least 12
    /// Above 0: everything that is this close to a point along each axis is also inside the shape.
    double margin = 0;
};

/// The dimension of the smallest flat that contains some points.
enum class HullDimension { none, point, line, plane, space };

struct FittedBox {
    Vec3 centre, axes[3]; ///< unit vectors
    Vec3 size;
};
struct FittedSphere {
    Vec3 centre;
    double radius = 0;
};
struct FittedCapsule {
    Vec3 ends[2];
    double radius = 0;
};

struct HullResult {
    Mesh mesh; ///< triangles without attributes; empty if the points have no hull
    HullDimension dimension = HullDimension::none;
    std::size_t hull_vertices = 0; ///< vertices of the exact hull
    double volume = 0;
    double hull_volume = 0;                                                      ///< of the exact hull
    std::variant<std::monostate, FittedBox, FittedSphere, FittedCapsule> fitted; ///< the shape in numbers
};

/// The convex hull of finite points, or a simpler shape around it.
///
/// hull: exact. Its vertices are input points, and every sign is exact. It is closed, manifold and convex. If
/// the points are coplanar, it is the convex polygon with a front and a back, whose volume is 0.
/// hull with max_vertices: half-spaces are cut from an oriented box around the hull. Each cut removes the
/// corner that is farthest from the hull, along the plane through its nearest point. The dual of the sandwich
/// algorithm: G. K. Kamenev, "A class of adaptive algorithms for approximating convex bodies by polyhedra"
/// (1992).
/// box: a box with a side on a face of the hull, the smallest of these (after J. O'Rourke, "Finding minimal
/// enclosing boxes", 1985, who also lets two sides touch only edges).
/// sphere: the smallest ball. Its mesh is an icosphere around the ball, so that flat faces enclose it, too.
/// capsule: around the longest axis of the box, with the smallest circle across it.
///
/// Every shape except the exact hull is scaled about its centre, from one part in 2^48 upward, until exact
/// predicates place all points inside or on it. A box around coplanar points is 2^-40 of its size thick.
/// With a margin, every shape is treated like this, so it always has a volume.
/// Throws a stage error (E-HULL) if no shape can be certified.
[[nodiscard]] HullResult convex_hull(std::span<const Vec3> points, const HullSettings& settings);

/// The dimension of the points, exactly.
[[nodiscard]] HullDimension dimension_of(std::span<const Vec3> points);

/// The points of a mesh that a hull contains: used by faces or lines, or all of a cloud. Points that are not
/// finite are left out.
[[nodiscard]] std::vector<Vec3> hull_points(const Mesh& mesh);

} // namespace facetmill
