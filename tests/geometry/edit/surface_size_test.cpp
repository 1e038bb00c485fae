#include "geometry/edit/moved.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("area and volume in the world, mirrored or not", "[geometry]") {
    Transform t;
    t.m[0][0] = -2;
    t.m[1][1] = 3;
    t.m[2][3] = 5;
    const SurfaceSize size = surface_size(shapes::quad_cube(), t);
    CHECK(size.area == Approx(2 * (2 * 3 + 3 + 2)));
    CHECK(*size.volume == Approx(6));
    CHECK_FALSE(surface_size(shapes::grid(2, 2)).volume);
    CHECK_FALSE(surface_size(shapes::fan3()).volume);
    CHECK_FALSE(surface_size(Mesh{}).volume);
}
