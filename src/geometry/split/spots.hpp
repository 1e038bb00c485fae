#pragma once
// Spots of a mesh where cutting every face by itself is not enough: faces that share two edges, and faces
// that their pieces do not fit into. For the methods of split.

#include "geometry/split/split.hpp"
#include "mesh/quad_diagonal.hpp"
#include "mesh/topology.hpp"

namespace facetmill {

/// One byte per corner: 1 where another face has both edges of the corner too, so that a new edge between the
/// two would be theirs together. O(corners), parallel.
std::vector<std::uint8_t> shared_corners(const Mesh& mesh, const EdgeTable& edges);

/// How many vertices have such corners of two triangles at least, one of whose edges is marked (no marks: all
/// are): there the new edges of the triangles coincide. Of counted vertices (none given: of all).
std::size_t shared_cuts(const Mesh& mesh, const EdgeTable& edges, const std::vector<std::uint8_t>& marks,
                        const std::vector<std::uint8_t>& counted = {});

/// How many faces have a piece that looks the other way than the face: not convex ones where grid, halve or
/// varignon cut between edges; those that their centre (centre_weights) does not see all of where a method
/// cuts to it, because they have no kernel (of quads only those that cross themselves). 0 for the smooth
/// methods, and those that cut triangles or diagonals.
std::size_t folding_faces(const Mesh& mesh, SplitMethod method);

} // namespace facetmill
