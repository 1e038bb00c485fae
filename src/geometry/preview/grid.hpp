#pragma once
// Triangles between one vertex for each cell of a grid.

#include "mesh/mesh.hpp"

namespace facetmill {

/// The triangles of a mesh of triangles whose corners are in three cells of a grid of that edge in the world,
/// each corner by one of the cell: of its vertex that is nearest to the cell's centre. Each triangle of cells
/// comes once, in the order of their first. Corners of the mesh, three for each; points that are not finite
/// have no cell. After J. Rossignac and P. Borrel, "Multi-resolution 3D approximations for rendering complex
/// scenes" (1993). O(n).
[[nodiscard]] std::vector<Index> corners_in_cells(const Mesh& triangles, const Transform& to_world,
                                                  double cell);

} // namespace facetmill
