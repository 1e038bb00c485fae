#pragma once
// Polygon maths in the plane and in space, after P. Bourke, "Polygon types" (1993), "Determining whether or
// not a polygon (2D) has its vertices ordered clockwise or counter-clockwise" (1998), "Clipping a line
// segment to a complex polygon" (1997), "Calculating the area of a 3D polygon" (2000), "Determining if a
// point lies on the interior of a polygon" (1987) and "Calculating the area and centroid of a polygon"
// (1988). Deciding signs are exact (base/math/predicates.hpp). Sums are relative to a point of the polygon,
// so that polygons far from the origin keep their precision.

#include "base/math/vec.hpp"
#include "mesh/mesh.hpp"

#include <optional>
#include <span>
#include <vector>

namespace facetmill {

/// A point in a plane.
struct Vec2 {
    double x = 0, y = 0;
    constexpr bool operator==(const Vec2&) const = default;
};
constexpr Vec2 operator+(const Vec2& a, const Vec2& b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(const Vec2& a, double s) { return {a.x * s, a.y * s}; }
[[nodiscard]] constexpr double dot(const Vec2& a, const Vec2& b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] constexpr double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double length(const Vec2& a) { return std::sqrt(dot(a, a)); }

namespace polygon {

/// The corners of a closed polygon; the last is joined to the first.
using Ring = std::span<const Vec2>;
/// A polygon with holes: its rings in any order. For areas, holes run in the opposite direction to outlines.
using Rings = std::span<const Ring>;

// --- Area, centroid, second moments

/// A = 1/2 sum(x_i y_i+1 - x_i+1 y_i): positive when anticlockwise.
[[nodiscard]] double signed_area(Ring ring);

/// The sign of the ring's signed area: 1 anticlockwise, -1 clockwise, 0 without area. Exact for any ring.
[[nodiscard]] int orientation(Ring ring);

/// Second moments: x is the integral of y^2 (about the x axis), y of x^2, and xy of x y. Unit: length to the
/// fourth power.
struct SecondMoments {
    double x = 0, y = 0, xy = 0;
};

/// The directions about which a shape's second moment is largest and smallest.
struct PrincipalAxes {
    Vec2 major{1, 0}, minor{0, 1}; ///< unit vectors; minor is major turned left
    double largest = 0, smallest = 0;
};

struct Moments {
    double area = 0; ///< never negative
    Vec2 centroid;
    SecondMoments about_origin, about_centroid;
    PrincipalAxes axes; ///< axes through the centroid
};

/// The moments of a polygon with holes by orientation, summed over its rings. If the sum is clockwise, all
/// signs are reversed, as P. Bourke, "Calculating the area and centroid of a polygon" (1988), requires. None
/// if the area is zero. The rings must not cross themselves: see classify.
[[nodiscard]] std::optional<Moments> moments(Rings rings);
[[nodiscard]] std::optional<Moments> moments(Ring ring);

/// Computed from cos 2t = (Ix - Iy) / 2r, sin 2t = -Ixy / r, r^2 = ((Ix - Iy) / 2)^2 + Ixy^2; the x axis
/// when all are equal.
[[nodiscard]] PrincipalAxes principal_axes(const SecondMoments& moments);

// --- Polygons in space

/// Half the sum of P_i x P_i+1 (Stokes). It points along the normal from which the corners run
/// anticlockwise, and its length is the area. The order P_i x P_i-1 of P. Bourke, "Calculating the area of a
/// 3D polygon" (2000), gives the negative. Accepts any closed polygon, planar or not.
[[nodiscard]] Vec3 area_vector(std::span<const Vec3> corners);

/// The area: |(P1 - P0) x (P2 - P0)| / 2 for a triangle. |(P2 - P0) x (P3 - P1)| / 2 for a quad (twice the
/// parallelogram of its edge midpoints). For more corners, the length of area_vector.
[[nodiscard]] double area(std::span<const Vec3> corners);

/// The largest distance of a corner from the plane through the mean of the corners, perpendicular to
/// plane_normal; 0 for triangles, and for corners on a line.
[[nodiscard]] double plane_deviation(std::span<const Vec3> corners);

/// The unit normal of the polygon's plane, along area_vector. If the parts cancel in area_vector, to 1e-12
/// of the square of the polygon's size (a bow-tie), this is the normal of its largest triangle. Zero if all
/// corners are on a line.
[[nodiscard]] Vec3 plane_normal(std::span<const Vec3> corners);

/// The corners projected along the coordinate axis nearest to the normal, mirrored so that the ring is
/// anticlockwise if the normal points at the viewer. Coordinates are copied, not computed, so turns stay
/// exact.
[[nodiscard]] std::vector<Vec2> flattened(std::span<const Vec3> corners);

// --- Kinds

/// True if all turns have the same sign or are straight, and the ring goes round once (the turns of a
/// pentagram also agree). Exact.
bool is_convex(Ring ring);

/// How edges of rings meet, except neighbours at their common corner.
enum class Contact {
    none,
    touching, ///< a corner on a corner or edge, or edges along each other
    crossing, ///< two edges cross in their interiors
};
/// Exact; O(n log n) for any edges.
[[nodiscard]] Contact contact(Rings rings);

enum class Kind {
    triangle,
    quad,    ///< a convex polygon with four corners
    convex,  ///< five corners or more
    concave, ///< no edge meets another
    complex, ///< has holes (by coincident edges or several rings) or corners that touch, but covers each
             ///< point once
    self_intersecting, ///< winds more than once around some points, or in both directions
    degenerate,        ///< without area
};
inline constexpr int kinds = 7;
[[nodiscard]] const char* to_string(Kind kind);

/// The types of P. Bourke, "Polygon types" (1993). Several rings (with holes by orientation) are complex or
/// self-intersecting.
[[nodiscard]] Kind classify(Rings rings);
[[nodiscard]] Kind classify(Ring ring);

// --- Containment

enum class PointLocation { outside, inside, on_edge, on_vertex };
[[nodiscard]] const char* to_string(PointLocation place);

/// Crossing rule: a point is inside if a ray to the right crosses an odd number of edges. Edges include
/// their lower end but not their upper end, so that shared ends count once. Holes may have any orientation.
/// Exact.
[[nodiscard]] PointLocation locate(const Vec2& p, Rings rings);
[[nodiscard]] PointLocation locate(const Vec2& p, Ring ring);

/// For a convex ring: a point is inside if it is on the same side of all edges. Exact.
[[nodiscard]] PointLocation locate_convex(const Vec2& p, Ring convex);

/// The sum of the angles that the edges subtend at p: 2 pi times the winding number. p must not be on the
/// ring.
[[nodiscard]] double angle_sum(const Vec2& p, Ring ring);
/// Decides by the angle sum over all rings (holes by orientation or by coincident edges). p must not be on a
/// ring.
bool inside_by_angles(const Vec2& p, Rings rings);

/// The sum of the unsigned angles between neighbouring corners seen from q. It is 2 pi only if q is in the
/// plane of a convex polygon and inside it, and decreases with the distance.
[[nodiscard]] double angle_sum(const Vec3& q, std::span<const Vec3> convex);
/// Whether q is on the polygon by angles: the sum is at most `tolerance` (radians) less than 2 pi. A corner
/// is inside.
bool inside_by_angles(const Vec3& q, std::span<const Vec3> convex, double tolerance = 1e-9);

// --- Lines

enum class Keep { inside, outside };

struct Segment {
    Vec2 a, b;
};

struct HatchSettings {
    double spacing = 1;          ///< distance between lines, above zero
    Vec2 direction{1, 0};        ///< unit vector along the lines
    Keep keep = Keep::inside;    ///< outside: within the bounds of the rings, enlarged by one spacing
    std::size_t limit = 1000000; ///< maximum number of lines
};

/// Parallel lines clipped to the polygon with holes; every other line runs backward. Their distances from
/// the origin are multiples of the spacing, so that neighbouring sections match. Throws a limit error
/// (E-HATCH).
[[nodiscard]] std::vector<Segment> hatch(Rings rings, const HatchSettings& settings);

} // namespace polygon
} // namespace facetmill
