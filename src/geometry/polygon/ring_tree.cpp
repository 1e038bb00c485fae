#include "geometry/polygon/ring_tree.hpp"

#include "base/predicates.hpp"

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

namespace {

using Edge = RingTree::Edge;

bool in_box(const Vec2& p, const Edge& e) {
    const auto b = RingTree::bounds(e);
    return b.x0 <= p.x && p.x <= b.x1 && b.y0 <= p.y && p.y <= b.y1;
}

/// e then f share the point e.b == f.a; do they run back along each other?
bool runs_back(const Edge& e, const Edge& f) {
    return turn(e.a, e.b, f.b) == 0 && dot(e.b - e.a, f.b - f.a) < 0;
}

Contact contact_of(const Edge& e, const Edge& f) {
    const int ea = turn(f.a, f.b, e.a), eb = turn(f.a, f.b, e.b), fa = turn(e.a, e.b, f.a),
              fb = turn(e.a, e.b, f.b);
    if (ea * eb < 0 && fa * fb < 0) return Contact::crossing;
    const bool touch = (ea == 0 && in_box(e.a, f)) || (eb == 0 && in_box(e.b, f)) ||
                       (fa == 0 && in_box(f.a, e)) || (fb == 0 && in_box(f.b, e));
    return touch ? Contact::touching : Contact::none;
}

} // namespace

Contact contact(Rings rings) {
    const RingTree tree(rings);
    const auto& edges = tree.edges();
    Contact worst = Contact::none;
    for (Index i = 0; i < edges.size() && worst != Contact::crossing; ++i) {
        const Edge& e = edges[i];
        tree.query(RingTree::bounds(e), [&](Index j) {
            if (j <= i) return true;
            const Edge& f = edges[j];
            const bool after = e.next == j, before = e.previous == j;
            if (after || before) {
                if ((after && runs_back(e, f)) || (before && runs_back(f, e)))
                    worst = std::max(worst, Contact::touching);
            } else {
                worst = std::max(worst, contact_of(e, f));
            }
            return worst != Contact::crossing;
        });
    }
    return worst;
}

} // namespace facetmill::polygon
