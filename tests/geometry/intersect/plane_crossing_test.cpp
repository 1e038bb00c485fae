#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "geometry/intersect/plane_crossing.hpp"

#include <gmpxx.h>

using namespace facetmill;

namespace {

using Exact = std::array<mpq_class, 3>;

Exact from_to(const Vec3& a, const Vec3& b) {
    Exact d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = mpq_class(b[k]) - mpq_class(a[k]);
    return d;
}

mpq_class product_of(const Exact& a, const Exact& b) {
    return mpq_class(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/// The height of p above the plane, times a positive factor.
mpq_class above(const Vec3& p, const std::array<Vec3, 3>& t) {
    const Exact u = from_to(t[0], t[1]), v = from_to(t[0], t[2]);
    const Exact normal{mpq_class(u[1] * v[2] - u[2] * v[1]), mpq_class(u[2] * v[0] - u[0] * v[2]),
                       mpq_class(u[0] * v[1] - u[1] * v[0])};
    return product_of(normal, from_to(t[0], p));
}

Vec3 exact_crossing(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
    const mpq_class part = above(p, t) / (above(p, t) - above(q, t));
    Vec3 place;
    for (std::size_t k = 0; k < 3; ++k)
        place[k] = mpq_class(mpq_class(p[k]) + part * (mpq_class(q[k]) - mpq_class(p[k]))).get_d();
    return place;
}

/// By Cramer's rule; none if the planes do not meet in a single point.
std::optional<Vec3> exact_crossing(const std::array<std::array<Vec3, 3>, 3>& planes) {
    std::array<Exact, 3> normal;
    Exact height;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& [a, b, c] = planes[i];
        const Exact u = from_to(a, b), v = from_to(a, c);
        normal[i] = {mpq_class(u[1] * v[2] - u[2] * v[1]), mpq_class(u[2] * v[0] - u[0] * v[2]),
                     mpq_class(u[0] * v[1] - u[1] * v[0])};
        height[i] = product_of(normal[i], from_to({0, 0, 0}, a));
    }
    const auto determinant = [&](std::size_t column) {
        std::array<Exact, 3> m = normal;
        if (column < 3)
            for (std::size_t i = 0; i < 3; ++i) m[i][column] = height[i];
        return mpq_class(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
    };
    const mpq_class whole = determinant(3);
    if (sgn(whole) == 0) return {};
    return Vec3{mpq_class(determinant(0) / whole).get_d(), mpq_class(determinant(1) / whole).get_d(),
                mpq_class(determinant(2) / whole).get_d()};
}

/// In [-1, 1] around a point, of `bits` bits.
Vec3 random_point(std::uint64_t seed, std::uint64_t number, const Vec3& middle, int bits) {
    const auto x = [&](std::uint64_t k) {
        const auto whole = static_cast<double>(hashed(seed, 3 * number + k) >> (64 - bits));
        return std::ldexp(whole, 1 - bits) - 1;
    };
    return middle + Vec3{x(0), x(1), x(2)};
}

} // namespace

TEST_CASE("the place of a crossing is the exact one, rounded towards zero", "[geometry]") {
    std::size_t crossings = 0, told = 0, wrong = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        const Vec3 middle = seed % 3 == 0 ? Vec3{} : seed % 3 == 1 ? Vec3{3, -40, 0.1} : Vec3{1e6, 2e6, -1e7};
        const int bits = seed % 2 == 0 ? 52 : 24;
        std::array<Vec3, 5> p;
        for (std::uint64_t i = 0; i < 5; ++i) p[i] = random_point(seed, i, middle, bits);
        const std::array triangle{p[2], p[3], p[4]};
        const auto place = plane_crossing(p[0], p[1], triangle);
        const bool crosses = sgn(above(p[0], triangle)) * sgn(above(p[1], triangle)) < 0;
        crossings += crosses;
        if (!place) continue;
        ++told;
        wrong += !crosses || *place != exact_crossing(p[0], p[1], triangle);
    }
    CHECK(wrong == 0);
    CHECK(crossings > 1000);
    CHECK(told + 5 > crossings); // nearly always
}

TEST_CASE("a crossing of a plane across an axis is in it", "[geometry]") {
    std::size_t crossings = 0, told = 0, wrong = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        std::array<Vec3, 5> p;
        for (std::uint64_t i = 0; i < 5; ++i) p[i] = random_point(seed, i, {3, -40, 0.1}, 24);
        const std::size_t axis = seed % 3;
        p[3][axis] = p[4][axis] = p[2][axis];
        if (seed % 2 == 0) // the line is along the axis
            for (std::size_t k = 0; k < 3; ++k)
                if (k != axis) p[1][k] = p[0][k];
        const std::array triangle{p[2], p[3], p[4]};
        const auto place = plane_crossing(p[0], p[1], triangle);
        const bool crosses = sgn(above(p[0], triangle)) * sgn(above(p[1], triangle)) < 0;
        crossings += crosses;
        if (!place) continue;
        ++told;
        wrong += !crosses || *place != exact_crossing(p[0], p[1], triangle) || (*place)[axis] != p[2][axis];
    }
    CHECK(wrong == 0);
    CHECK(crossings > 1000);
    CHECK(told + 5 > crossings); // nearly always
}

TEST_CASE("a crossing of a plane across an axis is told where it is at a double, or nearly", "[geometry]") {
    std::size_t wrong = 0, at_doubles = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const std::size_t axis = seed % 3;
        std::array<Vec3, 5> p;
        for (std::uint64_t i = 0; i < 5; ++i)
            p[i] = random_point(seed, i, {3, -40, 0.1}, seed % 2 == 0 ? 24 : 52);
        p[0][axis] = -1; // a quarter of the way, or three
        p[1][axis] = 3;
        p[2][axis] = p[3][axis] = p[4][axis] = seed % 5 == 0 ? 0 : 2;
        const std::array triangle{p[2], p[3], p[4]};
        const Vec3 exact = exact_crossing(p[0], p[1], triangle);
        const auto place = plane_crossing(p[0], p[1], triangle);
        wrong += !place || *place != exact;
        const double part = seed % 5 == 0 ? 0.25 : 0.75;
        for (std::size_t k = 0; k < 3; ++k)
            at_doubles += mpq_class(p[0][k]) + mpq_class(part) * (mpq_class(p[1][k]) - mpq_class(p[0][k])) ==
                          mpq_class(exact[k]);
    }
    CHECK(wrong == 0);
    CHECK(at_doubles > 2000);
}

TEST_CASE("a crossing at a double, or that may be none, is not told", "[geometry]") {
    const std::array triangle{Vec3{0, 0, 0.5}, Vec3{1, 0, 0.5}, Vec3{0, 1, 0.5}};
    const std::array diagonal{Vec3{0, 0, 0}, Vec3{1, 0, 1}, Vec3{0, 1, 0}};
    CHECK(!plane_crossing({0.5, 0.1, 0}, {0.5, 0.1, 1}, diagonal)); // at exactly 0.5
    CHECK(!plane_crossing({0.1, 0.1, 0}, {0.2, 0.3, 0.25}, triangle));
    CHECK(!plane_crossing({0.1, 0.1, 0}, {0.2, 0.3, 0.5}, triangle));
    CHECK(!plane_crossing({1e300, 0, 0}, {0.2, 0.3, 1}, triangle));
    const std::array leaning{Vec3{0, 0, 0.1}, Vec3{1, 0, 0.2}, Vec3{0, 1, 0.3}};
    const auto upright = plane_crossing({0.3, -0.0, -1}, {0.3, -0.0, 1}, leaning);
    REQUIRE(upright);
    CHECK(upright->x == 0.3);
    CHECK(!std::signbit(upright->y));
}

TEST_CASE("the place where three planes meet is the exact one, rounded towards zero", "[geometry]") {
    std::size_t told = 0, wrong = 0, level = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        const Vec3 middle = seed % 3 == 0 ? Vec3{} : seed % 3 == 1 ? Vec3{3, -40, 0.1} : Vec3{1e6, 2e6, -1e7};
        std::array<std::array<Vec3, 3>, 3> planes;
        for (std::uint64_t i = 0; i < 9; ++i)
            planes[i / 3][i % 3] = random_point(seed, i, middle, seed % 2 == 0 ? 52 : 24);
        for (std::size_t i = 0; i < seed % 4;
             ++i) // so many are perpendicular to axes, possibly two to the same axis
            for (std::size_t k = 0, axis = (seed + (seed % 5 == 0 ? 0 : i)) % 3; k < 3; ++k)
                planes[i][k][axis] = planes[i][0][axis];
        const auto place = planes_crossing(planes);
        if (!place) continue;
        ++told;
        level += seed % 4 == 3;
        const auto exact = exact_crossing(planes);
        wrong += !exact || *place != *exact;
    }
    CHECK(wrong == 0);
    CHECK(told > 3500);
    CHECK(level > 700);
    const std::array one{Vec3{0, 0, 0.5}, Vec3{1, 0, 0.5}, Vec3{0, 1, 0.5}},
        upright{Vec3{0.1, 0, 0}, Vec3{0.1, 1, 0}, Vec3{0.1, 0, 1}},
        leaning{Vec3{0, 0.3, 0}, Vec3{1, 0.4, 0.2}, Vec3{0.1, 0.7, 1}};
    CHECK(!planes_crossing({one, one, leaning}));
    CHECK(planes_crossing({one, upright, leaning}));
}
