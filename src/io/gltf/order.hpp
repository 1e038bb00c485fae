#pragma once
// Triangles and vertices in an order that graphics processors like, and that compresses well.

#include "io/gltf/encode.hpp"

namespace facetmill::io::gltf {

/// Orders the triangles of each table for a cache of transformed vertices (P. V. Sander, D. Nehab and J.
/// Barczak, "Fast Triangle Reordering for Vertex Locality and Reduced Overdraw", 2007, and T. Forsyth,
/// "Linear-Speed Vertex Cache Optimisation", 2006, as meshoptimizer has them), so that groups of them that
/// face outwards come first, and the vertices by their first use. shared: the tables have the same wedges,
/// and go on so. The faces, their corners' order and all attributes stay what they are. Adds to `use` how
/// often vertices are transformed before and after.
void order_for_caches(const Mesh& mesh, std::vector<Table>& tables, bool shared, VertexCacheUse& use);

} // namespace facetmill::io::gltf
