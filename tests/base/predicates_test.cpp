#include "support/catch.hpp"

#include "base/predicates.hpp"

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
    // Points of the plane's line through a, moved by the least step that doubles have: naive determinants fail here.
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
