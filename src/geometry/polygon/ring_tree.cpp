#include "geometry/polygon/ring_tree.hpp"

#include "base/predicates.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace facetmill::polygon {

RingTree::RingTree(Rings rings) {
    for (std::size_t r = 0; r < rings.size(); ++r) {
        const Ring ring = rings[r];
        const auto first = static_cast<Index>(edges_.size()), n = static_cast<Index>(ring.size());
        for (Index i = 0; i < n; ++i)
            edges_.push_back({ring[i], ring[i + 1 == n ? 0 : i + 1], static_cast<Index>(r),
                              first + (i + 1) % n, first + (i + n - 1) % n});
    }
    index();
}

RingTree::RingTree(std::vector<Edge> edges) : edges_(std::move(edges)) { index(); }

void RingTree::index() {
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

Contact contact_of(const std::vector<Edge>& edges, Index i, Index j) {
    const Edge &e = edges[i], &f = edges[j];
    const bool after = e.next == j, before = e.previous == j;
    if (!after && !before) return contact_of(e, f);
    return (after && runs_back(e, f)) || (before && runs_back(f, e)) ? Contact::touching : Contact::none;
}

/// The ends of an edge, whichever way it runs.
std::array<double, 4> ends_of(const Edge& e) {
    const bool turned = e.b.x < e.a.x || (e.b.x == e.a.x && e.b.y < e.a.y);
    const Vec2 &from = turned ? e.b : e.a, &to = turned ? e.a : e.b;
    return {from.x, from.y, to.x, to.y};
}

/// How edges with the same ends meet. different: one of each such set, in their order. A set of four and more
/// has two that are no neighbours, so few pairs are looked at.
Contact contact_of_equals(const std::vector<Edge>& edges, std::vector<Edge>& different) {
    std::vector<Index> order(edges.size()), firsts;
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Index i, Index j) { return ends_of(edges[i]) < ends_of(edges[j]); });
    Contact worst = Contact::none;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        firsts.push_back(order[begin]);
        while (end < order.size() && ends_of(edges[order[end]]) == ends_of(edges[order[begin]])) ++end;
        for (std::size_t i = begin; i < end && worst == Contact::none; ++i)
            for (std::size_t j = i + 1; j < end && worst == Contact::none; ++j)
                worst = contact_of(edges, order[i], order[j]);
    }
    std::sort(firsts.begin(), firsts.end());
    for (const Index i : firsts) different.push_back(edges[i]);
    return worst;
}

bool share_an_end(const Edge& e, const Edge& f) {
    return e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b;
}

/// Whether two of the edges cross. Edges with a common end never do.
bool any_cross(const RingTree& tree) {
    const auto& edges = tree.edges();
    bool cross = false;
    for (Index i = 0; i < edges.size() && !cross; ++i)
        tree.query(RingTree::bounds(edges[i]), [&](Index j) {
            cross = j > i && !share_an_end(edges[i], edges[j]) &&
                    contact_of(edges[i], edges[j]) == Contact::crossing;
            return !cross;
        });
    return cross;
}

} // namespace

Contact contact(Rings rings) {
    const RingTree tree(rings);
    const auto& edges = tree.edges();
    std::vector<Edge> different;
    if (contact_of_equals(edges, different) != Contact::none) // a ring may run over few edges many times
        return any_cross(RingTree(std::move(different))) ? Contact::crossing : Contact::touching;
    Contact worst = Contact::none;
    for (Index i = 0; i < edges.size() && worst != Contact::crossing; ++i)
        tree.query(RingTree::bounds(edges[i]), [&](Index j) {
            if (j > i) worst = std::max(worst, contact_of(edges, i, j));
            return worst != Contact::crossing;
        });
    return worst;
}

} // namespace facetmill::polygon
