#include "mesh/plane.hpp"

#include "support/catch.hpp"
#include "support/failure.hpp"

using namespace facetmill;

TEST_CASE("sides of a plane are exact for the given doubles", "[geometry]") {
    const Plane third{{1, 1, 1}, {1.0 / 3, 1.0 / 3, 1.0 / 3}, 0};
    const double up = std::nextafter(1.0 / 3, 1), down = std::nextafter(1.0 / 3, 0);
    CHECK(side(third, {1.0 / 3, 1.0 / 3, 1.0 / 3}) == 0);
    CHECK(side(third, {up, 1.0 / 3, 1.0 / 3}) > 0);
    CHECK(side(third, {up, down, down}) < 0);
    CHECK(side(third, {up, down, 1.0 / 3}) == 0);
}

TEST_CASE("a term that plain doubles lose decides the side", "[geometry]") {
    // 0.1 * 3 is not 0.3: the doubles' products differ by 2^-54 or so.
    const Plane coefficients{{3, 0, 0}, {}, -0.3};
    CHECK(side(coefficients, {0.1, 5, 5}) > 0);
    const Plane far{{1, 1, 0}, {}, 0};
    CHECK(side(far, {1e16, -1e16, 0}) == 0);
    CHECK(side({{1, 1, 1}, {}, 0}, {1e16, -1e16, 1e-16}) > 0);
    CHECK(side({{1, 1, 1}, {}, 0}, {1e16, -1e16, -1e-16}) < 0);
}

TEST_CASE("sides of a plane are exact where products vanish or overflow", "[geometry]") {
    constexpr double most = 1.7976931348623157e308, least = 5e-324;
    for (const double size : {1e-200, 1.0, 1e200}) {
        const Plane flat{{0, 0, size}, {0, 0, 1e-200}, 0};
        CHECK(side(flat, {1, 2, 1e-200}) == 0);
        CHECK(side(flat, {1, 2, std::nextafter(1e-200, 1)}) > 0);
        CHECK(side(flat, {1, 2, std::nextafter(1e-200, 0)}) < 0);
        const Plane slanted{{size, size, -size}, {}, 0};
        CHECK(side(slanted, {most, most, most}) > 0);
        CHECK(side(slanted, {most, -most, 0}) == 0);
        CHECK(side(slanted, {most, -most, least}) < 0);
        CHECK(side(slanted, {least, 0, least}) == 0);
        CHECK(side(slanted, {least, 0, -least}) > 0);
        CHECK(std::isfinite(side(slanted, {most, most, -most})));
    }
}

TEST_CASE("a plane pulled back through a map separates the same points", "[geometry]") {
    Transform t;
    t.m[0][0] = 0;
    t.m[0][1] = -2;
    t.m[1][0] = 2;
    t.m[1][1] = 0;
    t.m[2][2] = -1;
    t.m[2][3] = 5;
    const Plane world{{1, 2, 3}, {0.5, 0.25, 4}, 0};
    const Plane local = pulled_back(world, t);
    for (int i = 0; i < 27; ++i) {
        const Vec3 p{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
        CHECK(side(local, p) == Approx(side(world, t.point(p))));
    }
}

TEST_CASE("a plane through a scaled part's vertices stays on them", "[geometry]") {
    Transform millimetres;
    for (int i = 0; i < 3; ++i) millimetres.m[i][i] = 0.001;
    const Plane local = pulled_back({{0, 0, 1}, {0, 0, 0.1}, 0}, millimetres);
    CHECK(side(local, {3, 4, 100}) == 0);
}

TEST_CASE("planes of any length are told apart exactly", "[geometry]") {
    for (const double size : {1.0, 0x1p-400, 0x1p400}) {
        const Plane plane{Vec3{1, 0.7, 0.3} * size, Vec3{0.1, 0.2, 0.05} * size, 0};
        Plane turned = plane, moved = plane;
        turned.normal.y = std::nextafter(turned.normal.y, HUGE_VAL);
        moved.through.z = std::nextafter(moved.through.z, HUGE_VAL);
        CHECK(same_plane(plane, plane));
        CHECK(same_plane(plane, {plane.normal * -2, plane.through, 0}));
        CHECK_FALSE(same_plane(plane, turned));
        CHECK_FALSE(same_plane(plane, moved));
    }
    // Proportional within the accuracy of doubles: 3 * 0.1 is not 0.3.
    CHECK_FALSE(same_plane({{0.1, 1, 0}, {}, 0}, {{0.30000000000000004, 3, 0}, {}, 0}));
    CHECK_FALSE(same_plane({{0.1, 1, 0}, {}, 0}, {{0.3, 3, 0}, {}, 0}));
    CHECK(same_plane({{0.1, 1, 0}, {}, 0}, {{0.2, 2, 0}, {}, 0}));
}

TEST_CASE("a plane without a direction is refused", "[geometry]") {
    CHECK(test::failure([] {
              check_plane({{0, 0, 0}, {}, 0});
          }) == "usage [E-PLANE] the plane's normal must be finite and not zero | give a direction: plane: "
                "{normal: [0, 0, 1]}");
    CHECK(test::failure([] {
              check_plane({{0, 0, NAN}, {}, 0});
          }) == "usage [E-PLANE] the plane's normal must be finite and not zero | give a direction: plane: "
                "{normal: [0, 0, 1]}");
    CHECK(test::failure([] {
              check_plane({{0, 0, 1}, {0, HUGE_VAL, 0}, 0});
          }) == "usage [E-PLANE] the plane's point and offset must be finite numbers");
}
