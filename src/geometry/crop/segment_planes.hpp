#pragma once
// The planes of an outline's segments, and which vertices count as on which planes. For crop only.

#include "geometry/crop/view.hpp"

namespace facetmill {

/// The planes of the outline's segments, numbered behind those of a memory; those that are one have one
/// number.
struct SegmentPlanes {
    std::vector<Plane> planes;  ///< [segments]
    std::vector<Index> numbers; ///< [segments]
    std::vector<Index> first;   ///< [numbers, beyond those of the memory] the segment whose plane it is
    std::vector<Index> sharing; ///< [numbers] segments and entries of the memory

    SegmentPlanes(const CropView& view, const CutMemory& memory);
};

/// Which vertices count as on which planes.
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
    std::vector<Index> last_; ///< [vertices] into list_
    std::vector<Item> list_;
};

} // namespace facetmill
