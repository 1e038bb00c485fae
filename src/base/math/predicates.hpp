#pragma once
// Exact signs, for the layers that do not use CGAL.

#include "base/math/vec.hpp"

namespace facetmill {

/// The filter's two thresholds, for callers that already have the products. The sign of left - right, the
/// products of rounded differences, is certain when |left - right| exceeds two bounds. The first is
/// orientation_error * (|left| + |right|), Shewchuk's (3 + 16 e) e with e = 2^-53. The second is
/// orientation_smallest, below which products may have lost bits.
inline constexpr double orientation_error = 3.3306690738754716e-16;
inline constexpr double orientation_smallest = 1e-290;

/// The sign (-1, 0, 1) of the area of the triangle a, b, c in the plane: 1 if they turn left. Exact for
/// finite coordinates of any size: a floating-point filter, then exact expansions (J. R. Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", 1997), and integers if those
/// would overflow or underflow.
[[nodiscard]] int orientation_2d(double ax, double ay, double bx, double by, double cx, double cy);

/// True if the three points are collinear (or two coincide). Exact: tests their three axis projections.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// True if the three points have the same coordinate along axis k, so that their plane is perpendicular to
/// it.
constexpr bool is_level(const Vec3& a, const Vec3& b, const Vec3& c, std::size_t k) {
    return a[k] == b[k] && b[k] == c[k];
}

/// The side of the plane through a, b, c that contains d. It is 1 for the side that (b - a) x (c - a) points
/// to, -1 for the opposite side, 0 on the plane. Exact for finite coordinates of any size, with the same
/// method as orientation_2d.
[[nodiscard]] int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

} // namespace facetmill
