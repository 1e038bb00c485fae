#pragma once
// Patches a hole with the density and curvature of its surroundings. This header does not include CGAL,
// which does the work.

#include "mesh/mesh.hpp"

#include <array>
#include <vector>

namespace facetmill {

/// Triangles on an outline. Corners below the outline's size are its points, the others points[corner -
/// size].
struct HolePatch {
    std::vector<std::array<Index, 3>> triangles;
    std::vector<Vec3> points;
};

/// The patch (of the outline's points only) refined to the density of the outline (P. Liepa, "Filling holes
/// in meshes", 2003) and faired (M. Botsch and O. Sorkine, "On linear variational surface deformation
/// methods", 2008) so that it goes on from the faces around it with continuous tangents. As it was where the
/// faces around are no manifold, or fairing fails. The same for the same input.
[[nodiscard]] HolePatch fair_patch(const std::vector<Vec3>& outline,
                                   const std::vector<std::array<Index, 3>>& triangles,
                                   const HolePatch& around);

} // namespace facetmill
