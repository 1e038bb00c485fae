#pragma once
// New points on edges, shared by all faces of the edge, for the methods of split.

#include "mesh/provenance.hpp"
#include "mesh/topology.hpp"

#include <cstdint>

namespace facetmill {

/// The points that divide edges into equal parts. Vertices are numbered after the old vertices, edge by edge
/// and from the edge's low vertex to its high vertex. Wedges follow the same order, with one set per pair of
/// wedges along the edge.
class EdgePoints {
  public:
    /// Each edge gets pieces - 1 points, pieces >= 1. With marks (one per edge), only marked edges get
    /// points. With at (one per edge, pieces = 2), `at` gives the parameter of each point, measured from the
    /// edge's low vertex. Without `at`, points are at the middle.
    EdgePoints(const Mesh& mesh, const EdgeTable& edges, int pieces,
               const std::vector<std::uint8_t>& marks = {}, std::vector<double> at = {});

    /// The wedge of point i (1 .. pieces - 1, counted from corner c's own vertex) on the edge of corner c,
    /// which must have points. For an edge from a vertex to itself, this is the corner's own wedge.
    Index wedge(Index c, int i) const {
        const Index e = table_->corner_edge[c];
        if (e == none) return mesh_->corners[c];
        if (points_ == 1) return first_wedge_ + bundle(c, e);
        const bool up = mesh_->vertex(c) == table_->edges[e].low;
        return first_wedge_ + bundle(c, e) * static_cast<Index>(points_) +
               static_cast<Index>(up ? i - 1 : points_ - i);
    }

    std::size_t vertex_points() const { return edge_count_ * static_cast<std::size_t>(points_); }
    std::size_t wedge_points() const { return bundle_count_ * static_cast<std::size_t>(points_); }

    /// Appends the points to the provenances. Leaves wedges unchanged if the mesh has no seams.
    void describe(Provenance& vertices, Provenance& wedges) const;
    /// Appends the vertex of each wedge point. Only for meshes with seams.
    void append_wedge_vertices(std::vector<Index>& wedge_vertex) const;

  private:
    Index rank(Index e) const { return ranks_.empty() ? e : ranks_[e]; }
    Index bundle(Index c, Index e) const { return bundles_.empty() ? rank(e) : bundles_[c]; }
    void number_bundles();

    const Mesh* mesh_;
    const EdgeTable* table_;
    int points_; ///< number of points per edge
    Index first_wedge_;
    std::vector<Index> ranks_;   ///< [edges] number among the marked edges, or none; empty: all are marked
    std::vector<Index> bundles_; ///< [corners] number of the (edge, wedge pair); empty without seams
    std::vector<Index> bundle_corner_; ///< [bundles] the first corner
    std::vector<Index> next_;          ///< [corners] the next corner in the face; only with seams
    std::vector<double> at_;           ///< [edges] position of the point; empty: at the middle
    std::size_t edge_count_ = 0, bundle_count_ = 0;
};

} // namespace facetmill
