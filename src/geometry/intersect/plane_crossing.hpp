#pragma once
// Crossings of an edge with the plane of a triangle, and of three planes, in doubles.

#include "base/math/vec.hpp"

#include <array>
#include <optional>

namespace facetmill {

/// The point where the segment from p to q passes through the plane of the triangle, each coordinate rounded
/// towards zero from the true one, as rational numbers are made doubles; none where twice the bits of a
/// double leave that open (of a plane across an axis exact signs then tell), or do not prove that p and q are
/// on different sides. Exact, so always the same.
[[nodiscard]] std::optional<Vec3> plane_crossing(const Vec3& p, const Vec3& q,
                                                 const std::array<Vec3, 3>& triangle);

/// The point that the planes of three triangles have in common, likewise; none where it is not proved that
/// there is just one. On a plane across an axis, the coordinate is that of the plane.
[[nodiscard]] std::optional<Vec3> planes_crossing(const std::array<std::array<Vec3, 3>, 3>& triangles);

} // namespace facetmill
