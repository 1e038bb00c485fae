#include "support/catch.hpp"

#include "geometry/polygon/polygon.hpp"
#include "support/failure.hpp"
#include "support/polygons.hpp"

using namespace facetmill;
using namespace facetmill::polygon;
using namespace facetmill::test;

namespace {

double total(const std::vector<Segment>& segments) {
    double sum = 0;
    for (const auto& s : segments) sum += length(s.b - s.a);
    return sum;
}

} // namespace

TEST_CASE("a line is cut by outline and hole alike", "[geometry]") {
    const auto rings = rings_of({square(0, 0, 4), reversed(square(1, 1, 2))});
    using Parts = std::vector<Interval>;
    CHECK(clip_line({-4, 2}, {4, 2}, rings) == Parts{{0.5, 0.625}, {0.875, 1}});
    CHECK(clip_line({-4, 2}, {4, 2}, rings, Keep::outside) == Parts{{0, 0.5}, {0.625, 0.875}});
    CHECK(clip_line({0.5, 0.5}, {0.5, 3.5}, rings) == Parts{{0, 1}}); // both ends inside
    CHECK(clip_line({1.5, 2}, {2.5, 2}, rings).empty());              // all in the hole
    CHECK(clip_line({9, 9}, {9, 10}, rings, Keep::outside) == Parts{{0, 1}});
}

TEST_CASE("a line through corners and along edges crosses evenly", "[geometry]") {
    using Parts = std::vector<Interval>;
    CHECK(clip_line({-1, -1}, {3, 3}, rings_of({square(0, 0, 2)})) == Parts{{0.25, 0.75}});
    // A line along an edge has the corners on its left. The result is empty if the rest is also on its left,
    // otherwise everything.
    CHECK(clip_line({0, 0}, {4, 0}, rings_of({square(0, 0, 2)})).empty());
    CHECK(clip_line({4, 0}, {0, 0}, rings_of({square(0, 0, 2)})) == Parts{{0.5, 1}});
    CHECK(clip_line({0, 1}, {2, 1}, rings_of({l_shape()})) == Parts{{0, 1}});
}

TEST_CASE("inside and outside make up the line", "[geometry]") {
    const auto rings = rings_of({keyhole(), moved(reversed(l_shape()), {7, 1})});
    for (int i = 0; i < 50; ++i) {
        const Vec2 a{-1, -1 + 0.13 * i}, b{11, 5 - 0.11 * i};
        double sum = 0;
        for (const Keep keep : {Keep::inside, Keep::outside})
            for (const auto& part : clip_line(a, b, rings, keep)) {
                sum += part.to - part.from;
                const Vec2 middle = a + (b - a) * ((part.from + part.to) / 2);
                CHECK((locate(middle, rings) == PointLocation::inside) == (keep == Keep::inside));
            }
        CHECK(sum == Approx(1));
    }
}

TEST_CASE("hatching covers area over spacing", "[geometry]") {
    const auto rings = rings_of({square(0, 0, 4), reversed(square(1, 1, 2))});
    HatchSettings settings{.spacing = 0.01, .direction = {0.6, 0.8}};
    const auto lines = hatch(rings, settings);
    CHECK(total(lines) * settings.spacing == Approx(12).epsilon(1e-3));
    for (const auto& s : lines) CHECK(locate((s.a + s.b) * 0.5, rings) == PointLocation::inside);
}

TEST_CASE("hatching outside fills the frame but for the polygon", "[geometry]") {
    const auto lines = hatch(rings_of({square(0, 0, 4)}), {.spacing = 0.5, .keep = Keep::outside});
    CHECK(total(lines) * 0.5 == Approx(25 - 16).epsilon(0.1));
    for (const auto& s : lines) CHECK(locate((s.a + s.b) * 0.5, square(0, 0, 4)) != PointLocation::inside);
}

TEST_CASE("hatch lines pass through multiples of the spacing and run back and forth", "[geometry]") {
    const auto lines = hatch(rings_of({moved(square(0, 0, 1), {10, 10.2})}), {.spacing = 0.5});
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].a == Vec2{11, 10.5});
    CHECK(lines[0].b == Vec2{10, 10.5});
    CHECK(lines[1].a == Vec2{10, 11});
}

TEST_CASE("hatching finer than the limit is refused", "[geometry]") {
    CHECK(test::failure([] { hatch(rings_of({square(0, 0, 3)}), {.spacing = 1e-9}); }) ==
          "limit [E-HATCH] hatching would take about 4242640687 lines, and at most 1000000 are drawn | "
          "choose a larger spacing");
}

TEST_CASE("hatching covers what rings wind around, overlaps once", "[geometry]") {
    const auto overlapping = rings_of({square(0, 0, 4), square(2, 2, 4)});
    const auto lines = hatch(overlapping, {.spacing = 0.01, .direction = {0.6, 0.8}});
    CHECK(total(lines) * 0.01 == Approx(28).epsilon(1e-3));
    const auto eight = rings_of({figure_eight()});
    CHECK(total(hatch(eight, {.spacing = 0.01})) * 0.01 == Approx(2).epsilon(1e-2));
    const auto around = hatch(overlapping, {.spacing = 0.01, .direction = {0.6, 0.8}, .keep = Keep::outside});
    CHECK(total(around) * 0.01 == Approx(6.02 * 6.02 - 28).epsilon(1e-2));
    for (const auto& s : around) CHECK_FALSE(inside_by_angles((s.a + s.b) * 0.5, overlapping));
}
