#pragma once
// Separates a surface at edges and vertices where it is not manifold.

#include "mesh/provenance.hpp"
#include "mesh/topology.hpp"

#include <set>
#include <utility>
#include <vector>

namespace facetmill {

/// The vertex of each corner, and the sources of the new vertices.
struct Fans {
    std::vector<Index> vertex_of_corner; ///< [corners] vertices
    std::vector<Index> copies;           ///< new vertices, numbered from the vertex count on
};
/// Separates fans. At an edge with more than two faces, faces with the inside of the surface between them
/// stay together, by the exact order around the edge. Faces of sheets with a boundary come after all others.
/// Each fan of faces around a vertex gets its own vertex.
[[nodiscard]] Fans disjoint_fans(const Mesh& mesh);
[[nodiscard]] Fans disjoint_fans(const Mesh& mesh, const EdgeTable& edges); ///< the same, with known edges

/// Gives each fan of disjoint_fans its own vertex. parted: the number of added vertices. Returns the edges
/// of the result.
[[nodiscard]] EdgeTable part_fans(Mesh& mesh, std::size_t& parted);

struct EdgeDivision {
    /// The first pair of faces also gets its own point, so that no point is in the middle of its edge.
    bool all = false;
    bool single = false; ///< points are rounded to 32-bit floats, if these are finite
    std::set<std::pair<Index, Index>> leave = {}; ///< edges (low vertex, high vertex) that stay unchanged
};

struct DividedEdges {
    struct Edge {
        Index low, high; ///< the vertices of the edge, which stay
        Vec3 point;
        bool beside; ///< the rounded point is not on the edge, so faces have moved
    };
    Mesh mesh; ///< empty if no edge was divided
    AttributeChanges changes;
    std::vector<Edge> edges;
    std::vector<Index> edge_of_point; ///< [new vertices, which are the last of the mesh] index into edges
    std::vector<Index> parents;       ///< [faces of the mesh] the source face of each face or piece
};
/// Divides the edges of more than two faces that remain after fans are separated, because other faces
/// connect both ends. Every pair of faces except the first, and every face left over, gets a point in the
/// middle of the edge, with interpolated attributes. If the point cannot be exactly on the edge, the first
/// pair also gets a point at the same position. Otherwise the edge of a face would miss another face's
/// corner.
[[nodiscard]] DividedEdges divide_crowded_edges(const Mesh& mesh, const EdgeTable& edges,
                                                const EdgeDivision& how);

/// The mesh with separated fans, and with the remaining crowded edges divided.
[[nodiscard]] Mesh split_non_manifold(Mesh mesh);

} // namespace facetmill
