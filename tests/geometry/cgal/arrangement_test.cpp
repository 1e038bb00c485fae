#include "support/catch.hpp"

#include "geometry/cgal/arrangement.hpp"

using namespace facetmill;

TEST_CASE("an arrangement cuts no more than the soup allows", "[geometry][combine]") {
    TriangleSoup soup; // two that cross, and one in the plane of the first
    soup.points = {{0, 0, 0}, {4, 0, 0},   {0, 4, 0}, {1, 1, -1}, {1, 1, 1},
                   {3, 3, 0}, {-1, -1, 0}, {2, 1, 0}, {1, 3, 0}};
    soup.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
    soup.cut = {0, 1, 2};
    soup.pairs = {{0, 1}, {0, 2}, {1, 2}};
    const Arrangement cut(soup);
    CHECK(!cut.overfull());
    CHECK(cut.pieces().size() > 3);
    soup.max_pairs = 2;
    CHECK(Arrangement(soup).overfull());
    soup.max_pairs = 3;
    CHECK(!Arrangement(soup).overfull());
    soup.max_crossings = 1;
    CHECK(Arrangement(soup).overfull());
}
