#pragma once
// The faces around a vertex, edge by edge.

#include "mesh/topology.hpp"

#include <algorithm>

namespace facetmill {

/// Visits vertices one after the other, and reuses its memory.
class OneRing {
  public:
    /// Calls pair(c, d, agree) for each edge of the vertex with exactly two faces, where c and d are their
    /// corners at the vertex. agree is true if the faces run along the edge in opposite directions. The
    /// order is by the vertices at the other ends.
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
        bool out; ///< true if the face runs from the vertex to the other end
    };
    std::vector<RingEdge> edges_;
};

} // namespace facetmill
