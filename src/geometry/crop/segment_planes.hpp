#pragma once
// The planes of an outline's segments, and the vertices that count as on each plane. Only crop uses it.

#include "geometry/crop/view.hpp"

namespace facetmill {

/// The planes of the outline's segments, numbered after the planes of a memory. Equal planes share a number.
struct SegmentPlanes {
    std::vector<Plane> planes;  ///< [segments] planes
    std::vector<Index> numbers; ///< [segments] numbers of the planes
    std::vector<Index> first;   ///< [numbers after the memory's] the first segment with this plane
    std::vector<Index> sharing; ///< [numbers] how many segments and memory entries have this plane

    SegmentPlanes(const CropView& view, const CutMemory& memory);
};

/// The planes that each vertex counts as on.
class OnPlanes {
  public:
    void grow(std::size_t vertices) { last_.resize(vertices, none); }
    bool has(Index vertex, Index plane) const {
        for (Index i = last_[vertex]; i != none; i = list_[i].next)
            if (list_[i].plane == plane) return true;
        return false;
    }
    void add(Index vertex, Index plane) {
        if (has(vertex, plane)) return;
        list_.push_back({plane, last_[vertex]});
        last_[vertex] = static_cast<Index>(list_.size() - 1);
    }
    template <class Visit>
    void for_planes(Index vertex, Visit&& visit) const {
        for (Index i = last_[vertex]; i != none; i = list_[i].next) visit(list_[i].plane);
    }

  private:
    struct Item {
        Index plane, next;
    };
    std::vector<Index> last_; ///< [vertices] the last entry, an index into list_
    std::vector<Item> list_;
};

} // namespace facetmill
