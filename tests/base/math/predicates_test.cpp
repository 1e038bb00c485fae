#include "support/catch.hpp"

#include "base/math/predicates.hpp"
#include "base/math/random.hpp"
#include "oracle/cgal_oracle.hpp"

#include <array>

using namespace facetmill;

TEST_CASE("orientation_2d is exact where a plain determinant is not", "[base]") {
    // Kettner et al. 2008, Classroom examples of robustness problems: points around the line through b and c.
    int left = 0, right = 0, on = 0;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) {
            const double x = 0.5 + i * 0x1p-53, y = 0.5 + j * 0x1p-53;
            const int found = orientation_2d(x, y, 12, 12, 24, 24);
            CHECK(found == (i < j ? -1 : i > j ? 1 : 0) * -1);
            (found > 0 ? left : found < 0 ? right : on)++;
        }
    CHECK(left == 64 * 63 / 2);
    CHECK(right == 64 * 63 / 2);
    CHECK(on == 64);
}

TEST_CASE("collinear is exact", "[base]") {
    CHECK(collinear({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}));
    CHECK(collinear({1, 2, 3}, {1, 2, 3}, {7, 8, 9}));
    CHECK_FALSE(collinear({0, 0, 0}, {1, 0, 0}, {2, 0, 1e-300}));
    CHECK_FALSE(collinear({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.4, 0.4, std::nextafter(0.4, 1)}));
}

TEST_CASE("the side of a plane is exact where rounding is not", "[base]") {
    const Vec3 a{12, 12, 12}, b{24, 24, 24.5}, c{24, 25, 24};
    // Points of the plane's line through a, moved by the least step that doubles have: naive determinants
    // fail here.
    CHECK(orientation_3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == 1);
    CHECK(orientation_3d({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}) == -1);
    CHECK(orientation_3d(a, b, c, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)}) == 0);
    const double e = 1.0 / (1LL << 52);
    CHECK(orientation_3d({1, 1, 1}, {2, 2, 2}, {3, 3, 4}, {1 + e, 1 + e, 1}) == 0);
    const int side = orientation_3d({1, 1, 1}, {2, 2, 2}, {3, 3, 4}, {1 + e, 1, 1});
    CHECK(side != 0);
    CHECK(orientation_3d({1, 1, 1}, {3, 3, 4}, {2, 2, 2}, {1 + e, 1, 1}) == -side);
    CHECK(orientation_3d({1, 1, 1}, {2, 2, 2}, {3, 3, 4}, {1, 1 + e, 1}) == -side);
}

TEST_CASE("predicates are exact where products of coordinates vanish or overflow", "[base]") {
    constexpr double most = 1.7976931348623157e308, least = 5e-324;
    CHECK(orientation_2d(0, 0, least, 0, 0, least) == 1);
    CHECK(orientation_2d(0, 0, 0, least, least, 0) == -1);
    CHECK(orientation_2d(-most, -most, most, -most, 0, most) == 1);
    CHECK(orientation_2d(0, least, -1, 1, -2, 2) == -1); // a hair above the line x + y = 0
    CHECK(orientation_2d(0, -least, -1, 1, -2, 2) == 1);
    CHECK(orientation_2d(0, 0, -1, 1, -2, 2) == 0);
    CHECK(collinear({}, {1e-300, 1e-300, 1e-300}, {1e300, 1e300, 1e300}));
    CHECK_FALSE(collinear({}, {1e-300, 1e-300, 1e-300}, {1e300, 1e300, std::nextafter(1e300, most)}));
}

TEST_CASE("no product is lost that a large factor brings back", "[base]") {
    // yz - zy is a quarter of the smallest double, xz the whole of it: the first wins by its factor.
    const double h = 0x1p-537;
    const Vec3 u{h, 1.25 * h, h}, v{0, h, h}, w{0x1p1000, 0x1p990, 0};
    CHECK(orientation_3d({}, u, v, w) == 1);
    CHECK(orientation_3d({}, v, u, w) == -1);
}

TEST_CASE("predicates agree with rational numbers on coordinates of all sizes", "[base]") {
    constexpr double most = 1.7976931348623157e308;
    constexpr std::array<std::array<double, 8>, 5> sizes{{
        {0, 5e-324, 1e-300, 1e-150, 1, 1e150, 1e300, most},
        {1e300, 1.0000000000000002e300, 1e-300, 0, 3e-300, 1, 1e299, 5e-324},
        {1, 1.0000000000000002, 1e-110, 3e-110, 1e-200, 0, 2, 3},
        {1e-150, 2e-150, 3e-150, 5e-324, 0, 1e-160, 4e-150, 1e-170},
        {1e100, 1, 1e-100, 0, 1e-200, 1e-250, 2e100, 3},
    }};
    std::size_t differ = 0, flat = 0;
    for (std::uint64_t n = 0; n < 20000; ++n) {
        std::uint64_t state = hashed(7, n);
        const auto next = [&] { return state = hashed(state, n); };
        std::array<Vec3, 4> p;
        for (Vec3& q : p)
            for (std::size_t i = 0; i < 3; ++i) {
                const double size = sizes[n % sizes.size()][next() % 8];
                q[i] = next() % 2 ? size : -size;
            }
        if (next() % 2) // nearly on a line through the origin
            for (std::size_t i = 0; i < 3; ++i)
                if (std::isfinite(p[1][i] * 2)) {
                    p[2][i] = p[1][i] * 2;
                    p[0][i] *= static_cast<double>(next() % 2);
                }
        for (Vec3& q : p) q.z = next() % 4 ? q.z : 0;
        const int space = oracle::orientation(p[0], p[1], p[2], p[3]);
        const auto on_floor = [&](int i) { return Vec3{p[i].x, p[i].y, 0}; };
        const int floor = oracle::orientation(on_floor(0), on_floor(1), on_floor(2), {p[0].x, p[0].y, 1});
        differ += orientation_3d(p[0], p[1], p[2], p[3]) != space;
        differ += orientation_2d(p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y) != floor;
        flat += floor == 0;
    }
    CHECK(differ == 0);
    CHECK(flat > 1000); // otherwise the test has no hard cases
}
