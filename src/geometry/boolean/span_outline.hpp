#pragma once
// Triangulates a closed outline in space.

#include "mesh/mesh.hpp"

#include <array>
#include <vector>

namespace facetmill {

/// Spans the outline (at least three finite points) with n - 2 triangles in its direction, without new
/// points. It minimises the largest dihedral angle, then the area (after P. Liepa, "Filling holes in meshes",
/// 2003; dynamic programming in O(n^3)). across: the normals of the faces across each edge i, i + 1, of any
/// length, or empty. Dihedral angles to these faces count as well. Outlines of more than a few hundred points
/// first lose their smallest ears. Triangles without area are last choices. Ties go to the lower corner, so
/// the same outline gives the same triangles. Parallel.
[[nodiscard]] std::vector<std::array<Index, 3>> span_outline(const std::vector<Vec3>& outline,
                                                             const std::vector<Vec3>& across = {});

} // namespace facetmill
