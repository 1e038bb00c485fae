#pragma once
// Finds the grid plane that cuts cells into parts with small convex hulls.

#include "geometry/hull/voids.hpp"

#include <span>

namespace facetmill {

/// Connected cells of the solid, as a set of marks over the grid.
struct CellSet {
    CellBox box;
    std::uint32_t label = 0; ///< cells of the box with this label belong to the set
    std::size_t cells = 0;
};

/// The convex hull of the corners of the cells, each moved by less than 2^-20 cells. Most corners are
/// coplanar, which would make exact predicates slow.
[[nodiscard]] ConvexSurface hull_of_cells(const SolidGrid& grid, std::span<const std::uint32_t> labels,
                                          const CellSet& set);

/// The convex hull of the points that are farthest in some of 98 directions, moved like those of cells.
[[nodiscard]] ConvexSurface simple_hull(std::span<const Vec3> points);

struct GridCut {
    int axis = -1;           ///< -1: no plane cuts the set
    std::int32_t corner = 0; ///< cells below this position are on the first side
};

/// The plane that leaves the smallest share of the excess, which is the volume of the hulls less that of the
/// cells. The hulls are simple hulls of the connected components on both sides. A plane at the end of the set
/// counts as if it left a quarter of the excess more than one in the middle, because caps of a ring or of a
/// bowl have little excess, but leave the rest as concave as before. Where a layer has more than eight
/// components, fewer planes are tried. hull_volume: of the set.
[[nodiscard]] GridCut best_cut(const SolidGrid& grid, std::span<const std::uint32_t> labels,
                               const CellSet& set, double hull_volume);

} // namespace facetmill
