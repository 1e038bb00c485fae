#pragma once
// The neighbourhood that subdivision masks speak of, on a manifold, oriented mesh.

#include "geometry/split/split.hpp"
#include "mesh/topology.hpp"

namespace facetmill {

/// Halfedges are corners: corner c runs from its vertex to the next corner's. An edge is sharp when it has
/// one face or bends by more than the feature angle.
class SmoothRings {
  public:
    SmoothRings(const Mesh& mesh, const EdgeTable& edges, const SplitSettings& settings);

    const Mesh& mesh;
    const EdgeTable& edges;
    VertexLists corners; ///< at vertices

    Index next(Index c) const { return next_[c]; }
    Index previous(Index c) const { return previous_[c]; }
    /// The corner that runs the other way, or none at a boundary.
    Index twin(Index c) const { return twin_[c]; }
    Index from(Index c) const { return mesh.vertex(c); }
    Index to(Index c) const { return mesh.vertex(next_[c]); }
    bool is_sharp(Index e) const { return e == none || sharp_[e]; }
    /// The other ends of the sharp edges at a vertex, at most two of them; and how many there are.
    struct Sharp {
        Index ends[2] = {none, none};
        int count = 0;
    };
    Sharp sharp_at(Index v) const;
    bool is_boundary(Index e) const { return edges.corners_of(e).size() == 1; }
    /// Whether a smooth rule holds at the vertex: not on a boundary, and fewer than two sharp edges.
    bool is_smooth(Index v) const;

  private:
    std::vector<Index> next_, previous_, twin_;
    std::vector<std::uint8_t> sharp_;
};

} // namespace facetmill
