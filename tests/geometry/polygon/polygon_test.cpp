#include "support/catch.hpp"

#include "geometry/polygon/polygon.hpp"
#include "geometry/polygon/triangulate_rings.hpp"
#include "support/polygons.hpp"

#include <algorithm>

using namespace facetmill;
using namespace facetmill::polygon;
using namespace facetmill::test;

TEST_CASE("area and centroid of closed forms, far from the origin too", "[geometry]") {
    CHECK(signed_area(square(0, 0, 2)) == 4);
    CHECK(signed_area(reversed(square(0, 0, 2))) == -4);
    const auto m = moments(moved(l_shape(), {1e9, -1e9}));
    REQUIRE(m);
    CHECK(m->area == 3);
    CHECK(m->centroid.x == Approx(1e9 + 5.0 / 6).epsilon(1e-15));
    CHECK(m->centroid.y == Approx(-1e9 + 5.0 / 6).epsilon(1e-15));
}

TEST_CASE("second moments of a rectangle about its corner and its centroid", "[geometry]") {
    const double b = 3, h = 2;
    const std::vector<Vec2> rectangle{{0, 0}, {b, 0}, {b, h}, {0, h}};
    for (const auto& ring : {rectangle, reversed(rectangle)}) {
        const auto m = moments(ring);
        REQUIRE(m);
        CHECK(m->area == 6);
        CHECK(m->about_origin.x == Approx(b * h * h * h / 3));
        CHECK(m->about_origin.y == Approx(h * b * b * b / 3));
        CHECK(m->about_origin.xy == Approx(b * b * h * h / 4));
        CHECK(m->about_centroid.x == Approx(b * h * h * h / 12));
        CHECK(m->about_centroid.y == Approx(h * b * b * b / 12));
        CHECK(m->about_centroid.xy == Approx(0).margin(1e-14));
        CHECK(m->axes.largest == Approx(h * b * b * b / 12));
        CHECK(std::abs(m->axes.major.y) == Approx(1)); // about the upright axis, the width counts
    }
}

TEST_CASE("second moments of a regular hexagon are the same about every axis", "[geometry]") {
    const auto m = moments(regular(6, 2));
    REQUIRE(m);
    CHECK(m->about_centroid.x == Approx(5 * std::sqrt(3.0) / 16 * 16));
    CHECK(m->axes.largest == Approx(m->axes.smallest));
}

TEST_CASE("principal axes turn with the shape", "[geometry]") {
    const std::vector<Vec2> bar{{-5, -1}, {5, -1}, {5, 1}, {-5, 1}};
    const double straight = moments(bar)->axes.largest;
    for (const Vec2 along : {Vec2{0.6, 0.8}, Vec2{0.8, -0.6}, Vec2{-0.28, 0.96}, Vec2{0, 1}}) {
        std::vector<Vec2> ring;
        for (const Vec2& p : bar)
            ring.push_back({p.x * along.x - p.y * along.y, p.x * along.y + p.y * along.x});
        const auto axes = moments(ring)->axes;
        CHECK(axes.largest == Approx(straight));
        CHECK(std::abs(dot(axes.major, along)) < 1e-14);
        CHECK(std::abs(cross(axes.minor, along)) < 1e-14);
    }
}

TEST_CASE("holes by orientation take from the moments", "[geometry]") {
    const auto outer = square(0, 0, 4), hole = reversed(square(1, 1, 2));
    const auto m = moments(rings_of({outer, hole}));
    REQUIRE(m);
    CHECK(m->area == 12);
    CHECK(m->centroid == Vec2{2, 2});
    CHECK(m->about_centroid.x == Approx((256.0 - 16.0) / 12));
    CHECK_FALSE(moments(rings_of({outer, reversed(outer)})));
    CHECK_FALSE(moments(Rings{}));
}

TEST_CASE("areas in space: triangle, quad by its diagonals, any by Stokes", "[geometry]") {
    const std::vector<Vec3> quad{{0, 0, 0}, {2, 0, 1}, {3, 2, 2.5}, {1, 2, 1.5}};
    const Vec3 v = area_vector(quad);
    CHECK(area(quad) == Approx(length(v)));
    CHECK(v.z == Approx(4)); // upwards: appears anticlockwise from above
    CHECK(area(std::vector<Vec3>{{0, 0, 5}, {0, 3, 5}, {4, 0, 5}}) == 6);
    std::vector<Vec3> l;
    for (const Vec2& p : l_shape()) l.push_back({p.x, 7, p.y});
    CHECK(area(l) == 3);
    CHECK(area_vector(l) == Vec3{0, -3, 0});
    std::vector<Vec3> middles; // Varignon
    for (std::size_t i = 0; i < 4; ++i) middles.push_back(mix(quad[i], quad[(i + 1) % 4], 0.5));
    CHECK(area(middles) == Approx(area(quad) / 2));
}

TEST_CASE("deviation from the plane", "[geometry]") {
    CHECK(plane_deviation(std::vector<Vec3>{{0, 0, 0}, {1, 0, 9}, {0, 1, 3}}) == 0);
    CHECK(plane_deviation(std::vector<Vec3>{{0, 0, 1}, {1, 0, -1}, {1, 1, 1}, {0, 1, -1}}) == 1);
    CHECK(plane_deviation(std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {4, 0, 0}, {0, 0, 0}}) == 0);
    CHECK(plane_deviation(std::vector<Vec3>{{0, 0, 0}, {2, 2, 1}, {2, 0, 1}, {0, 2, 0}}) < 1e-15);
}

TEST_CASE("orientation is exact where the sum of doubles is not", "[geometry]") {
    CHECK(orientation(l_shape()) == 1);
    CHECK(orientation(reversed(l_shape())) == -1);
    const std::vector<Vec2> flat{{0, 0}, {1, 1}, {2, 2}, {1, 1}};
    CHECK(orientation(flat) == 0);
    // A quad one unit of rounding away from a line, far out.
    const double x = 1e8, up = std::nextafter(x + 1, HUGE_VAL);
    const std::vector<Vec2> sliver{{x, x}, {x + 1, x + 1}, {x + 2, x + 2}, {x + 1, up}};
    CHECK(orientation(sliver) == 1);
    CHECK(orientation(reversed(sliver)) == -1);
    CHECK(orientation(figure_eight()) == 0);
}

TEST_CASE("convexity needs one turn around", "[geometry]") {
    CHECK(is_convex(regular(7, 1)));
    CHECK(is_convex(reversed(regular(7, 1))));
    CHECK(is_convex(std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}})); // a straight corner
    CHECK_FALSE(is_convex(l_shape()));
    CHECK_FALSE(is_convex(pentagram()));
    CHECK_FALSE(is_convex(std::vector<Vec2>{{0, 0}, {3, 0}, {1, 0}, {1, 1}})); // a spike
    CHECK_FALSE(is_convex(std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}}));
}

TEST_CASE("kinds of polygon", "[geometry]") {
    CHECK(classify(std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}) == Kind::triangle);
    CHECK(classify(square(0, 0, 1)) == Kind::quad);
    CHECK(classify(regular(5, 1)) == Kind::convex);
    CHECK(classify(l_shape()) == Kind::concave);
    CHECK(classify(keyhole()) == Kind::complex);
    CHECK(classify(reversed(keyhole())) == Kind::complex);
    CHECK(classify(figure_eight()) == Kind::self_intersecting);
    CHECK(classify(pentagram()) == Kind::self_intersecting);
    CHECK(classify(std::vector<Vec2>{{0, 0}, {1, 1}, {2, 2}}) == Kind::degenerate);
    CHECK(classify(std::vector<Vec2>{{0, 0}, {2, 0}, {2, 2}, {2, 0}}) == Kind::degenerate);
    CHECK(classify(rings_of({square(0, 0, 4), reversed(square(1, 1, 2))})) == Kind::complex);
    CHECK(classify(rings_of({square(0, 0, 4), square(1, 1, 2)})) == Kind::self_intersecting);
}

TEST_CASE("a ring that touches itself is complex, one that crosses at a corner is not", "[geometry]") {
    // Two squares that share a corner, run in one go: both anticlockwise, then one each way.
    CHECK(classify(std::vector<Vec2>{{0, 0}, {0, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}, {-1, 0}}) ==
          Kind::complex);
    CHECK(classify(std::vector<Vec2>{{0, 0}, {0, -1}, {1, -1}, {1, 0}, {0, 0}, {-1, 0}, {-1, 1}, {0, 1}}) ==
          Kind::self_intersecting);
}

TEST_CASE("windings of rings", "[geometry]") {
    const auto range = winding_range(rings_of({pentagram()}));
    CHECK(range.min == 0);
    CHECK(range.max == 2);
    const auto eight = winding_range(rings_of({figure_eight()}));
    CHECK(eight.min == -1);
    CHECK(eight.max == 1);
}

TEST_CASE("triangles cover a keyhole polygon once, and add no point", "[geometry]") {
    const auto ring = keyhole();
    const auto t = triangulate_rings(rings_of({ring}));
    CHECK(t.added.empty());
    CHECK(t.triangles.size() == ring.size() - 2);
    CHECK(sum_of(t, {ring}) == signed_area(ring));
}

TEST_CASE("triangles times windings have the area of a ring that crosses itself", "[geometry]") {
    for (const auto& ring : {pentagram(), figure_eight(), reversed(pentagram())}) {
        const auto t = triangulate_rings(rings_of({ring}));
        CHECK(sum_of(t, {ring}) == Approx(signed_area(ring)).margin(1e-15));
        CHECK(std::all_of(t.winding.begin(), t.winding.end(), [](int w) { return w != 0; }));
    }
    const auto star = triangulate_rings(rings_of({pentagram()}));
    CHECK(star.added.size() == 5);
    CHECK(std::count(star.winding.begin(), star.winding.end(), 2) == 3); // the pentagon in the middle
    const auto eight = triangulate_rings(rings_of({figure_eight()}));
    REQUIRE(eight.added.size() == 1);
    CHECK(eight.added[0].at == Vec2{1, 1});
    CHECK(eight.added[0].t == 0.5);
}
