#pragma once
// A tree of boxes over the edges of rings, in their order: neighbours along a ring are neighbours in the
// tree, so it is built in one pass and still finds what is near quickly.

#include "base/predicates.hpp"
#include "geometry/polygon/polygon.hpp"

namespace facetmill::polygon {

/// The side of the line a b on which c lies, exactly: 1 on its left, -1 on its right, 0 on it.
inline int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y);
}

/// An edge, its ring, and the numbers of its neighbours along that.
struct RingEdge {
    Vec2 a, b;
    Index ring = 0, next = 0, previous = 0;
};

/// The edges of the rings, one after the other.
std::vector<RingEdge> ring_edges(Rings rings);

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

    static constexpr std::size_t leaf_size = 4;
    std::vector<Edge> edges_;
    std::vector<Bounds> nodes_; ///< a heap: the children of i are 2i and 2i + 1
    std::size_t leaves_ = 1;    ///< a power of two
};

} // namespace facetmill::polygon
