#include "support/catch.hpp"

#include "base/parallel.hpp"
#include "geometry/picture.hpp"
#include "mesh/shapes.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::scene_of;

namespace {

struct Pixel {
    int r, g, b, a;
};

Pixel at(const Picture& picture, int x, int y) {
    const std::uint8_t* p = &picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x)];
    return {p[0], p[1], p[2], p[3]};
}

std::size_t covered(const Picture& picture) {
    std::size_t count = 0;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) count += picture.rgba[i] > 127;
    return count;
}

/// Whether the surface's inner side is seen there: more red than blue, by far.
bool inner(const Pixel& p) { return p.r > p.b + 60; }

} // namespace

TEST_CASE("a sphere is a disc of the area that a disc has", "[geometry]") {
    const Picture picture = picture_of(scene_of(shapes::icosphere(5)));
    REQUIRE(picture.rgba.size() == 480U * 360U * 4U);
    CHECK(at(picture, 0, 0).a == 0);
    const Pixel middle = at(picture, 240, 180);
    CHECK(middle.a == 255);
    CHECK_FALSE(inner(middle));
    // It fills 92 % of the height.
    const double radius = 0.46 * 360;
    CHECK(static_cast<double>(covered(picture)) == Approx(3.14159 * radius * radius).epsilon(0.01));
    // Lit from the upper left.
    CHECK(at(picture, 180, 100).r > at(picture, 300, 260).r + 40);
}

TEST_CASE("the inner side of a surface is orange, unless its material is double-sided", "[geometry]") {
    Scene scene = scene_of(shapes::icosphere(3));
    auto& corners = scene.parts[0].mesh.corners;
    for (std::size_t c = 0; c < corners.size(); c += 3) std::swap(corners[c], corners[c + 1]);
    CHECK(inner(at(picture_of(scene), 240, 180)));
    Material& material = scene.materials.emplace_back();
    material.double_sided = true;
    material.base_colour[0] = material.base_colour[1] = 0;
    scene.parts[0].mesh.primitives.resize(1);
    scene.parts[0].mesh.primitives[0].material = 0;
    const Pixel blue = at(picture_of(scene), 240, 180);
    CHECK(blue.r == 0);
    CHECK(blue.b > 100);
}

TEST_CASE("pictures of what can hardly be seen", "[geometry]") {
    CHECK(covered(picture_of({})) == 0);
    CHECK(covered(picture_of(scene_of({}))) == 0);
    Mesh points;
    points.positions = {{0, 0, 0}, {1, 1, 1}, {HUGE_VAL, 0, 0}, {0, NAN, 0}};
    CHECK(covered(picture_of(scene_of(points))) == 0); // one sample of four each
    Mesh cube = shapes::cube();
    cube.positions[7].x = NAN;
    CHECK(covered(picture_of(scene_of(cube))) > 10000);
    for (Vec3& p : cube.positions) p *= 1e300;
    CHECK(covered(picture_of(scene_of(cube))) > 10000);
    CHECK(covered(picture_of(scene_of(shapes::quad_cube()))) > 10000);
}
