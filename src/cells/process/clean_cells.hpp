#pragma once
// The stage clean for a mesh in cells.
//
// The effect of clean on a vertex depends on the faces around it. It does nothing if these form a single fan
// of faces with nonzero area, where each edge has two faces in opposite directions. A scan of the cells
// finds all other positions. The faces at these are loaded and cleaned in memory, and the remaining faces
// stay unchanged. A collar (cells/process/border_closure.hpp) represents the rest of the mesh during the
// cleaning.

#include "cells/partition/partition.hpp"
#include "geometry/clean/clean.hpp"

namespace facetmill::cells {

/// The reason for messages why these settings need the whole mesh at once; none if they do not.
[[nodiscard]] std::optional<std::string> why_not_in_cells(const CleanSettings& settings);

struct CleanedCells {
    CleanResult result;                     ///< without the mesh
    double area_before = 0, area_after = 0; ///< areas after the transform
};

/// Cleans the cells. Faces, vertices and counts equal clean() in memory, except that cells have no vertices
/// without faces. The order of the faces changes if some faces changed. Throws a limit error (E-MEMORY) if
/// the faces at such positions exceed memory, and a usage error (E-CELLS) if vertices would get several sets
/// of attributes.
[[nodiscard]] CleanedCells clean_cells(std::unique_ptr<Partition>& partition, const CleanSettings& settings,
                                       const CellResources& means, const Transform& transform,
                                       std::uint64_t most = faces_of_cell);

} // namespace facetmill::cells
