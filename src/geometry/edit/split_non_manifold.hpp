#pragma once
// Edges and vertices taken apart where a surface is not a manifold.

#include "mesh/provenance.hpp"
#include "mesh/topology.hpp"

#include <set>
#include <utility>
#include <vector>

namespace facetmill {

/// The vertex of each corner, and the sources of the new vertices.
struct Fans {
    std::vector<Index> vertex_of_corner; ///< [corners]
    std::vector<Index> copies;           ///< new vertices, numbered from the vertex count on
};
/// At an edge of more than two faces, faces with the inside of the surface between them stay together, by
/// the exact order around the edge. Faces of sheets with a boundary come after all others. Each fan of faces
/// around a vertex gets its own vertex.
[[nodiscard]] Fans disjoint_fans(const Mesh& mesh);
[[nodiscard]] Fans disjoint_fans(const Mesh& mesh, const EdgeTable& edges); ///< given its edges

/// Gives each fan of disjoint_fans its own vertex; `parted`: how many vertices that adds. The edges of the
/// result.
[[nodiscard]] EdgeTable part_fans(Mesh& mesh, std::size_t& parted);

struct EdgeDivision {
    /// The first pair of faces also gets its own point, so that no point is in the middle of its edge.
    bool all = false;
    bool single = false; ///< points are rounded to 32-bit floats, where these are finite
    std::set<std::pair<Index, Index>> leave = {}; ///< edges (low vertex, high vertex) that stay as they are
};

struct DividedEdges {
    struct Edge {
        Index low, high; ///< its vertices, which stay
        Vec3 point;
        bool beside; ///< the point, as rounded, is not within the edge: faces have moved
    };
    Mesh mesh; ///< empty when no edge was divided
    AttributeChanges changes;
    std::vector<Edge> edges;
    std::vector<Index> edge_of_point; ///< [new vertices, the last of the mesh] into edges
    std::vector<Index> parents;       ///< [faces of the mesh] the faces that they were or are a piece of
};
/// Divides the edges of more than two faces that remain after fans are separated, because other faces
/// connect both ends. Every pair of faces except the first, and every face left over, gets a point in the
/// middle of the edge, with interpolated attributes. If the point cannot be exactly on the edge, the first
/// pair also gets a point at the same position, because no face may pass off another's corner.
[[nodiscard]] DividedEdges divide_crowded_edges(const Mesh& mesh, const EdgeTable& edges,
                                                const EdgeDivision& how);

/// The mesh with its fans parted and the crowded edges that are left divided.
[[nodiscard]] Mesh split_non_manifold(Mesh mesh);

} // namespace facetmill
