#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/run_stage.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;
using test::run_stage;
using test::scene_of;

TEST_CASE("thicken takes its thickness in the world, and reports it as measured", "[stages]") {
    Scene scene = scene_of(shapes::grid(2, 2));
    for (int i = 0; i < 3; ++i) scene.parts[0].transform.m[i][i] = 10;
    const auto run = run_stage("thicken", "1", scene);
    CHECK(inspect(run.scene).volume.value() == Approx(400));
    CHECK(run.record.result["parts"][0]["wall_thickness"]["min"].get<double>() == Approx(1));
    CHECK(run.record.result["parts"][0]["self_intersections"] == 0);
    const auto thick = run_stage("thicken", "0.5", scene_of(test::noisy_icosphere(2, 0.3, 1)));
    REQUIRE(thick.record.warnings.size() > 0);
    CHECK(thick.record.warnings.back().id == "W-THICKEN");
    CHECK(run_stage("thicken", "{thickness: 0.1, mode: edges}", scene_of(shapes::cube()))
              .record.result["parts"][0]["cylinders"] == 18);
}

TEST_CASE("thicken leaves no skin without joints", "[stages]") {
    const auto wires = run_stage("thicken", "{thickness: 0.1, mode: edges}", test::skinned_cube());
    CHECK_FALSE(wires.scene.parts[0].skinned);
    CHECK(wires.scene.bounds().max.x < 2);
    CHECK(wires.record.warnings.at(0).id == "W-SKIN");
}
