#include "geometry/polygon/footprint.hpp"

#include "base/error.hpp"
#include "base/math/predicates.hpp"
#include "base/text/readable_numbers.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

using polygon::RingTree;
using polygon::turn;

[[noreturn]] void refuse(std::string message, std::string hint = {}) {
    throw Error(ErrorKind::usage, "E-FOOTPRINT", std::move(message), std::move(hint));
}

void tidy(std::vector<Vec2>& ring, std::size_t number) {
    for (const Vec2& p : ring)
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
            refuse(fmt::format("ring {} of the footprint has a corner that is not finite", number));
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() < 3)
        refuse(fmt::format("ring {} of the footprint has {} corners, and a ring needs three", number,
                           ring.size()),
               "give the corners in order; the last one is joined to the first");
}

std::vector<std::vector<Vec2>> tidied(std::vector<std::vector<Vec2>> rings) {
    if (rings.empty()) refuse("the footprint has no rings");
    for (std::size_t i = 0; i < rings.size(); ++i) tidy(rings[i], i + 1);
    return rings;
}

/// Reports the first point where two segments cross.
void refuse_crossings(const RingTree& tree, polygon::Rings rings) {
    if (polygon::contact(rings) != polygon::Contact::crossing)
        return; // fast even for a star, whose boxes meet
    const auto& edges = tree.edges();
    for (Index i = 0; i < edges.size(); ++i)
        tree.query(RingTree::bounds(edges[i]), [&](Index j) {
            const auto &e = edges[i], &f = edges[j];
            const int ea = turn(f.a, f.b, e.a), eb = turn(f.a, f.b, e.b), fa = turn(e.a, e.b, f.a),
                      fb = turn(e.a, e.b, f.b);
            if (j <= i || ea * eb >= 0 || fa * fb >= 0) return true;
            const double a = cross(e.b - e.a, f.a - e.a), b = cross(e.b - e.a, f.b - e.a);
            const Vec2 at = f.a + (f.b - f.a) * (a / (a - b));
            refuse(fmt::format("the footprint intersects itself near ({}): the segments from ({}) to ({}) "
                               "and from ({}) to ({})",
                               readable_pair(at.x, at.y), readable_pair(e.a.x, e.a.y),
                               readable_pair(e.b.x, e.b.y), readable_pair(f.a.x, f.a.y),
                               readable_pair(f.b.x, f.b.y)),
                   "repair the outline, or crop by each of its simple parts in turn");
        });
}

std::vector<polygon::Ring> spans_of(const std::vector<std::vector<Vec2>>& rings) {
    return {rings.begin(), rings.end()};
}

} // namespace

Footprint::Footprint(std::vector<std::vector<Vec2>> rings)
    : rings_(tidied(std::move(rings))), tree_(spans_of(rings_)) {
    refuse_crossings(tree_, spans_of(rings_));
    for (std::size_t i = 0; i < rings_.size(); ++i) {
        const int way = polygon::orientation(rings_[i]);
        if (way == 0)
            refuse(fmt::format("ring {} of the footprint has no area", i + 1), "its corners are on one line");
        int depth = 0;
        for (std::size_t k = 0; k < rings_.size(); ++k) {
            if (k == i) continue;
            auto place =
                polygon::PointLocation::on_edge; // the location of the first corner that is not on an edge
            for (std::size_t c = 0; c < rings_[i].size() && place > polygon::PointLocation::inside; ++c)
                place = polygon::locate(rings_[i][c], rings_[k]);
            depth += place == polygon::PointLocation::inside;
        }
        if ((depth % 2 == 0) != (way > 0)) std::reverse(rings_[i].begin(), rings_[i].end());
    }
    tree_ = RingTree(spans());
}

polygon::PointLocation Footprint::locate(const Vec2& p) const {
    using polygon::PointLocation;
    bool inside = false;
    PointLocation on = PointLocation::outside;
    const bool odd = tree_.odd_on_left(p, [&](Index i) {
        const auto& e = tree_.edges()[i];
        if (e.a == p) {
            on = PointLocation::on_vertex;
            return false;
        }
        const bool a_below = e.a.y <= p.y, b_below = e.b.y <= p.y;
        if (a_below == b_below) {
            if (e.a.y == p.y && e.b.y == p.y && (e.a.x <= p.x) != (e.b.x <= p.x)) on = PointLocation::on_edge;
            return true;
        }
        if (std::max(e.a.x, e.b.x) < p.x) { // the whole edge is on the left
            inside = !inside;
            return true;
        }
        const int side = turn(e.a, e.b, p);
        if (side == 0) on = PointLocation::on_edge;
        if ((side > 0) != a_below) inside = !inside;
        return true;
    });
    return on != PointLocation::outside ? on : inside != odd ? PointLocation::inside : PointLocation::outside;
}

double Footprint::area() const {
    double sum = 0;
    for (const auto& ring : rings_) sum += polygon::signed_area(ring);
    return sum;
}

OutlineMeeting meeting(std::span<const Vec2> face, const Vec2& a, const Vec2& b) {
    bool left = false, right = false, on = false;
    RingTree::Bounds box, stretch;
    stretch.add(a);
    stretch.add(b);
    for (const Vec2& p : face) {
        box.add(p);
        const int s = turn(a, b, p);
        (s > 0 ? left : s < 0 ? right : on) = true;
    }
    if (!box.meets(stretch) || (!on && left != right)) return OutlineMeeting::disjoint;
    OutlineMeeting most = left && right ? OutlineMeeting::crossing : OutlineMeeting::touching;
    if (!polygon::is_convex(face)) return most;
    const int way = polygon::orientation(face);
    for (std::size_t i = 0; i < face.size(); ++i) {
        const Vec2 &p = face[i], &q = face[i + 1 == face.size() ? 0 : i + 1];
        const int sa = turn(p, q, a) * way, sb = turn(p, q, b) * way;
        if (p == q) continue;
        if (sa < 0 && sb < 0) return OutlineMeeting::disjoint;
        if (sa <= 0 && sb <= 0) most = OutlineMeeting::touching;
    }
    return most;
}

} // namespace facetmill
