#pragma once
// The quadric of a vertex, kept about the place where the vertex is.

#include "geometry/simplify/quadric.hpp"

namespace facetmill::simplification {

// How strongly the new vertex is drawn to the middle of the edge, relative to the quadric's weight: decides
// only where the planes leave the vertex free, as in flat and straight regions.
// Above what rounding leaves of the quadrics; the cost is worked out in single precision too, the place is
// not.
inline constexpr double pull = 2e-7;
inline constexpr float pull_of_cost = 1e-6f;
// Short edges go first where errors are equal: as if each vertex were displaced by a thousandth of the edge.
inline constexpr float shortness = 1e-6f;
// A best place farther off the edge's middle than so many times half its length (squared) is not trusted.
inline constexpr float most_off = 16;
// The order is that of the sum of squared distances over the area^(3/4): between the sum, which lets small
// parts go far off, and the mean, which spends faces on them. Over scans the maximum is a third below the
// sum's, and the root mean square a few percent above.

/// Q(y) = y.A y - 2 b.y + c for points at y from the vertex; the weight is A's trace, since all planes have
/// unit normals. Single precision is enough: near the vertex nothing cancels, and what rounding leaves is
/// below `shortness` times the squared length of an edge. A sum of planes through the
/// vertex has b = 0 and c = 0.
struct NearQuadric {
    float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, bx = 0, by = 0, bz = 0, c = 0;
};

/// q as seen from a place at h from its own: q'(y) = q(y + h).
inline Quadric seen_from(const Quadric& q, const Vec3& h) {
    const Vec3 ah{q.xx * h.x + q.xy * h.y + q.xz * h.z, q.xy * h.x + q.yy * h.y + q.yz * h.z,
                  q.xz * h.x + q.yz * h.y + q.zz * h.z};
    Quadric moved = q;
    moved.b = q.b - ah;
    moved.c = q.c + dot(h, ah - q.b * 2);
    return moved;
}
inline Quadric seen_from(const NearQuadric& q, const Vec3& h) {
    const double xx = q.xx, yy = q.yy, zz = q.zz;
    return seen_from(Quadric{xx, q.xy, q.xz, yy, q.yz, zz, {q.bx, q.by, q.bz}, q.c, xx + yy + zz}, h);
}

/// In single precision; the value at the place itself is not negative.
inline NearQuadric rounded(const Quadric& q) {
    const auto f = [](double x) { return static_cast<float>(x); };
    return {f(q.xx), f(q.xy),  f(q.xz),  f(q.yy),  f(q.yz),
            f(q.zz), f(q.b.x), f(q.b.y), f(q.b.z), f(std::max(0.0, q.c))};
}

} // namespace facetmill::simplification
