#include "mesh/surface.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

#include <cmath>
#include <limits>

using namespace facetmill;

namespace {

/// The box of the finite corners, one by one.
Box box_of_corners(const Surface& surface) {
    Box box;
    for (const Index v : surface.corners)
        if (is_finite(surface.positions[v])) box.add(surface.positions[v]);
    return box;
}

void check_bounds(const Surface& surface) {
    const Box box = surface.bounds(), expected = box_of_corners(surface);
    CHECK(box.min == expected.min);
    CHECK(box.max == expected.max);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(std::signbit(box.min[i]) == std::signbit(expected.min[i]));
        CHECK(std::signbit(box.max[i]) == std::signbit(expected.max[i]));
    }
}

} // namespace

TEST_CASE("the bounds of a surface are those of its finite corners", "[mesh]") {
    const Surface ball = surface_of(test::noisy_icosphere(4, 0.1, 1));
    REQUIRE(ball.positions.size() < ball.corners.size());
    check_bounds(ball);
    Surface with_unused = ball;
    with_unused.positions.push_back({100, -100, 0});
    check_bounds(with_unused);
    CHECK(with_unused.bounds().max.x < 2);
    for (const double x :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        Surface broken = ball;
        broken.positions[5] = {x, 50, 50};
        check_bounds(broken);
        CHECK(broken.bounds().max.y < 2);
    }
    Surface flat = ball; // zeros of both signs: the first corner's sign counts
    for (std::size_t v = 0; v < flat.positions.size(); ++v) flat.positions[v].z = v % 2 ? -0.0 : 0.0;
    check_bounds(flat);
    std::swap(flat.corners.front(), flat.corners.back());
    check_bounds(flat);
    check_bounds({});
}
