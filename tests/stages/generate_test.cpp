#include "mesh/invariants.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using test::options;
using test::problems_of;
using test::run_stage;

TEST_CASE("generate: a bare name is the shape, and a sphere has 4000 faces", "[stages]") {
    const auto r = run_stage("generate", Value::scalar("sphere"), {});
    CHECK(r.mesh().face_count() == 4000);
    CHECK(r.record.result["part"] == "sphere");
    CHECK(r.scene.up == UpAxis::z);
}

TEST_CASE("generate: lengths have units once the shape has one", "[stages]") {
    const auto r =
        run_stage("generate",
                  options({{"shape", "cylinder"}, {"radius", "5mm"}, {"height", "2cm"}, {"unit", "mm"}}), {});
    CHECK(r.scene.unit == Unit::mm);
    CHECK(r.mesh().bounds().max.z == 10);
    CHECK(r.mesh().bounds().max.x == 5);
}

TEST_CASE("generate: adds to a scene in that scene's convention", "[stages]") {
    auto first = run_stage("generate", options({{"shape", "cube"}, {"unit", "m"}}), {}).scene;
    const auto r = run_stage("generate", options({{"shape", "cube"}, {"unit", "cm"}, {"size", "50"}}), first);
    REQUIRE(r.scene.parts.size() == 2);
    CHECK(r.scene.parts[1].name == "cube_2");
    CHECK(r.scene.unit == Unit::m);
    CHECK(r.scene.bounds().diagonal() == Approx(2 * std::sqrt(3.0)));
    CHECK(r.scene.parts[1].transform.m[0][0] == Approx(0.01));
}

TEST_CASE("generate: a percentage of noise is of the shape itself", "[stages]") {
    const auto r = run_stage("generate", options({{"shape", "grid"}, {"noise", "1%"}}), {});
    CHECK(r.record.resolved.at(0).option == "noise (grid)");
    CHECK(r.record.resolved.at(0).is == Approx(0.02 * std::sqrt(2.0)));
}

TEST_CASE("generate: options of other shapes are refused", "[stages]") {
    CHECK(problems_of("generate", options({{"shape", "cube"}, {"subdivisions", "2"}})) ==
          "E-CONFLICT generate: 'subdivisions' applies to icosphere, menger, not to cube | remove it");
    CHECK(problems_of("generate", options({{"shape", "sphere"}, {"faces", "100"}, {"segments", "9"}})) ==
          "E-CONFLICT generate: 'faces' replaces 'segments' and 'rings' | give either faces, or segments and "
          "rings");
    CHECK(problems_of("generate", options({{"shape", "menger"}, {"subdivisions", "5"}})) ==
          "E-RANGE 'subdivisions' of menger must be 1 <= x <= 4, not 5");
    CHECK(problems_of("generate", {}).substr(0, 9) == "E-MISSING");
}

TEST_CASE("generate: what cannot be a shape is refused before it is made", "[stages]") {
    CHECK(problems_of("generate", options({{"shape", "torus"}, {"minor_radius", "1"}})) ==
          "E-RANGE generate: minor_radius must be below the radius, which defaults to 1, not 1 | use a "
          "smaller minor_radius or a larger radius");
    CHECK(
        problems_of("generate", options({{"shape", "torus"}, {"minor_radius", "3mm"}, {"radius", "2mm"}})) ==
        "E-RANGE generate: minor_radius must be below the radius 2mm, not 3mm | use a smaller minor_radius "
        "or a "
        "larger radius");
    CHECK(problems_of("generate", options({{"shape", "torus"}, {"minor_radius", "2"}, {"radius", "3"}})) ==
          "");
    CHECK(problems_of("generate", options({{"shape", "torus"}, {"rings", "2"}})) ==
          "E-RANGE 'rings' of torus must be 3 <= x <= 1000000, not 2");
    CHECK(problems_of("generate", options({{"shape", "sphere"}, {"rings", "1"}})) ==
          "E-RANGE 'rings' of sphere must be 2 <= x <= 1000000, not 1");
}

TEST_CASE("generate: a percentage of the scene is the same whatever the shape's unit", "[stages]") {
    const auto scene = run_stage("generate", options({{"shape", "cube"}, {"unit", "m"}}), {}).scene;
    const auto r =
        run_stage("generate", options({{"shape", "cube"}, {"unit", "cm"}, {"size", "50%"}}), scene);
    const Part& made = r.scene.parts.at(1);
    CHECK(made.mesh.bounds().extent().x * made.transform.m[0][0] == Approx(std::sqrt(3.0)));
}

TEST_CASE("generate: a percentage of nothing is refused", "[stages]") {
    CHECK(test::failure([] {
              run_stage("generate", options({{"shape", "sphere"}, {"radius", "10%"}}), {});
          }) == "usage [E-RANGE] generate: 'radius' is 10%, but the scene is still empty | give a number, or "
                "a length with a unit");
    CHECK(test::failure([] {
              run_stage("generate", options({{"shape", "sphere"}, {"noise", "1% of load"}}), {});
          }) == "usage [E-RANGE] generate: 'noise' is 1% of load, but nothing has been loaded yet | give a "
                "number, or a length with a unit");
}
