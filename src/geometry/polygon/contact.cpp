// Contacts between the edges of rings, by a sweep over their corners from left to right: M. I. Shamos and D.
// Hoey, "Geometric intersection problems" (1976). The sweep ends at the first crossing and also finds edges
// that touch. Every sign is exact, and computed from three corners; no point is constructed.
#include "geometry/polygon/ring_tree.hpp"

#include <algorithm>
#include <set>
#include <span>

namespace facetmill::polygon {

namespace {

/// Compares by x, then y. This acts as if the sweep line were slightly inclined, so that no edge is
/// vertical.
bool comes_before(const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// An edge of nonzero length, from its left end to its right end.
struct SweptEdge {
    Vec2 left, right;
};

/// 1 if the point is above the edge's line, -1 if below, 0 if on it.
int height_over(const SweptEdge& e, const Vec2& p) { return turn(e.left, e.right, p); }

/// Whether two edges cross in the interior of both.
bool cross_inside(const SweptEdge& e, const SweptEdge& f) {
    return height_over(e, f.left) * height_over(e, f.right) < 0 &&
           height_over(f, e.left) * height_over(f, e.right) < 0;
}

/// Orders edges on the sweep line from bottom to top, just after the line. The edges must not have crossed
/// before it. Edges that overlap just after the line are equal.
struct LowerOnLine {
    using is_transparent = void;
    bool operator()(const SweptEdge& e, const SweptEdge& f) const {
        return comes_before(f.left, e.left) ? order(f, e) < 0 : order(e, f) > 0;
    }
    /// Compares edges with points on the sweep line.
    bool operator()(const SweptEdge& e, const Vec2& p) const { return height_over(e, p) > 0; }
    bool operator()(const Vec2& p, const SweptEdge& e) const { return height_over(e, p) < 0; }

  private:
    /// 1 if the second edge is above the first. The first must not begin after the second.
    static int order(const SweptEdge& first, const SweptEdge& second) {
        const int at_left = height_over(first, second.left);
        return at_left != 0 ? at_left : height_over(first, second.right);
    }
};

/// Whether f, the edge after e, overlaps e from their common corner.
bool runs_back(const RingEdge& e, const RingEdge& f) {
    if (e.a == e.b || f.a == f.b || turn(e.a, e.b, f.b) != 0) return false;
    return comes_before(e.a, e.b) != comes_before(f.a, f.b);
}

/// Whether edges i and j touch at a point that is a corner of both.
bool touch_at_corner(const std::vector<RingEdge>& edges, Index i, Index j) {
    const RingEdge &e = edges[i], &f = edges[j];
    const bool after = e.next == j, before = e.previous == j;
    if (!after && !before) return true;
    return (after && runs_back(e, f)) || (before && runs_back(f, e));
}

/// Two edges that touch do so at an end of one of them, where the sweep finds the contact. Until the first
/// crossing, the edges that the line meets have an order. Two edges that cross next are neighbours in this
/// order before they cross, except edges that end at the crossing and are removed first.
class ContactSweep {
  public:
    explicit ContactSweep(const std::vector<RingEdge>& edges) : edges_(edges), order_(edges.size()) {
        for (Index i = 0; i < order_.size(); ++i) order_[i] = {edges[i].a, i};
        std::sort(order_.begin(), order_.end(), [](const Corner& a, const Corner& b) {
            return a.at == b.at ? a.edge < b.edge : comes_before(a.at, b.at);
        });
    }

    Contact run() {
        for (std::size_t i = 0; i < order_.size() && !crossing_;) {
            const Vec2 place = order_[i].at;
            here_.clear();
            for (; i < order_.size() && order_[i].at == place; ++i) {
                const Index edge = order_[i].edge, before = edges_[edge].previous;
                here_.push_back(edge);
                if (!(edges_[before].a == place)) here_.push_back(before);
            }
            visit(place);
        }
        return crossing_ ? Contact::crossing : touching_ ? Contact::touching : Contact::none;
    }

  private:
    struct Corner {
        Vec2 at;
        Index edge = 0; ///< the edge that begins at the corner
    };
    using OnLine = std::set<SweptEdge, LowerOnLine>;

    void visit(const Vec2& place) {
        touching_ = touching_ || touch_here();
        take_out(place);
        for (const Index edge : here_) {
            const RingEdge& e = edges_[edge];
            if (!(e.a == e.b) && !crossing_ && !comes_before(e.a, place) && !comes_before(e.b, place))
                put_in(e.a == place ? SweptEdge{e.a, e.b} : SweptEdge{e.b, e.a});
        }
    }

    /// Whether edges with a corner at this point meet in it without being neighbours.
    bool touch_here() const {
        if (here_.size() > 3) return true; // among four edges, two are not neighbours
        for (std::size_t i = 0; i < here_.size(); ++i)
            for (std::size_t j = i + 1; j < here_.size(); ++j)
                if (touch_at_corner(edges_, here_[i], here_[j])) return true;
        return false;
    }

    /// Removes edges that end at the point. Other edges through the point touch an edge with a corner at the
    /// point.
    void take_out(const Vec2& place) {
        auto at = on_line_.lower_bound(place);
        std::size_t through = 0;
        while (at != on_line_.end() && height_over(*at, place) == 0) {
            if (at->right == place) {
                at = on_line_.erase(at);
            } else {
                ++at;
                ++through;
            }
        }
        touching_ = touching_ || through > 0;
        crossing_ =
            crossing_ ||
            through >
                1; // two edges through the point are on different lines, because collinear edges are merged
        look_below(at);
        if (through > 0) look_below(std::prev(at));
    }

    /// Among collinear overlapping edges, only the edge that ends last stays, because it crosses every edge
    /// that the others would cross. So few edges go through a point.
    void put_in(const SweptEdge& e) {
        auto [at, alone] = on_line_.insert(e);
        if (!alone) {
            if (!comes_before(at->right, e.right)) return;
            at = on_line_.insert(on_line_.erase(at), e);
        }
        look_below(at);
        look_below(std::next(at));
    }

    /// Tests whether the edge crosses the edge below it.
    void look_below(OnLine::const_iterator at) {
        if (at == on_line_.begin() || at == on_line_.end()) return;
        crossing_ = crossing_ || cross_inside(*std::prev(at), *at);
    }

    const std::vector<RingEdge>& edges_;
    std::vector<Corner> order_;
    std::vector<Index> here_; ///< edges with a corner at the point
    OnLine on_line_;
    bool touching_ = false, crossing_ = false;
};

bool in_bounds(const Vec2& p, const SweptEdge& e) {
    return e.left.x <= p.x && p.x <= e.right.x && std::min(e.left.y, e.right.y) <= p.y &&
           p.y <= std::max(e.left.y, e.right.y);
}

bool lies_on(const SweptEdge& e, const Vec2& p) { return in_bounds(p, e) && height_over(e, p) == 0; }

/// The edges may have zero length.
Contact contact_of(const std::vector<RingEdge>& edges, Index i, Index j) {
    const RingEdge &e = edges[i], &f = edges[j];
    if (e.next == j || e.previous == j)
        return touch_at_corner(edges, i, j) ? Contact::touching : Contact::none;
    const auto swept = [](const RingEdge& g) {
        return comes_before(g.a, g.b) ? SweptEdge{g.a, g.b} : SweptEdge{g.b, g.a};
    };
    const SweptEdge s = swept(e), t = swept(f);
    if (s.right.x < t.left.x || t.right.x < s.left.x || std::max(e.a.y, e.b.y) < std::min(f.a.y, f.b.y) ||
        std::max(f.a.y, f.b.y) < std::min(e.a.y, e.b.y))
        return Contact::none;
    if (cross_inside(s, t)) return Contact::crossing;
    return lies_on(s, t.left) || lies_on(s, t.right) || lies_on(t, s.left) || lies_on(t, s.right)
               ? Contact::touching
               : Contact::none;
}

/// For faces with few corners, which are most: many times as fast as the sweep.
Contact contact_by_pairs(const std::vector<RingEdge>& edges) {
    Contact worst = Contact::none;
    for (Index i = 0; i < edges.size(); ++i)
        for (Index j = i + 1; j < edges.size() && worst != Contact::crossing; ++j)
            worst = std::max(worst, contact_of(edges, i, j));
    return worst;
}

constexpr std::size_t few_edges = 16;

} // namespace

Contact contact(Rings rings) {
    const std::vector<RingEdge> edges = ring_edges(rings);
    return edges.size() <= few_edges ? contact_by_pairs(edges) : ContactSweep(edges).run();
}

} // namespace facetmill::polygon
