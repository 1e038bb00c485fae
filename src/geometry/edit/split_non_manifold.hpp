#pragma once
// Edges and vertices taken apart where a surface is not a manifold.

#include "mesh/topology.hpp"

namespace facetmill {

/// The vertex that each corner goes to, and what the new vertices are copies of.
struct Fans {
    std::vector<Index> vertex_of_corner; ///< [corners]
    std::vector<Index> copies;           ///< new vertices, numbered from the vertex count on
};
/// At an edge of more than two faces those stay together that have the inside of the surface between them, by
/// the exact order around the edge, those of sheets with a boundary after all others; each fan of faces
/// around a vertex gets a vertex of its own.
Fans disjoint_fans(const Mesh& mesh);
Fans disjoint_fans(const Mesh& mesh, const EdgeTable& edges); ///< given its edges

struct NonManifoldSplit {
    Mesh mesh;
    AttributeChanges changes; ///< empty when nothing was mixed
    std::size_t split_vertices = 0, split_edges = 0;
    bool changed() const { return split_vertices + split_edges > 0; }
};
/// The mesh with each fan of disjoint_fans on its own vertices. Where both ends of an edge of more than two
/// faces are held together by other faces, every pair but the first gets a point in the middle of the edge;
/// attributes are interpolated there. With `divide_all` the first pair, too, gets a point of its own, so that
/// none lies in the middle of another's edge.
NonManifoldSplit split_non_manifold(Mesh mesh, bool divide_all = false);

} // namespace facetmill
