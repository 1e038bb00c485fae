#pragma once
// A filter before the exact test of two triangles: nearly all neighbours on a surface are apart by signs that
// floating point is sure of.

#include "base/vec.hpp"

#include <array>

namespace facetmill {

/// True when two triangles with area are sure to have no point in common but their first `shared` corners
/// (0, 1 or 2), which are the same points, and the edge between two of them. False says nothing.
bool surely_disjoint(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, int shared);

} // namespace facetmill
