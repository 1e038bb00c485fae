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
