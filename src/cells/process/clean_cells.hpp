#pragma once
// clean, of a mesh in cells.
//
// What clean does with a vertex depends on the faces around it; where those are one fan of faces with area,
// each edge with two faces that run opposite ways, it does nothing. So the places where that does not hold
// are found in the cells, all faces at these places are brought into memory and cleaned there, and the others
// stay as they are. A collar (cells/process/border_closure.hpp) stands for the rest of the mesh meanwhile.

#include "cells/partition/partition.hpp"
#include "geometry/clean/clean.hpp"

namespace facetmill::cells {

/// Why these settings need the whole mesh at once, in words; none when they do not.
std::optional<std::string> why_not_in_cells(const CleanSettings& settings);

struct CleanedCells {
    CleanResult result;                     ///< without the mesh
    double area_before = 0, area_after = 0; ///< where the transform puts the mesh
};

/// Cleans the cells: the faces and vertices are those of clean() in memory, and so are counts, but that
/// vertices without faces are in no cells. Faces get another order where some have changed. Throws limit
/// (E-MEMORY) where the faces at such places are more than memory takes; usage (E-CELLS) where vertices would
/// get several sets of attributes.
CleanedCells clean_cells(std::unique_ptr<Partition>& partition, const CleanSettings& settings,
                         const CellResources& means, const Transform& transform,
                         std::uint64_t most = faces_of_cell);

} // namespace facetmill::cells
