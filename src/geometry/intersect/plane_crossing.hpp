#pragma once
// Computes, in doubles, where an edge crosses the plane of a triangle and where three planes meet.

#include "base/math/vec.hpp"

#include <array>
#include <optional>

namespace facetmill {

/// The point where the segment from p to q passes through the plane of the triangle. Each true coordinate is
/// rounded towards zero, like rational numbers converted to doubles. None if twice the bits of a double do
/// not decide the rounding, or do not prove that p and q are on different sides. (For a plane perpendicular
/// to an axis, exact signs decide.) Always exact, so the result is unique.
[[nodiscard]] std::optional<Vec3> plane_crossing(const Vec3& p, const Vec3& q,
                                                 const std::array<Vec3, 3>& triangle);

/// The common point of the planes of three triangles, rounded in the same way. None without a proof that the
/// point is unique. On a plane perpendicular to an axis, the coordinate is exactly the plane's.
[[nodiscard]] std::optional<Vec3> planes_crossing(const std::array<std::array<Vec3, 3>, 3>& triangles);

} // namespace facetmill
