#pragma once
// Planes, and exact tests for the sides of points.

#include "base/math/vec.hpp"

namespace facetmill {

/// A plane: the points p with normal . (p - through) + offset = 0. The normal has any nonzero length and is
/// never normalised, so the plane is exactly what the doubles define. A x + B y + C z + D = 0 has through =
/// 0 and offset = D.
struct Plane {
    Vec3 normal{0, 0, 1};
    Vec3 through;
    double offset = 0;

    bool operator==(const Plane&) const = default;
};

/// The value normal . (p - through) + offset. The sign is exact (0 means exactly on the plane). The
/// magnitude is accurate to a few units in the last place of its largest term. A filter in plain doubles
/// nearly always decides; otherwise the sum is evaluated as an expansion (J. R. Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", 1997), and in integers if that
/// would overflow or underflow. Accepts finite numbers of any size.
[[nodiscard]] double side(const Plane& plane, const Vec3& p);

/// Whether both are exactly the same set of points, regardless of notation and of the lengths and directions
/// of their normals. Exact under the same conditions as side.
bool same_plane(const Plane& a, const Plane& b);

/// The plane before the map: p is in front of it if to_world maps p to the front of the given plane, up to
/// rounding of the new coefficients. The identity returns the same plane. normal and through are mapped, so
/// that axis-aligned planes stay axis-aligned. If the map is singular, only the plane's offset moves.
[[nodiscard]] Plane pulled_back(const Plane& plane, const Transform& to_world);

/// The only axis along which the normal is not zero, or -1.
[[nodiscard]] int axis_of(const Plane& plane);

/// Throws a usage error (E-PLANE) for a normal that is zero or not finite, and for a point or offset that is
/// not finite.
void check_plane(const Plane& plane);

} // namespace facetmill
