#pragma once
// Counts the cells of a grid that a surface touches, to estimate the size of a wrap.

#include "mesh/surface.hpp"

namespace facetmill {

struct TouchedCells {
    std::size_t count = 0;
    double size = 0; ///< of a cell
};
/// Counts cells of at least this size, larger if the grid would have more than max_cells cells. Triangles
/// that are not finite are left out. Parallel.
[[nodiscard]] TouchedCells touched_cells(const Surface& surface, double size, std::size_t max_cells);

} // namespace facetmill
