#include "support/catch.hpp"

#include "base/math/portable_math.hpp"
#include "base/math/random.hpp"
#include "geometry/polygon/polygon.hpp"
#include "support/polygons.hpp"

using namespace facetmill;
using namespace facetmill::polygon;
using namespace facetmill::test;

TEST_CASE("the crossing rule counts shared ends once", "[geometry]") {
    const std::vector<Vec2> diamond{{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    CHECK(locate({0, 0}, diamond) == PointLocation::inside);   // the ray meets the corner (1, 0)
    CHECK(locate({-2, 0}, diamond) == PointLocation::outside); // ... and two corners
    CHECK(locate({-2, 1}, diamond) == PointLocation::outside); // ... and only the tip
    CHECK(locate({-2, -1}, diamond) == PointLocation::outside);
    const std::vector<Vec2> steps{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {0, 2}};
    CHECK(locate({0.5, 1}, steps) == PointLocation::inside); // the ray runs along an edge
    CHECK(locate({-1, 1}, steps) == PointLocation::outside);
}

TEST_CASE("edges and corners are told apart", "[geometry]") {
    CHECK(locate({1, 0}, l_shape()) == PointLocation::on_edge);
    CHECK(locate({1, 1.5}, l_shape()) == PointLocation::on_edge);
    CHECK(locate({1, 2}, l_shape()) == PointLocation::on_vertex);
    CHECK(locate({1, 1}, l_shape()) == PointLocation::on_vertex);
    CHECK(locate({1.5, 1.5}, l_shape()) == PointLocation::outside);
    CHECK(locate({1, std::nextafter(0, 1)}, l_shape()) == PointLocation::inside);
}

TEST_CASE("holes are outside, whatever their orientation", "[geometry]") {
    for (const auto& hole : {square(1, 1, 2), reversed(square(1, 1, 2))}) {
        const auto rings = rings_of({square(0, 0, 4), hole});
        CHECK(locate({2, 2}, rings) == PointLocation::outside);
        CHECK(locate({0.5, 2}, rings) == PointLocation::inside);
        CHECK(locate({1, 2}, rings) == PointLocation::on_edge);
    }
    CHECK(locate({2, 2}, keyhole()) == PointLocation::outside);
    CHECK(locate({0.5, 2}, keyhole()) == PointLocation::inside);
}

TEST_CASE("half planes of a convex ring", "[geometry]") {
    CHECK(locate_convex({1, 1}, square(0, 0, 2)) == PointLocation::inside);
    CHECK(locate_convex({1, 1}, reversed(square(0, 0, 2))) == PointLocation::inside);
    CHECK(locate_convex({1, 0}, square(0, 0, 2)) == PointLocation::on_edge);
    CHECK(locate_convex({3, 0}, square(0, 0, 2)) == PointLocation::outside); // along an edge, beyond it
    CHECK(locate_convex({2, 2}, square(0, 0, 2)) == PointLocation::on_vertex);
}

TEST_CASE("angle sums are whole turns", "[geometry]") {
    CHECK(angle_sum(Vec2{0.1, 0.2}, regular(9, 1)) == Approx(2 * pi));
    CHECK(angle_sum(Vec2{0.1, 0.2}, reversed(regular(9, 1))) == Approx(-2 * pi));
    CHECK(angle_sum(Vec2{0, 0}, pentagram()) == Approx(4 * pi));
    CHECK(angle_sum(Vec2{5, 0}, l_shape()) == Approx(0).margin(1e-14));
}

TEST_CASE("the angle sum in space is whole only in the plane and inside", "[geometry]") {
    const std::vector<Vec3> quad{{0, 0, 0}, {2, 0, 1}, {2, 2, 1}, {0, 2, 0}};
    CHECK(angle_sum(Vec3{1, 1, 0.5}, quad) == Approx(2 * pi));
    CHECK(inside_by_angles(Vec3{1, 1, 0.5}, quad));
    CHECK(inside_by_angles(Vec3{2, 2, 1}, quad)); // a corner
    CHECK_FALSE(inside_by_angles(Vec3{1, 1, 0.51}, quad));
    CHECK_FALSE(inside_by_angles(Vec3{3, 1, 1.5}, quad));
    CHECK(angle_sum(Vec3{0, 0, 1e6}, quad) < 1e-4);
}

TEST_CASE("all forms of containment agree", "[geometry]") {
    const auto oval = regular(11, 1);
    std::vector<Vec3> lifted;
    for (const Vec2& p : oval) lifted.push_back({p.x, p.y, p.x - 2 * p.y});
    const auto holed = rings_of({square(-1, -1, 2), reversed(l_shape())});
    int inside = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const Vec2 p{3 * uniform(hashed(1, i)) - 1.5, 3 * uniform(hashed(2, i)) - 1.5};
        const bool in = locate(p, oval) == PointLocation::inside;
        inside += in;
        CHECK((locate_convex(p, oval) == PointLocation::inside) == in);
        CHECK(inside_by_angles(p, rings_of({oval})) == in);
        CHECK(inside_by_angles(Vec3{p.x, p.y, p.x - 2 * p.y}, lifted) == in);
        CHECK((locate(p, holed) == PointLocation::inside) ==
              ((locate(p, square(-1, -1, 2)) == PointLocation::inside) !=
               (locate(p, l_shape()) == PointLocation::inside)));
        CHECK(inside_by_angles(p, rings_of({keyhole()})) == (locate(p, keyhole()) == PointLocation::inside));
    }
    CHECK(inside > 500);
}
