#pragma once
// Triangles and vertices in an order that graphics processors like, and that compresses well.

#include "io/gltf/encode/encode.hpp"

namespace facetmill::io::gltf {

/// Orders the triangles of each table, and the vertices by their first use. `draw` is for a cache of
/// transformed vertices (P. V. Sander, D. Nehab and J. Barczak, "Fast Triangle Reordering for Vertex Locality
/// and Reduced Overdraw", 2007, and T. Forsyth, "Linear-Speed Vertex Cache Optimisation", 2006, as
/// meshoptimizer has them), with groups that face outwards first; `size` tries several orders, mostly strips
/// (meshoptimizer's scores for strips), which have more neighbours behind each other, and takes the one of
/// which meshopt makes the fewest bytes; `strips` is one of these orders. shared: the tables have the same
/// wedges, and go on so. The faces, their corners' order and all attributes stay what they are. Adds to `use`
/// how often vertices are transformed before and after.
void order_triangles(const Mesh& mesh, std::vector<Table>& tables, TriangleOrder order, bool shared,
                     VertexCacheUse& use);

} // namespace facetmill::io::gltf
