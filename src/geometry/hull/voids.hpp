#pragma once
// The empty space inside a convex hull.

#include "geometry/cgal/convex_hull.hpp"
#include "geometry/spatial/solid_grid.hpp"

namespace facetmill {

/// The empty cells whose centres are inside a convex surface in cells.
struct Voids {
    double distance = 0; ///< the largest distance from the solid, in cells
    std::size_t cells = 0;
};
[[nodiscard]] Voids voids_of(const SolidGrid& grid, const ConvexSurface& hull);

} // namespace facetmill
