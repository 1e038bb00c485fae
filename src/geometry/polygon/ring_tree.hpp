#pragma once
// A tree of boxes over the edges of rings, in their order. Neighbours along a ring are neighbours in the
// tree, so a single pass builds the tree, and searches for near edges are still fast.

#include "base/math/predicates.hpp"
#include "geometry/polygon/polygon.hpp"

namespace facetmill::polygon {

/// The exact side of the line a b that contains c: 1 left, -1 right, 0 on the line.
[[nodiscard]] inline int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y);
}

/// An edge, its ring, and the numbers of its neighbours in the ring.
struct RingEdge {
    Vec2 a, b;
    Index ring = 0, next = 0, previous = 0;
};

/// The edges of the rings, ring by ring.
[[nodiscard]] std::vector<RingEdge> ring_edges(Rings rings);

class RingTree {
  public:
    using Edge = RingEdge;
    struct Bounds {
        double x0 = HUGE_VAL, y0 = HUGE_VAL, x1 = -HUGE_VAL, y1 = -HUGE_VAL;
        void add(const Vec2& p) {
            x0 = p.x < x0 ? p.x : x0;
            x1 = p.x > x1 ? p.x : x1;
            y0 = p.y < y0 ? p.y : y0;
            y1 = p.y > y1 ? p.y : y1;
        }
        void add(const Bounds& o) {
            if (o.x0 <= o.x1) {
                add(Vec2{o.x0, o.y0});
                add(Vec2{o.x1, o.y1});
            }
        }
        bool meets(const Bounds& o) const { return x0 <= o.x1 && o.x0 <= x1 && y0 <= o.y1 && o.y0 <= y1; }
    };

    explicit RingTree(Rings rings);

    const std::vector<Edge>& edges() const { return edges_; }
    static Bounds bounds(const Edge& e) {
        Bounds b;
        b.add(e.a);
        b.add(e.b);
        return b;
    }
    /// Calls visit(edge number) for every edge whose box meets the box, ascending, until it returns false.
    template <class Visit>
    void query(const Bounds& box, Visit&& visit) const {
        if (!edges_.empty()) query(1, 0, leaves_, box, visit);
    }
    /// Calls visit(edge number) for edges whose boxes meet the ray from a point to the left, ascending,
    /// until it returns false. It visits the edges that reach above or below the point and some others.
    /// Returns whether an odd number of the unvisited edges, which are all on the left, pass the point's
    /// height. An end at this height counts as below it. Takes logarithmic time plus the time of the visits.
    template <class Visit>
    bool odd_on_left(const Vec2& p, Visit&& visit) const {
        bool odd = false;
        if (!edges_.empty()) odd_on_left(1, 0, leaves_, p, visit, odd);
        return odd;
    }

  private:
    template <class Visit>
    bool query(std::size_t node, std::size_t first, std::size_t width, const Bounds& box,
               Visit& visit) const {
        if (!nodes_[node].meets(box)) return true;
        if (width > 1)
            return query(2 * node, first, width / 2, box, visit) &&
                   query(2 * node + 1, first + width / 2, width / 2, box, visit);
        const std::size_t end = std::min(edges_.size(), (first + 1) * leaf_size);
        for (std::size_t e = first * leaf_size; e < end; ++e)
            if (bounds(edges_[e]).meets(box) && !visit(static_cast<Index>(e))) return false;
        return true;
    }

    template <class Visit>
    bool odd_on_left(std::size_t node, std::size_t first, std::size_t width, const Vec2& p, Visit& visit,
                     bool& odd) const {
        const Bounds& box = nodes_[node];
        if (!(box.x0 <= p.x && box.y0 <= p.y && p.y <= box.y1)) return true;
        if (box.x1 < p.x) {
            odd ^= odd_pass(first, width, p.y);
            return true;
        }
        if (width > 1)
            return odd_on_left(2 * node, first, width / 2, p, visit, odd) &&
                   odd_on_left(2 * node + 1, first + width / 2, width / 2, p, visit, odd);
        const std::size_t end = std::min(edges_.size(), (first + 1) * leaf_size);
        for (std::size_t e = first * leaf_size; e < end; ++e)
            if (bounds(edges_[e]).meets({-HUGE_VAL, p.y, p.x, p.y}) && !visit(static_cast<Index>(e)))
                return false;
        return true;
    }
    /// Whether an odd number of the edges below a node pass a height. Only the beginning and end of each
    /// chain of edges matter.
    bool odd_pass(std::size_t first, std::size_t width, double height) const {
        const auto is_below = [&](const Vec2& p) { return p.y <= height; };
        const Edge &begin = edges_[first * leaf_size],
                   &last = edges_[std::min(edges_.size(), (first + width) * leaf_size) - 1];
        const bool odd = is_below(begin.a) != is_below(last.b);
        if (begin.ring == last.ring) return odd;
        return odd !=
               (is_below(edges_[ring_begins_[begin.ring]].a) != is_below(edges_[ring_begins_[last.ring]].a));
    }

    static constexpr std::size_t leaf_size = 4;
    std::vector<Edge> edges_;
    std::vector<Index> ring_begins_; ///< [rings] first edge, an index into edges_
    std::vector<Bounds> nodes_;      ///< a heap: the children of i are 2i and 2i + 1
    std::size_t leaves_ = 1;         ///< number of leaves, a power of two
};

} // namespace facetmill::polygon
