#pragma once
// Where the smooth methods of split put vertices; the faces come from the same patterns as the others'.

#include "geometry/split/split.hpp"

namespace facetmill {

/// One pass of loop, butterfly, catmull_clark or sqrt3; pass counts from 0 (sqrt3 cuts boundary edges in
/// three in every second one). The mesh must be manifold, oriented, and of triangles but for catmull_clark.
Mesh split_smooth(const Mesh& mesh, const SplitSettings& settings, int pass, AttributeChanges& changes);

/// Throws stage (E-MANIFOLD) when the mesh has an edge of more than two faces or of two that run along it the
/// same way, or a vertex where several fans meet.
void require_manifold(const Mesh& mesh, SplitMethod method);

} // namespace facetmill
