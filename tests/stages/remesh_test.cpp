#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/run_stage.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using test::options;
using test::problems_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("remesh: the report tells edges and deviation in scene units", "[stages]") {
    Scene scene = scene_of(shapes::icosphere(3));
    for (int i = 0; i < 3; ++i) scene.parts[0].transform.m[i][i] = 10;
    const auto r = run_stage("remesh", "2", std::move(scene));
    const auto& part = r.record.result["parts"][0];
    CHECK(part["faces_before"] == 1280);
    CHECK(part["faces"] == r.mesh().face_count());
    CHECK(part["mean_edge"].get<double>() == Approx(2).margin(0.4));
    CHECK(part["deviation"].get<double>() > 0);
    CHECK(part["deviation"].get<double>() < 0.5);
    CHECK(test::sound(r.mesh(), 2));
}

TEST_CASE("remesh: lengths are in world space, also under other scales", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts[0].transform.m[0][0] = 4;
    const auto r = run_stage("remesh", options({{"length", "0.5"}}), std::move(scene));
    CHECK(r.record.result["parts"][0]["mean_edge"].get<double>() == Approx(0.5).margin(0.1));
    CHECK(r.mesh().bounds().max.x == Approx(1));
}

TEST_CASE("remesh: a tolerance that is exceeded is reported", "[stages]") {
    const auto r =
        run_stage("remesh", options({{"tolerance", "0.001"}, {"min_length", "0.5"}, {"max_length", "0.5"}}),
                  scene_of(shapes::icosphere(4)));
    CHECK(r.warnings() == std::vector<std::string>{"W-REMESH-TOLERANCE"});
}

TEST_CASE("remesh: refuses options that conflict", "[stages]") {
    CHECK(!problems_of("remesh", options({})).empty());
    CHECK(!problems_of("remesh", options({{"length", "1"}, {"tolerance", "1"}})).empty());
    CHECK(problems_of("remesh", options({{"length", "1"}, {"max_length", "1"}})).substr(0, 11) ==
          "E-CONFLICT ");
}
