#pragma once
// Approximate convex decomposition of a solid or a surface.

#include "mesh/mesh.hpp"

namespace facetmill {

struct ConvexPartsSettings {
    std::size_t parts = 16; ///< the largest number of parts, at least 1
    double concavity = 0; ///< a part whose hull is nowhere farther from the solid stays whole; in mesh units
    std::size_t cells = std::size_t{1} << 19; ///< of the grid, about; up to four times as many for details
};

struct ConvexPart {
    std::vector<Vec3> points; ///< corners of the surface inside the part; their hull is the part
    double concavity = 0;     ///< the largest distance of a point of the hull from the solid
};

struct ConvexPartsResult {
    std::vector<ConvexPart> parts;
    double resolution = 0; ///< the size of a grid cell, which limits the precision of every concavity
    /// Every point of the surface is within this distance of the hull of a part: the rounding of cuts.
    double margin = 0;
};

/// Divides a surface into parts with small differences from their convex hulls.
///
/// A grid holds the solid: the cells that the surface touches, and those it
/// encloses. The part with the most concave hull is cut along a grid plane, until all hulls are close enough
/// to the solid. The plane leaves small hulls of the connected components on its two sides (see best_cut).
/// Then hulls are merged while their common hull is close enough, or while they are too many. Cuts along
/// planes follow K. Mamou, "Volumetric hierarchical approximate convex decomposition" (2016), and the
/// concavity as a distance follows X. Wei et al., "Approximate convex decomposition for 3D meshes with
/// collision-aware concavity and tree search" (2022), here also inside the hull.
///
/// The points of a part are the corners of the surface's triangles and their cuts with the planes, on a
/// lattice. Each piece of a triangle is in the hull of its own corners, except for rounding. This moves a
/// coordinate by little more than half the margin. So convex_hull with the margin contains the whole surface.
/// The result does not depend on the number of threads. Faces with points that are not finite are left out.
[[nodiscard]] ConvexPartsResult convex_parts(const Mesh& mesh, const ConvexPartsSettings& settings);

} // namespace facetmill
