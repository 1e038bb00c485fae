#pragma once
// Where an edge passes through the plane of a triangle, in doubles.

#include "base/vec.hpp"

#include <array>
#include <optional>

namespace facetmill {

/// The point where the segment from p to q passes through the plane of the triangle, each coordinate rounded
/// towards zero from the true one, as rational numbers are made doubles; none where twice the bits of a
/// double leave that open, or do not prove that p and q are on different sides. Exact, so always the same.
std::optional<Vec3> plane_crossing(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& triangle);

} // namespace facetmill
