#pragma once
// Vertex positions of the smooth methods of split; the faces come from the same patterns as other methods.

#include "geometry/split/split.hpp"

namespace facetmill {

/// One pass of loop, butterfly, catmull_clark or sqrt3. pass counts from 0 (sqrt3 cuts boundary edges in
/// three in every second pass). The mesh must be manifold and oriented. All faces must be triangles, unless
/// the method is catmull_clark.
[[nodiscard]] Mesh split_smooth(const Mesh& mesh, const SplitSettings& settings, int pass,
                                AttributeChanges& changes);

/// Throws a stage error (E-MANIFOLD) if an edge has more than two faces, or two faces that run along it in
/// the same direction, or if several fans meet at a vertex.
void require_manifold(const Mesh& mesh, SplitMethod method);

} // namespace facetmill
