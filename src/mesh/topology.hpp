#pragma once
// Adjacency, computed on demand and never stored in the mesh. It is defined by vertices, not wedges.

#include "mesh/face.hpp"

#include <atomic>

namespace facetmill {

/// The undirected edges of a mesh, sorted by (low vertex, high vertex), and the corners that run along each.
/// Corner c of face f represents the edge from its vertex to the next corner's vertex in f. Edges from a
/// vertex to itself (degenerate faces) are left out.
struct EdgeTable {
    struct Edge {
        Index low, high; ///< vertices, low < high
    };
    std::vector<Edge> edges;           ///< [edges]
    std::vector<Index> corner_offsets; ///< [edges + 1] offsets into edge_corners
    std::vector<Index> edge_corners;   ///< corners along each edge, ascending
    std::vector<Index> corner_edge;    ///< [corners] edges, or none for a self edge

    std::size_t size() const { return edges.size(); }
    std::span<const Index> corners_of(Index e) const {
        return {edge_corners.data() + corner_offsets[e], edge_corners.data() + corner_offsets[e + 1]};
    }
};

/// Builds the edge table; parallel radix sort, O(corners). The result does not depend on the number of
/// threads.
[[nodiscard]] EdgeTable build_edges(const Mesh& mesh);

/// The face of each corner.
[[nodiscard]] std::vector<Index> corner_faces(const Mesh& mesh);

/// An edge of exactly one face.
struct BoundaryEdge {
    Index corner, face; ///< the corner that runs along it, and its face
    Index from, to;     ///< its vertices, in the direction of the face
};
/// The boundary edges, in the order of the edge table: by (low vertex, high vertex).
[[nodiscard]] std::vector<BoundaryEdge> boundary_edges(const Mesh& mesh);
/// The edges with one, three, five ... faces, where all faces except one may form pairs. An entry for each
/// face, in the order of the edge table.
[[nodiscard]] std::vector<BoundaryEdge> odd_edges(const Mesh& mesh);

/// For each vertex, the lowest vertex at exactly the same position (-0 is 0).
[[nodiscard]] std::vector<Index> lowest_at_place(const Mesh& mesh);

/// Lists per vertex in compressed form: items[offsets[v] .. offsets[v+1]].
struct VertexLists {
    std::vector<Index> offsets; ///< [vertices + 1] offsets
    std::vector<Index> items;
    std::span<const Index> of(Index v) const {
        return {items.data() + offsets[v], items.data() + offsets[v + 1]};
    }
};

/// The corners at each vertex, ascending.
[[nodiscard]] VertexLists corners_at_vertices(const Mesh& mesh);

/// The component of each face, and the number of components. Faces are connected if they share an edge or,
/// with by_vertex, a vertex. Components are numbered by first face.
struct Components {
    std::vector<Index> of_face;
    std::size_t count = 0;
};
[[nodiscard]] Components face_components(const Mesh& mesh, bool by_vertex = true);
/// Components of faces connected over edges.
[[nodiscard]] Components face_components(const Mesh& mesh, const EdgeTable& edges);
/// face_components(mesh).count, without the numbering.
[[nodiscard]] std::size_t component_count(const Mesh& mesh);

/// Sets that are joined from several threads at once. A root only ever points to a lower root. So the root
/// of a finished set is its lowest member, for any order of joins.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t n = 0);
    /// Adds a set with a single new member, and returns the member. No other thread may use the sets
    /// meanwhile.
    Index add();
    /// The lowest member known of i's set; final once all joins are done.
    Index find(Index i);
    void join(Index a, Index b) {
        if (parent_of(a) != parent_of(b)) join_apart(a, b);
    }
    /// The number of sets, once all joins are done.
    std::size_t count();

  private:
    Index parent_of(Index i) { return std::atomic_ref(parent_[i]).load(std::memory_order_relaxed); }
    void join_apart(Index a, Index b);

    std::vector<Index> parent_;
};

} // namespace facetmill
