#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::run_stage;
using test::scene_of;

TEST_CASE("triangulate reports the kinds of faces that came in", "[stages]") {
    const auto run = run_stage("triangulate", "", scene_of(shapes::quad_cube()));
    CHECK(run.scene.parts[0].mesh.face_count() == 12);
    CHECK(run.record.result["parts"][0]["faces"]["quad"] == 6);
    CHECK(run.record.result["parts"][0]["cut"] == 6);
    CHECK(run.record.warnings.empty());
}

TEST_CASE("triangulate: quads pairs what is flat enough", "[stages]") {
    const auto run = run_stage("triangulate", "quads", scene_of(shapes::cube()));
    CHECK(run.scene.parts[0].mesh.face_count() == 6);
    CHECK(run.record.result["parts"][0]["quads"] == 6);
    CHECK(run_stage("triangulate", "{to: quads, feature_angle: 1}", scene_of(shapes::icosphere(1)))
              .record.result["parts"][0]["quads"] == 0);
}
