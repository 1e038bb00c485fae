#pragma once
// Orders triangles and vertices for graphics processors and for compression.

#include "io/gltf/encode/encode.hpp"

namespace facetmill::io::gltf {

/// Orders the triangles of each table, and the vertices by first use. `draw` optimises for a cache of
/// transformed vertices (P. V. Sander, D. Nehab and J. Barczak, "Fast Triangle Reordering for Vertex
/// Locality and Reduced Overdraw", 2007, and T. Forsyth, "Linear-Speed Vertex Cache Optimisation", 2006, as
/// implemented in meshoptimizer), with outward groups first. `size` tries several orders, mostly strips
/// (with meshoptimizer's scores for strips), because strips have more consecutive neighbours. It takes the
/// order with the fewest bytes in meshopt's streams. `strips` takes one of these orders without comparing.
/// shared: the tables share their wedges, before and after. Does not change the faces, their corners' order
/// or attributes. Adds the numbers of vertex transforms before and after to `use`.
void order_triangles(const Mesh& mesh, std::vector<Table>& tables, TriangleOrder order, bool shared,
                     VertexCacheUse& use);

/// True for orders that make meshopt's streams small.
[[nodiscard]] bool orders_points(TriangleOrder order);
/// The wedges of a cloud along a space-filling curve: neighbours then differ by little.
[[nodiscard]] std::vector<Index> points_along_curve(const Mesh& mesh);

} // namespace facetmill::io::gltf
