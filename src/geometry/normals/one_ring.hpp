#pragma once
// The faces around a vertex, edge by edge.

#include "mesh/topology.hpp"

#include <algorithm>

namespace facetmill {

/// For one vertex after the other; keeps its memory.
class OneRing {
  public:
    /// Calls pair(c, d, agree) for two corners of the vertex whose faces are the only ones at an edge that
    /// ends there; agree says that the edge runs in opposite directions in them. In the order of the vertices
    /// at the other ends.
    template <class Pair>
    void pairs(const Mesh& mesh, const std::vector<Index>& face_of, std::span<const Index> corners,
               Pair&& pair) {
        spokes_.clear();
        for (const Index c : corners) {
            const Index f = face_of[c], begin = mesh.face_begin(f), end = mesh.face_end(f);
            spokes_.push_back({mesh.vertex(next_corner(c, begin, end)), c, true});
            spokes_.push_back({mesh.vertex(previous_corner(c, begin, end)), c, false});
        }
        std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
            return a.other != b.other ? a.other < b.other : a.corner < b.corner;
        });
        for (std::size_t i = 0; i < spokes_.size();) {
            std::size_t j = i + 1;
            while (j < spokes_.size() && spokes_[j].other == spokes_[i].other) ++j;
            if (j - i == 2)
                pair(spokes_[i].corner, spokes_[i + 1].corner, spokes_[i].out != spokes_[i + 1].out);
            i = j;
        }
    }

  private:
    struct Spoke {
        Index other, corner;
        bool out; ///< the face runs from the vertex to the other
    };
    std::vector<Spoke> spokes_;
};

} // namespace facetmill
