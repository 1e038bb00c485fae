#include "geometry/polygon/ring_tree.hpp"

#include <utility>

namespace facetmill::polygon {

std::vector<RingEdge> ring_edges(Rings rings) {
    std::vector<RingEdge> edges;
    std::size_t count = 0;
    for (const Ring ring : rings) count += ring.size();
    edges.reserve(count);
    for (std::size_t r = 0; r < rings.size(); ++r) {
        const Ring ring = rings[r];
        const auto first = static_cast<Index>(edges.size()), n = static_cast<Index>(ring.size());
        for (Index i = 0; i < n; ++i) {
            const Index next = i + 1 == n ? 0 : i + 1, previous = i == 0 ? n - 1 : i - 1;
            edges.push_back({ring[i], ring[next], static_cast<Index>(r), first + next, first + previous});
        }
    }
    return edges;
}

RingTree::RingTree(Rings rings) : edges_(ring_edges(rings)) {
    Index begin = 0;
    for (const Ring ring : rings)
        ring_begins_.push_back(std::exchange(begin, begin + static_cast<Index>(ring.size())));
    while (leaves_ * leaf_size < edges_.size()) leaves_ *= 2;
    nodes_.resize(2 * leaves_);
    for (std::size_t e = 0; e < edges_.size(); ++e) nodes_[leaves_ + e / leaf_size].add(bounds(edges_[e]));
    for (std::size_t i = leaves_ - 1; i > 0; --i) {
        nodes_[i].add(nodes_[2 * i]);
        nodes_[i].add(nodes_[2 * i + 1]);
    }
}

} // namespace facetmill::polygon
