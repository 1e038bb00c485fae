#pragma once
// What a scene holds besides faces: point clouds, and vertices that no face uses.

#include "mesh/surface.hpp"

namespace facetmill {

/// The vertices that no face uses, of all parts in world space, each as a triangle of one point: distances to
/// them, and from them, are taken as those of a surface are. They have no face. In the order of parts and
/// vertices. Throws limit (E-LIMIT) when they cannot be numbered.
Surface unreferenced_points_of(const Scene& scene);

/// What distances of a scene are of: its surface, or, where it has no faces, its points. Throws as above.
Surface surface_or_points_of(const Scene& scene);

/// Both as one. Throws as above.
Surface joined(Surface a, const Surface& b);

} // namespace facetmill
