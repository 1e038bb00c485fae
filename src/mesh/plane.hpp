#pragma once
// Planes, and on which side of them a point is: exactly.

#include "base/math/vec.hpp"

namespace facetmill {

/// The points p with normal . (p - through) + offset = 0. The normal has any length but zero and is never
/// normalised: the plane is the one that the given doubles mean. A x + B y + C z + D = 0 has through = 0 and
/// offset = D.
struct Plane {
    Vec3 normal{0, 0, 1};
    Vec3 through;
    double offset = 0;

    bool operator==(const Plane&) const = default;
};

/// normal . (p - through) + offset: the sign is exact (0 means exactly on the plane), the magnitude good to a
/// few units in the last place of its largest term, and never 0 for a point off the plane. A filter in plain
/// doubles decides almost always; else the sum is evaluated as an expansion (J. R. Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", 1997), and in integers where
/// that would overflow or underflow. Finite numbers of any size.
[[nodiscard]] double side(const Plane& plane, const Vec3& p);

/// Whether they are one set of points, exactly: whatever the length and the sense of their normals, and
/// however they are written. Exact under the same conditions as side.
bool same_plane(const Plane& a, const Plane& b);

/// The plane before the map: p is on its front exactly when to_world takes p to the front of the given
/// plane, up to rounding of the new coefficients. The identity returns the same plane. normal and through
/// are mapped, so that axis-aligned planes stay axis-aligned through a point; a singular map moves the
/// offset instead.
[[nodiscard]] Plane pulled_back(const Plane& plane, const Transform& to_world);

/// The only axis along which the normal is not zero, or -1.
[[nodiscard]] int axis_of(const Plane& plane);

/// Throws usage (E-PLANE) for a normal that is zero or not finite, and for a point or offset that is not
/// finite.
void check_plane(const Plane& plane);

} // namespace facetmill
