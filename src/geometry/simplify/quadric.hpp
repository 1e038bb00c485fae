#pragma once
// Weighted sums of squared distances to planes: the error measure of Garland and Heckbert (SIGGRAPH 1997).

#include "base/vec.hpp"

#include <algorithm>

namespace facetmill {

/// Q(p) = p.A p - 2 b.p + c, A symmetric; weight is the sum of the planes' weights, which is also A's trace.
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0; ///< A
    Vec3 b;
    double c = 0;
    double weight = 0;

    Quadric& operator+=(const Quadric& q) {
        xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
        b += q.b, c += q.c, weight += q.weight;
        return *this;
    }

    /// The value at p; rounding may leave a small negative number, which is 0.
    double operator()(const Vec3& p) const {
        const Vec3 ap{xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z,
                      xz * p.x + yz * p.y + zz * p.z};
        return std::max(0.0, dot(p, ap) - 2 * dot(b, p) + c);
    }

    /// The point where Q(p) + pull * |p - anchor|^2 is least. With pull > 0 it always exists and, where the
    /// planes leave it free (a plane, a straight crease), it stays by the anchor. LDL' of A + pull; no
    /// pivoting is needed.
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

} // namespace facetmill
