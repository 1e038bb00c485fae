#include "diff/likeness.hpp"

#include "support/catch.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using namespace facetmill::test;
using report::Likeness;

namespace {

Scene coloured(double red, double green, double blue) {
    Scene scene = scene_of(shapes::cube());
    scene.parts[0].mesh.primitives.resize(1);
    scene.parts[0].mesh.primitives[0].material = 0;
    scene.materials.push_back({.name = "paint", .base_colour = {red, green, blue, 1}});
    return scene;
}

} // namespace

TEST_CASE("Likeness finds no difference between equal scenes", "[diff]") {
    const Scene scene = scene_of(shapes::torus(20, 10));
    CHECK(Likeness(scene, 64).difference(scene) == 0);
}

TEST_CASE("Likeness grows with the change, and is whole against nothing on black and white", "[diff]") {
    const Scene sphere = scene_of(shapes::icosphere(4));
    const Likeness like(sphere, 96);
    const double fine = like.difference(scene_of(shapes::icosphere(3)));
    const double coarse = like.difference(scene_of(shapes::icosphere(1)));
    CHECK(fine > 0);
    CHECK(coarse > 4 * fine);
    const double none = like.difference(Scene{});
    // A pixel of value v against nothing differs by v on black and by 1 - v on white: between 1/4 and 1/2.
    CHECK(none > 0.2);
    CHECK(none <= 0.5);
}

TEST_CASE("Likeness counts colours in sRGB", "[diff]") {
    const Likeness black(coloured(0, 0, 0), 32);
    const double one = black.difference(coloured(0.2, 0, 0)), all = black.difference(coloured(0.2, 0.2, 0.2));
    CHECK(one > 0);
    CHECK(all == Approx(3 * one).epsilon(0.02));
}

TEST_CASE("Likeness of an empty scene is 0", "[diff]") {
    CHECK(Likeness(Scene{}, 32).difference(Scene{}) == 0);
}
