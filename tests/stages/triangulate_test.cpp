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

TEST_CASE("triangulate loses nothing of a concave face, from whichever corner it begins", "[stages]") {
    for (Index first = 0; first < 6; ++first) {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
        std::vector<Index> corners;
        for (Index i = 0; i < 6; ++i) corners.push_back((first + i) % 6);
        add_face(mesh, corners);
        CHECK(run_stage("triangulate", "", scene_of(mesh)).record.warnings.empty());
    }
}

TEST_CASE("triangulate: quads pairs what is flat enough", "[stages]") {
    const auto run = run_stage("triangulate", "quads", scene_of(shapes::cube()));
    CHECK(run.scene.parts[0].mesh.face_count() == 6);
    CHECK(run.record.result["parts"][0]["quads"] == 6);
    CHECK(run_stage("triangulate", "{to: quads, feature_angle: 1}", scene_of(shapes::icosphere(1)))
              .record.result["parts"][0]["quads"] == 0);
}
