#include "base/predicates.hpp"

#include "base/exact_sum.hpp"

#include <algorithm>
#include <initializer_list>

namespace facetmill {

namespace {

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Room for what three products of three differences need.
using Expansion = ExactSum<192>;

/// A power of two that brings the largest of the numbers near 1, so that products neither overflow nor
/// vanish.
double scale_for(std::initializer_list<double> numbers) {
    double most = 0;
    for (const double x : numbers) most = std::max(most, std::abs(x));
    return most > 0 && std::isfinite(most) ? std::ldexp(1.0, std::clamp(-std::ilogb(most), -1000, 1000)) : 1;
}

/// a - b exactly: the rounded difference and what it lost.
struct Difference {
    double high, low;
    Difference(double a, double b) : high(a - b) {
        const double virtual_b = a - high, virtual_a = high + virtual_b;
        low = (a - virtual_a) + (virtual_b - b);
    }
};

/// Adds the product of three differences, times sign, exactly.
void add_product(Expansion& sum, const Difference& a, const Difference& b, const Difference& c, double sign) {
    for (const double x : {a.low, a.high})
        for (const double y : {b.low, b.high}) {
            const double product = x * y, rest = std::fma(x, y, -product);
            for (const double z : {c.low * sign, c.high * sign}) {
                if (rest != 0) sum.add_product(rest, z);
                if (product != 0) sum.add_product(product, z);
            }
        }
}

int exact_orientation_3d(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double scale = scale_for({a[i], b[i], c[i], d[i]});
        a[i] *= scale, b[i] *= scale, c[i] *= scale, d[i] *= scale;
    }
    const Difference ux(b.x, a.x), uy(b.y, a.y), uz(b.z, a.z), vx(c.x, a.x), vy(c.y, a.y), vz(c.z, a.z),
        wx(d.x, a.x), wy(d.y, a.y), wz(d.z, a.z);
    Expansion exact;
    add_product(exact, uy, vz, wx, 1), add_product(exact, uz, vy, wx, -1);
    add_product(exact, uz, vx, wy, 1), add_product(exact, ux, vz, wy, -1);
    add_product(exact, ux, vy, wz, 1), add_product(exact, uy, vx, wz, -1);
    return exact.sign();
}

} // namespace

int orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) {
    const double left = (ax - cx) * (by - cy), right = (ay - cy) * (bx - cx), det = left - right;
    if (std::abs(det) > orientation_error * (std::abs(left) + std::abs(right)) &&
        std::abs(det) > orientation_smallest)
        return sign_of(det);
    const double sx = scale_for({ax, bx, cx}), sy = scale_for({ay, by, cy});
    ax *= sx, bx *= sx, cx *= sx, ay *= sy, by *= sy, cy *= sy;
    ExactSum<12> exact; // (a-c) x (b-c), multiplied out
    exact.add_product(ax, by);
    exact.add_product(-ax, cy);
    exact.add_product(-cx, by);
    exact.add_product(-ay, bx);
    exact.add_product(ay, cx);
    exact.add_product(cy, bx);
    return exact.sign();
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
    return orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y) == 0 &&
           orientation_2d(a.y, a.z, b.y, b.z, c.y, c.z) == 0 &&
           orientation_2d(a.z, a.x, b.z, b.x, c.z, c.x) == 0;
}

int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - a, v = c - a, w = d - a;
    const double yz = u.y * v.z, zy = u.z * v.y, zx = u.z * v.x, xz = u.x * v.z, xy = u.x * v.y,
                 yx = u.y * v.x;
    const double det = w.x * (yz - zy) + w.y * (zx - xz) + w.z * (xy - yx);
    const double size = (std::abs(yz) + std::abs(zy)) * std::abs(w.x) +
                        (std::abs(zx) + std::abs(xz)) * std::abs(w.y) +
                        (std::abs(xy) + std::abs(yx)) * std::abs(w.z);
    constexpr double error = 7.771561172376103e-16; // Shewchuk's (7 + 56 e) e
    if (std::abs(det) > error * size && std::abs(det) > orientation_smallest) return sign_of(det);
    return exact_orientation_3d(a, b, c, d);
}

} // namespace facetmill
