#pragma once
// Edges and vertices taken apart where a surface is not a manifold.

#include "mesh/provenance.hpp"
#include "mesh/topology.hpp"

#include <set>
#include <utility>
#include <vector>

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

/// Gives each fan of disjoint_fans its own vertex; `parted`: how many vertices that adds. The edges of the
/// result.
EdgeTable part_fans(Mesh& mesh, std::size_t& parted);

struct EdgeDivision {
    /// The first pair of faces gets a point of its own, too, so that none lies in the middle of its edge.
    bool all = false;
    bool single = false; ///< points have coordinates of 32-bit floats, as far as those are finite
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
/// Edges of more than two faces that are left once fans are parted, since other faces hold both ends
/// together: every pair of faces but the first, and every face left over, gets a point in the middle of the
/// edge, with interpolated attributes. Where the point cannot lie exactly on the edge the first pair gets one
/// too, at the same place, as no face may pass beside another's corner.
DividedEdges divide_crowded_edges(const Mesh& mesh, const EdgeTable& edges, const EdgeDivision& how);

/// The mesh with its fans parted and the crowded edges that are left divided.
Mesh split_non_manifold(Mesh mesh);

} // namespace facetmill
