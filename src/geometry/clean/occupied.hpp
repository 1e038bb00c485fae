#pragma once
// What a patch over a hole must not double.

#include "geometry/clean/steps.hpp"
#include "mesh/face.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace facetmill::clean_steps {

/// The edges and triangles that are there already, by place: vertices at one place count as one, so that a
/// patch fits even after they are welded.
class Occupied {
  public:
    explicit Occupied(const Mesh& mesh) : place_(lowest_at_place(mesh)) {
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
            for (Index c = begin; c < end; ++c)
                edges_.push_back(edge(mesh.vertex(c), mesh.vertex(next_corner(c, begin, end))));
            if (end - begin == 3)
                triangles_.push_back(
                    triangle({mesh.vertex(begin), mesh.vertex(begin + 1), mesh.vertex(begin + 2)}));
        }
        std::sort(edges_.begin(), edges_.end());
        std::sort(triangles_.begin(), triangles_.end());
    }
    bool has_edge(Index a, Index b) const {
        return std::binary_search(edges_.begin(), edges_.end(), edge(a, b)) ||
               new_edges_.contains(edge(a, b));
    }
    bool has_triangle(const std::array<Index, 3>& abc) const {
        const auto t = triangle(abc);
        return std::binary_search(triangles_.begin(), triangles_.end(), t) || new_triangles_.contains(t);
    }
    void add_edge(Index a, Index b) { new_edges_.insert(edge(a, b)); }
    void add_triangle(const std::array<Index, 3>& abc) { new_triangles_.insert(triangle(abc)); }

  private:
    std::pair<Index, Index> edge(Index a, Index b) const {
        return {std::min(place_[a], place_[b]), std::max(place_[a], place_[b])};
    }
    std::array<Index, 3> triangle(std::array<Index, 3> abc) const {
        for (Index& v : abc) v = place_[v];
        std::sort(abc.begin(), abc.end());
        return abc;
    }

    std::vector<Index> place_;
    std::vector<std::pair<Index, Index>> edges_;
    std::vector<std::array<Index, 3>> triangles_;
    std::set<std::pair<Index, Index>> new_edges_;
    std::set<std::array<Index, 3>> new_triangles_;
};

} // namespace facetmill::clean_steps
