// Computes with pairs of doubles (T. J. Dekker, "A floating-point technique for extending the available
// precision", 1971), with bounds of their error.
#include "geometry/intersect/plane_crossing.hpp"

#include "base/math/predicates.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace facetmill {

namespace {

/// A number high + low, where low is at most half a unit in the last place of high. `difference` is exact.
/// The result of each other operation below has an error of less than 2^-100 of its size; for a sum, of the
/// summed sizes of its terms.
struct Twofold {
    double high = 0, low = 0;
};

Twofold joined(double large, double small) {
    const double sum = large + small;
    return {sum, small - (sum - large)};
}

Twofold sum_of(double a, double b) {
    const double sum = a + b, part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
}

Twofold difference(double a, double b) { return sum_of(a, -b); }

Twofold operator-(const Twofold& a) { return {-a.high, -a.low}; }

Twofold operator+(const Twofold& a, const Twofold& b) {
    const Twofold s = sum_of(a.high, b.high), t = sum_of(a.low, b.low);
    const Twofold u = joined(s.high, s.low + t.high);
    return joined(u.high, u.low + t.low);
}

Twofold operator-(const Twofold& a, const Twofold& b) { return a + -b; }

Twofold operator*(const Twofold& a, const Twofold& b) {
    const double product = a.high * b.high, rest = std::fma(a.high, b.high, -product);
    return joined(product, rest + (a.high * b.low + a.low * b.high));
}

Twofold operator/(const Twofold& a, const Twofold& b) {
    const double first = a.high / b.high;
    const Twofold rest = a - b * Twofold{first};
    const double second = rest.high / b.high;
    const Twofold last = rest - b * Twofold{second};
    return joined(first, second) + Twofold{last.high / b.high};
}

using Twofolds = std::array<Twofold, 3>;

Twofolds from_to(const Vec3& a, const Vec3& b) {
    return {difference(b.x, a.x), difference(b.y, a.y), difference(b.z, a.z)};
}

double largest(const Twofolds& v) {
    return std::max({std::abs(v[0].high), std::abs(v[1].high), std::abs(v[2].high)});
}

Twofold product_of(const Twofolds& a, const Twofolds& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Whether x plus or minus the error stays within the next double on either side.
bool is_near(const Twofold& x, double error) {
    const double size = std::abs(x.high);
    return size > 1e-100 && error < size * 0x1p-60;
}

/// x rounded towards zero, if all numbers within the error of x round to the same double.
std::optional<double> towards_zero(const Twofold& x, double error) {
    if (!(is_near(x, error) && std::abs(x.low) > error)) return {};
    if ((x.low > 0) == (x.high > 0)) return x.high;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x.high) - 1);
}

/// The exact coordinate along an axis, rounded towards zero, of the point where the line from p to q crosses
/// a plane. The plane is perpendicular to axis `level` at z. The coordinate is so near to x that only x and
/// its neighbours are possible.
double towards_zero_at_level(const Vec3& p, const Vec3& q, std::size_t axis, std::size_t level, double z,
                             double x) {
    // (q - p)[level] times the difference between the coordinate and x
    const int side =
        orientation_2d(p[axis], p[level], q[axis], q[level], x, z) * (q[level] > p[level] ? 1 : -1);
    if (side == 0 || (side > 0) == (x > 0)) return x;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) - 1);
}

} // namespace

std::optional<Vec3> plane_crossing(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    const Twofolds u = from_to(a, b), v = from_to(a, c), to_p = from_to(a, p), to_q = from_to(a, q);
    const double most_u = largest(u), most_v = largest(v), most_w = std::max(largest(to_p), largest(to_q));
    for (const double most : {most_u, most_v, most_w}) // no product overflows, or underflows where it matters
        if (!(most > 1e-50 && most < 1e50)) return {};
    const Twofolds normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const Twofold above = product_of(normal, to_p), below = product_of(normal, to_q);
    // Each component of the normal has an error of 6 * 2^-100 of the sizes, so the product has 42 * 2^-100.
    const double error = 0x1p-94 * most_u * most_v * most_w;
    if (!(std::abs(above.high) > 8 * error && std::abs(below.high) > 8 * error)) return {};
    if ((above.high > 0) == (below.high > 0)) return {};
    // Both terms of this difference have the same sign, so the quotient is between 0 and 1.
    const Twofold whole = above - below, part = above / whole;
    const double error_of_part = 4 * error / std::abs(whole.high) + 0x1p-98;
    std::optional<std::size_t> across; // the axis perpendicular to the plane
    for (std::size_t k = 0; k < 3; ++k)
        if (is_level(a, b, c, k)) across = k;
    Vec3 place;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool level = is_level(a, b, c, k);
        if (p[k] == q[k] || level) {
            place[k] = (level ? a[k] : p[k]) + 0.0; // makes zeros positive
            continue;
        }
        const Twofold way = difference(q[k], p[k]);
        const double off = std::abs(way.high) * (error_of_part + 0x1p-98) + std::abs(p[k]) * 0x1p-98;
        const Twofold x = Twofold{p[k]} + part * way;
        auto rounded = towards_zero(x, 2 * off);
        if (!rounded && across && is_near(x, 2 * off))
            rounded = towards_zero_at_level(p, q, k, *across, a[*across], x.high);
        if (!rounded) return {};
        place[k] = *rounded;
    }
    return place;
}

namespace {

Twofolds cross_of(const Twofolds& u, const Twofolds& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

} // namespace

/// The formula is o + (d1 n2 x n0 + d2 n0 x n1) / (n0 . n1 x n2). n: the normals. o: a corner of the first
/// triangle. d: the products of normals with corners minus o.
std::optional<Vec3> planes_crossing(const std::array<std::array<Vec3, 3>, 3>& triangles) {
    const Vec3& origin = triangles[0][0];
    std::array<Twofolds, 3> normals;
    std::array<Twofold, 3> heights;
    double size = 1, reach = 0; // size of all normals together; distance of the corners from o
    Vec3 place;
    std::array<bool, 3> is_level{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& [a, b, c] = triangles[i];
        for (std::size_t k = 0; k < 3; ++k)
            if (a[k] == b[k] && b[k] == c[k]) {
                is_level[k] = true;
                place[k] = a[k] + 0.0; // makes zeros positive
            }
        const Twofolds u = from_to(a, b), v = from_to(a, c), away = from_to(origin, a);
        const double most_u = largest(u), most_v = largest(v), most = largest(away);
        for (const double x : {most_u, most_v}) // no product overflows, or underflows where it matters
            if (!(x > 1e-20 && x < 1e20)) return {};
        if (!(most < 1e20)) return {};
        size *= 2 * most_u * most_v;
        reach = std::max(reach, most);
        normals[i] = cross_of(u, v);
        heights[i] = product_of(normals[i], away);
    }
    const Twofolds a = cross_of(normals[2], normals[0]), b = cross_of(normals[0], normals[1]);
    const Twofold whole = product_of(normals[0], cross_of(normals[1], normals[2]));
    // The error of a normal is 6 * 2^-100 of its size, and of a height 30 of that times the reach. The error
    // of a product of two normals is 30, and of three 100, of their sizes. So the numerator, of at most 12
    // size * reach, has an error of less than 2^-91 of that. No normal is larger than its part of `size`.
    const double error = 0x1p-91 * size;
    if (!(std::abs(whole.high) > 16 * error)) return {};
    for (std::size_t k = 0; k < 3; ++k) {
        if (is_level[k]) continue;
        const Twofold way = (heights[1] * a[k] + heights[2] * b[k]) / whole;
        const double off = 4 * error * (12 * reach + std::abs(way.high)) / std::abs(whole.high) +
                           std::abs(origin[k]) * 0x1p-98;
        const auto rounded = towards_zero(Twofold{origin[k]} + way, 2 * off);
        if (!rounded) return {};
        place[k] = *rounded;
    }
    return place;
}

} // namespace facetmill
