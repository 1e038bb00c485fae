#pragma once
// The faces around a vertex, edge by edge.

#include "mesh/topology.hpp"

#include <algorithm>

namespace facetmill {

/// For one vertex after the other; keeps its memory.
class OneRing {
  public:
    /// Calls pair(c, d, agree) for two corners of the vertex whose faces are the only ones at an edge that
    /// ends in it. agree is true if the edge runs in opposite directions in them. In the order of the
    /// vertices at the other ends.
    template <class Pair>
    void pairs(const Mesh& mesh, const std::vector<Index>& face_of, std::span<const Index> corners,
               Pair&& pair) {
        edges_.clear();
        for (const Index c : corners) {
            const Index f = face_of[c], begin = mesh.face_begin(f), end = mesh.face_end(f);
            edges_.push_back({mesh.vertex(next_corner(c, begin, end)), c, true});
            edges_.push_back({mesh.vertex(previous_corner(c, begin, end)), c, false});
        }
        std::sort(edges_.begin(), edges_.end(), [](const RingEdge& a, const RingEdge& b) {
            return a.other != b.other ? a.other < b.other : a.corner < b.corner;
        });
        for (std::size_t i = 0; i < edges_.size();) {
            std::size_t j = i + 1;
            while (j < edges_.size() && edges_[j].other == edges_[i].other) ++j;
            if (j - i == 2) pair(edges_[i].corner, edges_[i + 1].corner, edges_[i].out != edges_[i + 1].out);
            i = j;
        }
    }

  private:
    struct RingEdge {
        Index other, corner;
        bool out; ///< the face runs from the vertex to the other
    };
    std::vector<RingEdge> edges_;
};

} // namespace facetmill
