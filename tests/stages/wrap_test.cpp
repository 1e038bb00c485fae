#include "support/catch.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::refusal_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("wrap: lengths are in world space", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    for (int k = 0; k < 3; ++k) scene.parts[0].transform.m[k][k] = 10;
    const auto run = run_stage("wrap", "{alpha: 3, offset: 0.1}", scene);
    const Box box = run.scene.bounds();
    CHECK(box.min.x > -0.11);
    CHECK(box.max.x < 10.11);
    CHECK(box.max.x > 10);
    CHECK(run.record.result["parts"][0]["components"] == 1);
    scene.parts[0].transform.m[0][0] = 5;
    CHECK(refusal_of("wrap", "", scene).find("scales directions differently") != std::string::npos);
}

TEST_CASE("wrap: tells what it refuses", "[stages]") {
    CHECK(refusal_of("wrap", "{alpha: 0.00001%}", scene_of(shapes::cube())).find("would have about") !=
          std::string::npos);
    CHECK(refusal_of("wrap", "1", scene_of(Mesh{})).find("no points to wrap") != std::string::npos);
    const auto run = run_stage("wrap", "10%", test::skinned_cube());
    CHECK(run.warnings() == std::vector<std::string>{"W-SKIN"});
    CHECK(run_stage("wrap", "{alpha: 10%, attributes: nearest}", test::skinned_cube()).warnings().empty());
}
