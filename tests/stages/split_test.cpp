#include "geometry/intersect/self_intersections.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"
#include "support/surface.hpp"

#include <cstdio>

using namespace facetmill;
using test::options;
using test::problems_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("split: smooth methods refuse non-manifold parts by name", "[stages]") {
    CHECK(test::failure([] { run_stage("split", Value::scalar("loop"), scene_of(shapes::fan3())); }) ==
          "stage [E-MANIFOLD] split: loop needs a manifold, oriented mesh; the edge of vertices 0 and 1 has "
          "3 faces (part 'part') | use clean to repair non-manifold edges and vertices, or the method "
          "midpoint, which splits any mesh");
}

TEST_CASE("split: a mesh in a single point has no edges longer than a percentage of it", "[stages]") {
    Mesh point = shapes::tetrahedron();
    for (auto& p : point.positions) p = {};
    CHECK(run_stage("split", options({{"max_edge", "3%"}}), scene_of(point)).mesh().face_count() == 4);
}

TEST_CASE("split: a bare number is answered with the options that take one", "[stages]") {
    CHECK(problems_of("split", Value::scalar("2"))
              .ends_with("catmull-clark, found '2' | a number needs the name of its option: split: {grid: "
                         "2}, split: {passes: 2} or split: {max_faces: 2}"));
    CHECK(problems_of("split", Value::scalar("midpiont"))
              .ends_with("found 'midpiont' | did you mean 'midpoint'?"));
}

TEST_CASE("split: targets and what they report", "[stages]") {
    const auto r = run_stage("split", options({{"max_edge", "10%"}}), scene_of(shapes::cube()));
    const auto& part = r.record.result["parts"][0];
    CHECK(part["longest_edge"]["after"].get<double>() <= std::sqrt(3.0) / 10);
    CHECK(part["smallest_angle"]["before"].get<double>() == Approx(45));
    CHECK(part["stopped_by"] == "max_edge");
    CHECK(r.warnings().empty());
    const auto few = run_stage("split", options({{"max_faces", "100"}}), scene_of(shapes::cube()));
    CHECK(few.mesh().face_count() <= 100);
    CHECK(few.mesh().face_count() > 92);
    CHECK(few.record.result["parts"][0]["stopped_by"] == "max_faces");
    CHECK(problems_of("split", options({{"method", "core"}, {"max_edge", "1"}})).substr(0, 11) ==
          "E-CONFLICT ");
    CHECK(problems_of("split", options({{"min_angle", "20"}, {"max_faces", "9"}})).substr(0, 11) ==
          "E-CONFLICT ");
    CHECK(problems_of("split", options({{"method", "sqrt3"}, {"feature_angle", "20"}})).substr(0, 11) ==
          "E-CONFLICT ");
    CHECK(problems_of("split", options({{"cut", "widest-angle"}})).substr(0, 11) == "E-CONFLICT ");
}

TEST_CASE("split: a target that is not reached is warned of", "[stages]") {
    const auto r =
        run_stage("split", options({{"max_edge", "10%"}, {"passes", "1"}}), scene_of(shapes::cube()));
    CHECK(r.record.result["parts"][0]["stopped_by"] == "passes");
    REQUIRE(r.warnings() == std::vector<std::string>{"W-SPLIT-STOPPED"});
    CHECK(r.record.warnings[0].message ==
          "part 'part' still has edges of 0.7071, above max_edge 0.1732: passes (1) ended the split");
    const auto full = run_stage("split", options({{"max_faces", "4"}}), scene_of(shapes::cube()));
    CHECK(full.mesh().face_count() == 12);
    REQUIRE(full.warnings() == std::vector<std::string>{"W-SPLIT-NOTHING"});
    CHECK(full.record.warnings[0].message ==
          "part 'part' has 12 faces, and its share of max_faces is 4: nothing is split");
    CHECK(run_stage("split", options({{"max_edge", "9"}}), scene_of(shapes::cube())).warnings().empty());
    for (const char* target : {"max_edge", "min_angle", "max_faces"})
        CHECK(problems_of("split", options({{"cut", "widest-angle"}, {"method", "bisect"}, {target, "9"}})) ==
              std::string("E-CONFLICT split: 'cut: widest-angle' cannot be combined with the target '") +
                  target +
                  "', because its cuts may never reach it | leave out cut, or give passes and no target");
}

TEST_CASE("split: narrow faces that are left, and faces that a method leaves, are warned of", "[stages]") {
    Mesh needle;
    needle.positions = {{0, 0, 0}, {9, 0, 0}, {9, 1, 0}};
    needle.corners = {0, 1, 2};
    const auto r = run_stage("split", options({{"min_angle", "20"}, {"passes", "10"}}), scene_of(needle));
    REQUIRE(r.warnings() == std::vector<std::string>{"W-SPLIT-STOPPED"});
    CHECK(r.record.result["parts"][0]["stopped_by"] == "narrow");
    CHECK(r.record.warnings.at(0).message == "part 'part' stays unchanged, with 1 face with an angle below "
                                             "20 degrees: the next pass would make more of them");
    CHECK(r.record.result["parts"][0]["narrow"] == 1);
    CHECK(r.record.result["parts"][0]["narrow_before"] == 1);
    CHECK(r.mesh().face_count() == 1);
    for (const char* method : {"fan", "halve", "diagonal"}) {
        const auto still = run_stage("split", options({{"method", method}}), scene_of(needle));
        CHECK(still.warnings() == std::vector<std::string>{"W-SPLIT-NOTHING"});
        CHECK(still.mesh().face_count() == 1);
    }
}

TEST_CASE("split: pieces over each other and edges of more than two faces are warned of", "[stages]") {
    Mesh dart;
    dart.positions = {{0.5, 0, 0}, {2, 1, 0}, {0, 0, 0}, {2, -1, 0}};
    const Index face[] = {0, 1, 2, 3};
    add_face(dart, face);
    CHECK(run_stage("split", options({{"grid", "3"}}), scene_of(dart)).warnings() ==
          std::vector<std::string>{"W-SPLIT-FOLDED"});
    CHECK(run_stage("split", Value::scalar("quads"), scene_of(dart)).warnings().empty());
    Mesh pillow;
    pillow.positions = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}};
    pillow.corners = {0, 1, 2, 2, 1, 0};
    CHECK(run_stage("split", Value{}, scene_of(pillow)).warnings() ==
          std::vector<std::string>{"W-SPLIT-SHARED"});
}

TEST_CASE("shaping stages take an empty scene and an empty mesh", "[stages]") {
    for (const char* stage : {"split", "crumple", "relax"}) {
        CHECK(run_stage(stage, Value{}, Scene{}).scene.parts.empty());
        CHECK(run_stage(stage, Value{}, scene_of(Mesh{})).mesh().face_count() == 0);
    }
}
