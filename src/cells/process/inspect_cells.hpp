#pragma once
// The properties of a mesh in cells, equal to those of the mesh in memory.
//
// Every edge and vertex is counted where all of its faces are known (cells/partition/cell_border_walk.hpp):
// inside a cell; or, of a border that cells share, at the node of the tree where all cells with it come
// together.

#include "cells/partition/partition.hpp"
#include "geometry/inspect/inspect.hpp"

namespace facetmill::cells {

/// Whether the property can be had so: counts, how the surface hangs together, area, volume, bounds, unit and
/// axis.
bool inspects(const Property& property);

/// The box around the cells where the transform puts them. Where that turns axes into axes it is that of
/// their own box, else the cells are read.
Box box_of_cells(const Partition& partition, const Transform& transform);

/// The values of these properties (others are as of an empty mesh), of the cells where the transform puts
/// them. Area and volume are sums in the order of the cells, so they may differ from those in memory in the
/// last digits. Throws output (E-SCRATCH); limit (E-MEMORY) where the faces at borders are more than memory
/// takes, as those of one vertex that a million faces have.
Properties inspect_cells(const Partition& partition, const Transform& transform, const CellResources& means);

} // namespace facetmill::cells
