#pragma once
// Measures the properties of a mesh in cells. They equal the properties of the mesh in memory.
//
// Every edge and vertex is counted when all of its faces are known (cells/partition/cell_border_walk.hpp).
// This is inside a cell, or, on a border between cells, at the tree node where all cells with it meet.

#include "cells/partition/partition.hpp"
#include "geometry/inspect/inspect.hpp"

namespace facetmill::cells {

/// Whether cells support the property: counts, connectivity, area, volume, bounds, unit and axis.
bool inspects(const Property& property);

/// The bounding box of the transformed cells. If the transform maps axes to axes, it follows from their own
/// box; otherwise the cells are read.
[[nodiscard]] Box box_of_cells(const Partition& partition, const Transform& transform);

/// The supported properties of the transformed cells; others have the values of an empty mesh. Area and
/// volume are summed in cell order, so the last digits may differ from the mesh in memory. Throws an output
/// error (E-SCRATCH), and a limit error (E-MEMORY) if the faces at borders exceed memory, for example at a
/// vertex of a million faces.
[[nodiscard]] Properties inspect_cells(const Partition& partition, const Transform& transform,
                                       const CellResources& means);

} // namespace facetmill::cells
