#include "base/math/predicates.hpp"

#include "base/math/exact_integer.hpp"
#include "base/math/exact_sum.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace facetmill {

namespace {

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Capacity for three products of three differences.
using Expansion = ExactSum<192>;

/// The numbers along one axis, scaled by a power of two to near 1 so that their products do not overflow.
struct Axis {
    double scale = 1;
    int lowest = 0; ///< the scaled numbers have no bits below 2^lowest

    Axis(std::initializer_list<double> numbers) {
        double most = 0, least = HUGE_VAL;
        for (const double x : numbers) {
            if (x == 0) continue;
            most = std::max(most, std::abs(x));
            least = std::min(least, std::abs(x));
        }
        if (!(most > 0 && std::isfinite(most))) return;
        const int power = std::clamp(-std::ilogb(most), -1000, 1000);
        scale = std::ldexp(1.0, power);
        lowest = std::min(0, std::max(std::ilogb(least) - 52, -1074) + power);
    }
};

/// True if every product of one number from each axis is a sum of doubles: no bit is below the smallest
/// double.
bool doubles_hold_products(std::initializer_list<Axis> axes) {
    int lowest = 0;
    for (const Axis& axis : axes) lowest += axis.lowest;
    return lowest >= -1070;
}

/// Uses integers where expansions of doubles fail: for coordinates of very different magnitudes along an
/// axis.
int integer_orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) {
    const mpz_class x = exact_integer(cx), y = exact_integer(cy);
    const mpz_class left = (exact_integer(ax) - x) * (exact_integer(by) - y),
                    right = (exact_integer(ay) - y) * (exact_integer(bx) - x);
    return sgn(mpz_class(left - right));
}

int integer_orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    std::array<mpz_class, 3> u, v, w;
    for (std::size_t i = 0; i < 3; ++i) {
        const mpz_class from = exact_integer(a[i]);
        u[i] = exact_integer(b[i]) - from;
        v[i] = exact_integer(c[i]) - from;
        w[i] = exact_integer(d[i]) - from;
    }
    mpz_class sum;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        sum += (u[j] * v[k] - u[k] * v[j]) * w[i];
    }
    return sgn(sum);
}

/// a - b exactly: the rounded difference and its rounding error.
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
    const Axis x{a.x, b.x, c.x, d.x}, y{a.y, b.y, c.y, d.y}, z{a.z, b.z, c.z, d.z};
    if (!doubles_hold_products({x, y, z})) return integer_orientation_3d(a, b, c, d);
    for (Vec3* p : {&a, &b, &c, &d}) {
        p->x *= x.scale;
        p->y *= y.scale;
        p->z *= z.scale;
    }
    const Difference ux(b.x, a.x), uy(b.y, a.y), uz(b.z, a.z), vx(c.x, a.x), vy(c.y, a.y), vz(c.z, a.z),
        wx(d.x, a.x), wy(d.y, a.y), wz(d.z, a.z);
    Expansion exact;
    add_product(exact, uy, vz, wx, 1);
    add_product(exact, uz, vy, wx, -1);
    add_product(exact, uz, vx, wy, 1);
    add_product(exact, ux, vz, wy, -1);
    add_product(exact, ux, vy, wz, 1);
    add_product(exact, uy, vx, wz, -1);
    return exact.sign();
}

} // namespace

int orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) {
    const double left = (ax - cx) * (by - cy), right = (ay - cy) * (bx - cx), det = left - right;
    if (std::abs(det) > orientation_error * (std::abs(left) + std::abs(right)) &&
        std::abs(det) > orientation_smallest)
        return sign_of(det);
    const Axis x{ax, bx, cx}, y{ay, by, cy};
    if (!doubles_hold_products({x, y})) return integer_orientation_2d(ax, ay, bx, by, cx, cy);
    ax *= x.scale;
    bx *= x.scale;
    cx *= x.scale;
    ay *= y.scale;
    by *= y.scale;
    cy *= y.scale;
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
    // The third factor magnifies the underflow error of the products of two.
    const double lost = orientation_smallest * (1 + std::abs(w.x) + std::abs(w.y) + std::abs(w.z));
    if (std::abs(det) > error * size && std::abs(det) > lost) return sign_of(det);
    return exact_orientation_3d(a, b, c, d);
}

} // namespace facetmill
