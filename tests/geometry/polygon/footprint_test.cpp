#include "geometry/polygon/footprint.hpp"

#include "base/math/random.hpp"
#include "support/catch.hpp"
#include "support/polygons.hpp"

using namespace facetmill;
using namespace facetmill::polygon;

namespace {

/// A ring of teeth between two heights, closed below them.
std::vector<Vec2> comb(std::size_t teeth, double low, double high) {
    std::vector<Vec2> ring{{0, low - 1}, {static_cast<double>(teeth), low - 1}};
    for (std::size_t i = 2 * teeth + 1; i-- > 0;)
        ring.push_back({static_cast<double>(i) / 2, i % 2 == 0 ? low : high});
    return ring;
}

} // namespace

TEST_CASE("a footprint finds places as a look at all edges does", "[geometry]") {
    std::vector<std::vector<Vec2>> rings{comb(40, 2, 5), test::square(45, 0, 3), test::square(46, 1, 1)};
    for (int i = 0; i < 9; ++i) rings.push_back(test::square(50 + 2 * i, i % 3, 1));
    const Footprint footprint(rings);
    const auto check = [&](const Vec2& p) {
        CAPTURE(p.x, p.y);
        CHECK(footprint.locate(p) == locate(p, footprint.spans()));
    };
    for (std::uint64_t i = 0; i < 3000; ++i)
        check({uniform(hashed(1, i)) * 72 - 2, uniform(hashed(2, i)) * 8 - 1});
    for (const auto& ring : rings) // on corners, at their heights, and next to them
        for (const Vec2& corner : ring) {
            check(corner);
            for (const double x : {-1.0, 0.25, 20.5, 45.5, 46.5, 60.5, 80.0}) check({x, corner.y});
            for (const double y : {1.5, 3.0}) check({corner.x, y});
        }
}
