#pragma once
// Spots of a mesh where cutting each face separately fails: faces that share two edges, and faces that do
// not contain their pieces. Used by the methods of split.

#include "geometry/split/split.hpp"
#include "mesh/quad_diagonal.hpp"
#include "mesh/topology.hpp"

namespace facetmill {

/// A byte per corner: 1 if another face also has both edges of the corner. A new edge between the two edges
/// would then belong to both faces. O(corners), parallel.
[[nodiscard]] std::vector<std::uint8_t> shared_corners(const Mesh& mesh, const EdgeTable& edges);

/// The number of vertices at which new edges of triangles coincide: at least two triangles have such
/// corners, with a marked edge (without marks: any edge). Only flagged vertices count (empty: all).
[[nodiscard]] std::size_t shared_cuts(const Mesh& mesh, const EdgeTable& edges,
                                      const std::vector<std::uint8_t>& marks,
                                      const std::vector<std::uint8_t>& counted = {});

/// The number of faces with a piece that faces against the whole face. For grid, halve and varignon, which
/// cut between edges, these are the non-convex faces. For methods that cut to the centre (centre_weights),
/// these are faces without a kernel (only self-intersecting quads). 0 for the smooth methods, and for
/// methods that cut triangles or diagonals.
[[nodiscard]] std::size_t folding_faces(const Mesh& mesh, SplitMethod method);

} // namespace facetmill
