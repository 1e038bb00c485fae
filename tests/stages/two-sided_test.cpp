#include "support/catch.hpp"
#include "support/run_stage.hpp"

#include "mesh/shapes.hpp"

using namespace facetmill;
using test::run_stage;
using test::scene_of;

TEST_CASE("two-sided marks materials", "[stages]") {
    const auto run = run_stage("two-sided", "material", scene_of(shapes::grid(1, 1)));
    REQUIRE(run.scene.materials.size() == 1);
    CHECK(run.scene.materials[0].double_sided);
    CHECK(run.scene.parts[0].mesh.primitives[0].material == 0);
    CHECK(run.scene.parts[0].mesh.face_count() == 2);
    CHECK(run_stage("two-sided", "", scene_of(shapes::grid(1, 1))).scene.parts[0].mesh.face_count() == 4);
}

TEST_CASE("two-sided and thicken make no second points of a cloud", "[stages]") {
    Mesh cloud;
    cloud.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    CHECK(run_stage("two-sided", "", scene_of(cloud)).mesh().vertex_count() == 3);
    CHECK(run_stage("thicken", "1", scene_of(cloud)).mesh().vertex_count() == 3);
}
