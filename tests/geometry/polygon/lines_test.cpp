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
          "limit [E-HATCH] hatching would take about 4242640687 lines, but at most 1000000 are possible | "
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
