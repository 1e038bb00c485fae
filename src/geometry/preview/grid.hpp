#pragma once
// Reduces a mesh to triangles between grid cells, with a vertex for each cell.

#include "mesh/mesh.hpp"

namespace facetmill {

/// The triangles whose corners are in three different cells of a grid with this cell size in the world. The
/// vertex nearest to a cell's centre represents the cell. Each triangle of cells occurs once, in the order
/// of its first occurrence. Returns three corners of the mesh per triangle. Points that are not finite have
/// no cell. After J. Rossignac and P. Borrel, "Multi-resolution 3D approximations for rendering complex
/// scenes" (1993). O(n).
[[nodiscard]] std::vector<Index> corners_in_cells(const Mesh& triangles, const Transform& to_world,
                                                  double cell);

} // namespace facetmill
