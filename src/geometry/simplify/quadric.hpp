#pragma once
// Weighted sums of squared distances to planes, after M. Garland and P. Heckbert, 'Surface simplification
// using quadric error metrics' (1997).

#include "base/math/vec.hpp"

#include <algorithm>

namespace facetmill::simplification {

/// Q(p) = p.A p - 2 b.p + c, A symmetric; weight is the sum of the planes' weights, which is also A's trace.
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0; ///< coefficients of A
    Vec3 b;
    double c = 0;
    double weight = 0;

    Quadric& operator+=(const Quadric& q) {
        xx += q.xx;
        xy += q.xy;
        xz += q.xz;
        yy += q.yy;
        yz += q.yz;
        zz += q.zz;
        b += q.b;
        c += q.c;
        weight += q.weight;
        return *this;
    }

    /// The product A y.
    Vec3 times(const Vec3& y) const {
        return {xx * y.x + xy * y.y + xz * y.z, xy * y.x + yy * y.y + yz * y.z,
                xz * y.x + yz * y.y + zz * y.z};
    }

    /// The value at p. Small negative numbers from rounding become 0.
    double operator()(const Vec3& p) const { return std::max(0.0, dot(p, times(p)) - 2 * dot(b, p) + c); }

    /// The point that minimises Q(p) + pull * |p - anchor|^2. With pull > 0 it always exists. If the planes
    /// leave it free (a plane, a straight edge), it stays near the anchor. Solved by the LDL' factorisation
    /// of A + pull; no pivoting is needed.
    Vec3 least(const Vec3& anchor, double pull) const {
        const double i0 = 1 / (xx + pull), l10 = xy * i0, l20 = xz * i0;
        const double i1 = 1 / (yy + pull - l10 * xy), e21 = yz - l20 * xy, l21 = e21 * i1;
        const double i2 = 1 / (zz + pull - l20 * xz - l21 * e21);
        const Vec3 r = b + anchor * pull;
        const double y1 = r.y - l10 * r.x, y2 = r.z - l20 * r.x - l21 * y1;
        const double z = y2 * i2, y = y1 * i1 - l21 * z;
        return {r.x * i0 - l10 * y - l20 * z, y, z};
    }
};

inline Quadric operator+(Quadric a, const Quadric& b) { return a += b; }

/// The quadric of a vertex, stored relative to the vertex position: Q(y) = y.A y - 2 b.y + c for points at y
/// from the vertex. The weight is A's trace, because all planes have unit normals. A sum of planes through
/// the vertex has b = 0 and c = 0.
template <class Real>
struct QuadricAbout {
    Real xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, bx = 0, by = 0, bz = 0, c = 0;
};
/// A quadric in single precision. Terms near the vertex do not cancel, so errors are exact to about 1e-7 of
/// an edge's squared length. This suffices for surfaces that are curved everywhere.
using NearQuadric = QuadricAbout<float>;
/// A quadric for surfaces with flat and nearly flat parts, where the smallest errors decide which edge
/// collapses first.
using FineQuadric = QuadricAbout<double>;

/// Moves the origin of q by h: q'(y) = q(y + h).
[[nodiscard]] inline Quadric seen_from(const Quadric& q, const Vec3& h) {
    const Vec3 ah = q.times(h);
    Quadric moved = q;
    moved.b = q.b - ah;
    moved.c = q.c + dot(h, ah - q.b * 2);
    return moved;
}
template <class Real>
[[nodiscard]] Quadric seen_from(const QuadricAbout<Real>& q, const Vec3& h) {
    const double xx = q.xx, yy = q.yy, zz = q.zz;
    return seen_from(Quadric{xx, q.xy, q.xz, yy, q.yz, zz, {q.bx, q.by, q.bz}, q.c, xx + yy + zz}, h);
}

/// Rounds a quadric to the stored precision. Its value at the origin is not negative.
template <class Real>
[[nodiscard]] QuadricAbout<Real> rounded(const Quadric& q) {
    const auto f = [](double x) { return static_cast<Real>(x); };
    return {f(q.xx), f(q.xy),  f(q.xz),  f(q.yy),  f(q.yz),
            f(q.zz), f(q.b.x), f(q.b.y), f(q.b.z), f(std::max(0.0, q.c))};
}

} // namespace facetmill::simplification
