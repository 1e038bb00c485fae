#include "geometry/intersect/contacts.hpp"

#include "base/math/predicates.hpp"
#include "geometry/inspect/evidence.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

using Corners = std::array<Vec3, 3>;
using Sides = std::array<int, 3>; ///< sides of three corners relative to a plane

Sides sides_of(const Corners& t, const Corners& of_plane) {
    return {orientation_3d(of_plane[0], of_plane[1], of_plane[2], t[0]),
            orientation_3d(of_plane[0], of_plane[1], of_plane[2], t[1]),
            orientation_3d(of_plane[0], of_plane[1], of_plane[2], t[2])};
}

bool straddles(const Sides& s) {
    return *std::min_element(s.begin(), s.end()) < 0 && *std::max_element(s.begin(), s.end()) > 0;
}

/// The sign of the area of a, b, c projected along the axis.
int turn(const Vec3& a, const Vec3& b, const Vec3& c, std::size_t axis) {
    const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    return orientation_2d(a[x], a[y], b[x], b[y], c[x], c[y]);
}

/// An axis along which the projected points are not collinear; 3 if the points are collinear.
std::size_t view_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    std::size_t axis = 0;
    while (axis < 3 && turn(a, b, c, axis) == 0) ++axis;
    return axis;
}

/// Whether an edge of s passes through the inside of t. sides: the sides of s's corners relative to t's
/// plane.
bool pierces(const Corners& s, const Sides& sides, const Corners& t) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (sides[i] * sides[j] >= 0) continue;
        const int way = orientation_3d(s[i], s[j], t[0], t[1]);
        if (way != 0 && way == orientation_3d(s[i], s[j], t[1], t[2]) &&
            way == orientation_3d(s[i], s[j], t[2], t[0]))
            return true;
    }
    return false;
}

/// Whether a corner of s in t's plane is inside t.
bool corner_inside(const Corners& s, const Sides& sides, const Corners& t) {
    const std::size_t view = view_of(t[0], t[1], t[2]);
    const int way = turn(t[0], t[1], t[2], view);
    for (std::size_t i = 0; i < 3; ++i)
        if (sides[i] == 0 && turn(t[0], t[1], s[i], view) == way && turn(t[1], t[2], s[i], view) == way &&
            turn(t[2], t[0], s[i], view) == way)
            return true;
    return false;
}

/// For triangles in the same plane: whether an edge of s separates t from s. t may touch the edge's line.
bool edge_parts(const Corners& s, const Corners& t) {
    const std::size_t view = view_of(s[0], s[1], s[2]);
    const int way = turn(s[0], s[1], s[2], view);
    for (std::size_t i = 0; i < 3; ++i)
        if (std::all_of(t.begin(), t.end(),
                        [&](const Vec3& p) { return turn(s[i], s[(i + 1) % 3], p, view) != way; }))
            return true;
    return false;
}

bool on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    for (std::size_t i = 0; i < 3; ++i)
        if (p[i] < std::min(a[i], b[i]) || p[i] > std::max(a[i], b[i])) return false;
    return collinear(a, b, p);
}

/// Whether two segments cross in the interior of both.
bool cross_inside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    if (orientation_3d(a, b, c, d) != 0) return false;
    const std::size_t view = view_of(a, b, c);
    return view < 3 && turn(a, b, c, view) * turn(a, b, d, view) < 0 &&
           turn(c, d, a, view) * turn(c, d, b, view) < 0;
}

/// The number of different common points of the borders of two triangles that are not coplanar. If the
/// borders share a segment, it is more than one.
std::size_t common_points(const Corners& s, const Corners& t) {
    std::vector<Vec3> corners;
    std::size_t crossings = 0;
    const auto add = [&](const Vec3& p) {
        if (std::find(corners.begin(), corners.end(), p) == corners.end()) corners.push_back(p);
    };
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const Vec3 &a = s[i], &b = s[(i + 1) % 3], &c = t[j], &d = t[(j + 1) % 3];
            if (on_segment(a, c, d)) add(a);
            if (on_segment(c, a, b)) add(c);
            crossings += cross_inside(a, b, c, d);
        }
    return corners.size() + crossings;
}

/// Whether two collinear segments have more than a point in common.
bool run_along(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    if (!collinear(a, b, c) || !collinear(a, b, d)) return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (a[i] != b[i])
            return std::max(std::min(a[i], b[i]), std::min(c[i], d[i])) <
                   std::min(std::max(a[i], b[i]), std::max(c[i], d[i]));
    return false;
}

/// The angle from the half plane of p at the edge u v to the half plane of q. 0: none, 1: less than half a
/// turn, 2: half a turn, 3: more.
int quarter(const Vec3& u, const Vec3& v, const Vec3& p, const Vec3& q) {
    const int side = orientation_3d(u, v, p, q);
    if (side != 0) return side > 0 ? 1 : 3;
    const std::size_t view = view_of(u, v, p);
    return turn(u, v, p, view) == turn(u, v, q, view) ? 0 : 2;
}

/// The order of q and r around the edge, starting at p's half plane: -1 if q comes before r, 0 if both
/// coincide, 1 if q comes after r.
int order_from(const Vec3& u, const Vec3& v, const Vec3& p, const Vec3& q, const Vec3& r) {
    const int a = quarter(u, v, p, q), b = quarter(u, v, p, r);
    if (a != b) return a < b ? -1 : 1;
    return a == 0 || a == 2 ? 0 : -orientation_3d(u, v, q, r);
}

/// Whether, around an edge, the half planes of q and r are on different sides of the half planes of p and o.
/// Neither may coincide with the half planes of p or o.
bool parts(const Vec3& u, const Vec3& v, const Vec3& p, const Vec3& o, const Vec3& q, const Vec3& r) {
    if (quarter(u, v, p, q) == 0 || quarter(u, v, p, r) == 0) return false;
    return order_from(u, v, p, q, o) * order_from(u, v, p, r, o) < 0;
}

} // namespace

bool TouchTest::only_touch(Index s, Index t) const {
    const Corners a{surface_.point(s, 0), surface_.point(s, 1), surface_.point(s, 2)};
    const Corners b{surface_.point(t, 0), surface_.point(t, 1), surface_.point(t, 2)};
    const Sides of_a = sides_of(a, b), of_b = sides_of(b, a);
    if (of_a == Sides{} && of_b == Sides{}) {
        if (!edge_parts(a, b) && !edge_parts(b, a)) return false;
        return !pass_through(s, t);
    }
    if (pierces(a, of_a, b) || pierces(b, of_b, a)) return false;
    if (corner_inside(a, of_a, b) || corner_inside(b, of_b, a)) return false;
    // If a triangle crosses the other's plane in its interior, only the ends of the intersection are on its
    // border.
    if ((straddles(of_a) || straddles(of_b)) && common_points(a, b) > 1) return false;
    return !pass_through(s, t);
}

bool TouchTest::pass_through(Index s, Index t) const {
    for (Index i = 0; i < 3; ++i)
        for (Index j = 0; j < 3; ++j) {
            const Vec3 &u = surface_.point(s, i), &v = surface_.point(s, (i + 1) % 3);
            if (!run_along(u, v, surface_.point(t, j), surface_.point(t, (j + 1) % 3))) continue;
            const Beyond of_s = beyond(s, i), of_t = beyond(t, j);
            if (!of_s.sound || !of_t.sound) return true;
            for (const Vec3& o : of_s.apexes)
                for (const Vec3& r : of_t.apexes)
                    if (parts(u, v, surface_.point(s, (i + 2) % 3), o, surface_.point(t, (j + 2) % 3), r))
                        return true;
        }
    return false;
}

TouchTest::Beyond TouchTest::beyond(Index triangle, Index corner) const {
    std::call_once(once_, [&] {
        triangles_.positions = surface_.positions;
        triangles_.corners = surface_.corners;
        edges_ = build_edges(triangles_);
    });
    Beyond beyond;
    for (const Index c : edges_.corners_of(edges_.corner_edge[3 * triangle + corner])) {
        const Index other = c / 3;
        if (other == triangle) continue;
        const Vec3 &p = surface_.point(other, 0), &q = surface_.point(other, 1),
                   &r = surface_.point(other, 2);
        if (!is_finite(p) || !is_finite(q) || !is_finite(r) || is_degenerate(p, q, r)) beyond.sound = false;
        beyond.apexes.push_back(surface_.point(other, (c + 2) % 3));
    }
    return beyond;
}

} // namespace facetmill
