// Computes nesting, roles and measures of the contours of a section.
#include "base/math/predicates.hpp"
#include "geometry/polygon/ring_tree.hpp"
#include "geometry/polygon/triangulate_rings.hpp"
#include "geometry/section/section.hpp"

#include <algorithm>

namespace facetmill {

namespace {

using polygon::Ring;
using polygon::RingTree;

/// Finds, for each ring, the rings that enclose it: a ray from one of its points crosses them an odd number
/// of times.
class Nesting {
  public:
    explicit Nesting(std::span<const Ring> rings) : rings_(rings), tree_(rings) {}

    /// The rings around ring r, ascending.
    std::vector<Index> around(Index r) const {
        std::vector<Index> found;
        for (const Vec2& p : rings_[r]) // uses the next point if this point is on another ring
            if (around(r, p, found)) break;
        return found;
    }

  private:
    bool around(Index r, const Vec2& p, std::vector<Index>& found) const {
        bool sure = true;
        found.clear();
        tree_.query({-HUGE_VAL, p.y, p.x, p.y}, [&](Index i) {
            const auto& e = tree_.edges()[i];
            if (e.ring == r) return true;
            const bool a_below = e.a.y <= p.y, b_below = e.b.y <= p.y;
            const int side = orientation_2d(e.a.x, e.a.y, e.b.x, e.b.y, p.x, p.y);
            sure = sure && !(side == 0 && RingTree::bounds(e).meets({p.x, p.y, p.x, p.y}));
            if (a_below != b_below && (side > 0) != a_below) found.push_back(e.ring);
            return true;
        });
        std::sort(found.begin(), found.end());
        std::size_t kept = 0;
        for (std::size_t i = 0; i < found.size();) {
            std::size_t end = i;
            while (end < found.size() && found[end] == found[i]) ++end;
            const Index ring = found[i];
            if ((end - i) % 2 == 1) found[kept++] = ring;
            i = end;
        }
        found.resize(kept);
        return sure;
    }

    std::span<const Ring> rings_;
    RingTree tree_;
};

void measure(Section& s, Contour& c, bool simple) {
    const Ring ring = s.ring(c);
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) c.length += length(ring[i + 1] - ring[i]);
    if (c.role == ContourRole::open) return;
    c.length += length(ring.front() - ring.back());
    c.area = polygon::signed_area(ring);
    if (!simple)
        c.kind = polygon::classify(ring);
    else if (!polygon::is_convex(ring))
        c.kind = polygon::Kind::concave;
    else
        c.kind = ring.size() == 3   ? polygon::Kind::triangle
                 : ring.size() == 4 ? polygon::Kind::quad
                                    : polygon::Kind::convex;
    if (c.kind != polygon::Kind::self_intersecting) {
        c.moments = polygon::moments(ring);
        return;
    }
    c.moments = polygon::moments_by_winding(ring);
    c.area = !c.moments ? 0 : c.orientation < 0 ? -c.moments->area : c.moments->area;
}

/// Whether outlines and holes cover each point at most once.
bool covers_once(const Section& s) {
    return s.contact != polygon::Contact::crossing &&
           std::all_of(s.contours.begin(), s.contours.end(), [](const Contour& c) {
               return (c.role == ContourRole::outline || c.role == ContourRole::hole) && c.moments &&
                      c.kind != polygon::Kind::self_intersecting;
           });
}

} // namespace

void arrange(Section& s) {
    std::vector<Ring> rings;
    std::vector<Index> contour_of;
    for (Index i = 0; i < s.contours.size(); ++i) {
        Contour& c = s.contours[i];
        if (c.role == ContourRole::open) continue;
        rings.push_back(s.ring(c));
        contour_of.push_back(i);
        c.orientation = polygon::orientation(rings.back());
    }
    const Nesting nesting(rings);
    std::vector<std::vector<Index>> around(rings.size());
    for (Index r = 0; r < rings.size(); ++r) around[r] = nesting.around(r);
    if (!s.oriented) // orients by nesting only: outlines anticlockwise, holes clockwise
        for (Index r = 0; r < rings.size(); ++r) {
            Contour& c = s.contours[contour_of[r]];
            const int wanted = around[r].size() % 2 == 0 ? 1 : -1;
            if (c.orientation != wanted) std::reverse(s.points.begin() + c.begin, s.points.begin() + c.end);
            c.orientation = wanted;
        }
    for (Index r = 0; r < rings.size(); ++r) {
        Contour& c = s.contours[contour_of[r]];
        int outside = 0;
        std::size_t depth = 0;
        for (const Index o : around[r]) {
            outside += s.contours[contour_of[o]].orientation;
            if (c.parent == none || around[o].size() > depth) {
                c.parent = contour_of[o];
                depth = around[o].size();
            }
        }
        const int inside = outside + c.orientation;
        c.role = outside == 0 ? ContourRole::outline : inside == 0 ? ContourRole::hole : ContourRole::inner;
    }
    s.contact = polygon::contact(rings);
    s.area = 0;
    for (Contour& c : s.contours) {
        measure(s, c, s.contact == polygon::Contact::none);
        s.area += c.area;
    }
    if (covers_once(s)) s.moments = polygon::moments(s.filled());
}

} // namespace facetmill
