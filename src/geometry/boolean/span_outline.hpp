#pragma once
// Triangles that span a closed outline in space.

#include "mesh/mesh.hpp"

#include <array>
#include <vector>

namespace facetmill {

/// Spans the outline (three points or more, finite) by n - 2 triangles that run along it the way it is given,
/// without new points: those whose largest dihedral angle is least and, among such, whose area is
/// (after P. Liepa, "Filling holes in meshes", 2003; dynamic programming in O(n^3)). across: the normals of
/// the faces beyond each edge i, i + 1, of any length, or empty; dihedral angles are counted to them as well.
/// Outlines of more than a few hundred points first lose their smallest ears. Triangles without area are last
/// choices. Ties go to the lower corner, so the same outline gives the same triangles. Parallel.
std::vector<std::array<Index, 3>> span_outline(const std::vector<Vec3>& outline,
                                               const std::vector<Vec3>& across = {});

} // namespace facetmill
