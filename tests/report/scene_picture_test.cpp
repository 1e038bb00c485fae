#include "report/scene_picture.hpp"
#include "support/catch.hpp"

#include "support/run_stage.hpp"

using namespace facetmill;
using test::scene_of;

TEST_CASE("points are seen in the pictures of a page", "[report]") {
    Mesh points;
    points.positions = {{0, 0, 0}, {1, 1, 1}};
    std::size_t alpha = 0;
    const Picture dots = picture_of(scene_of(points), report::page_settings());
    for (std::size_t i = 3; i < dots.rgba.size(); i += 4) alpha += dots.rgba[i];
    CHECK(alpha >= 2 * 9 * 4 * (255 / 4)); // squares of three pixels a side, at any position
    CHECK(alpha <= 2 * 9 * 255);
}
