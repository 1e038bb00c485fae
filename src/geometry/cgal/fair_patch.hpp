#pragma once
// Patches a hole with the density and curvature of its surroundings. This header does not include CGAL,
// which does the work.

#include "mesh/mesh.hpp"

#include <array>
#include <vector>

namespace facetmill {

/// Triangles on an outline. Corners below the outline's size are its points; the others are points[corner -
/// size].
struct HolePatch {
    std::vector<std::array<Index, 3>> triangles;
    std::vector<Vec3> points;
};

/// Refines the patch (of the outline's points only) to the density of the outline (P. Liepa, "Filling holes
/// in meshes", 2003) and fairs it (M. Botsch and O. Sorkine, "On linear variational surface deformation
/// methods", 2008) so that it continues the faces around it with continuous tangents. Returns the patch
/// unchanged if the faces around it are not manifold, or if fairing fails. Deterministic.
[[nodiscard]] HolePatch fair_patch(const std::vector<Vec3>& outline,
                                   const std::vector<std::array<Index, 3>>& triangles,
                                   const HolePatch& around);

} // namespace facetmill
