#include "geometry/polygon/ring_tree.hpp"

namespace facetmill::polygon {

RingTree::RingTree(Rings rings) {
    for (std::size_t r = 0; r < rings.size(); ++r) {
        const Ring ring = rings[r];
        const auto first = static_cast<Index>(edges_.size()), n = static_cast<Index>(ring.size());
        for (Index i = 0; i < n; ++i)
            edges_.push_back({ring[i], ring[i + 1 == n ? 0 : i + 1], static_cast<Index>(r),
                              first + (i + 1) % n, first + (i + n - 1) % n});
    }
    while (leaves_ * leaf_size < edges_.size()) leaves_ *= 2;
    nodes_.resize(2 * leaves_);
    for (std::size_t e = 0; e < edges_.size(); ++e) nodes_[leaves_ + e / leaf_size].add(bounds(edges_[e]));
    for (std::size_t i = leaves_ - 1; i > 0; --i) {
        nodes_[i].add(nodes_[2 * i]);
        nodes_[i].add(nodes_[2 * i + 1]);
    }
}

} // namespace facetmill::polygon
