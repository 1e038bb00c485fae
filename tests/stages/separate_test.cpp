#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;
using test::failure;
using test::run_stage;
using test::scene_of;

TEST_CASE("separate by material; a part of one component stays as it is", "[stages]") {
    Scene scene = scene_of(shapes::quad_cube());
    scene.materials = {{.name = "red"}, {.name = "blue"}};
    Mesh& mesh = scene.parts[0].mesh;
    mesh.primitives = {{.material = 0, .attributes = {}, .json = {}},
                       {.material = 1, .attributes = {}, .json = {}}};
    mesh.attributes = {{std::string(primitive_attribute), Domain::face, Role::index, 1, false,
                        std::vector<std::uint32_t>{0, 1, 0, 0, 1, 0}}};
    const auto run = run_stage("separate", "material", scene);
    REQUIRE(run.scene.parts.size() == 2);
    CHECK(run.scene.parts[0].name == "part.red");
    CHECK(run.scene.parts[1].name == "part.blue");
    CHECK(run.scene.parts[1].mesh.face_count() == 2);
    for (Index m = 0; m < 2; ++m) { // each with its own primitive, which it is found by
        const Mesh& piece = run.scene.parts[m].mesh;
        REQUIRE(piece.primitives.size() == 1);
        CHECK(piece.primitives[0].material == m);
        CHECK(broken_invariants(piece).empty());
    }
    CHECK(run_stage("separate", "", scene_of(shapes::cube())).scene.parts[0].name == "part");
}

TEST_CASE("separate: all components of a skinned part keep its skin", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    append(scene.parts[0].mesh, shapes::cube());
    scene.parts[0].skinned = true;
    scene.parts[0].document = 0;
    scene.parts[0].node = 3;
    const auto run = run_stage("separate", "", scene);
    REQUIRE(run.scene.parts.size() == 2);
    for (const Part& part : run.scene.parts) CHECK((part.skinned && part.document == 0 && part.node == 3));
}

TEST_CASE("separate leaves cavities in their solids, unless it is told to", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    const auto hollow = run_stage("thicken", "{thickness: 0.1}", scene).scene;
    CHECK(run_stage("separate", "", hollow).scene.parts.size() == 1);
    const auto apart = run_stage("separate", "{cavities: true}", hollow).scene;
    REQUIRE(apart.parts.size() == 2);
    CHECK(*inspect(apart.parts[1].mesh).volume < 0);
}

TEST_CASE("separate names options without effect", "[stages]") {
    CHECK(failure([] {
              run_stage("separate", "{attribute: patch}", scene_of(shapes::cube()));
          }).find("'attribute' needs by: group") != std::string::npos);
}

TEST_CASE("parts without groups stay as they are among others", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "other";
    scene.parts[1].mesh.attributes.push_back(
        {"group", Domain::face, Role::index, 1, false,
         std::vector<std::uint32_t>{0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}});
    const auto run = run_stage("separate", "group", scene).scene;
    REQUIRE(run.parts.size() == 3);
    CHECK(run.parts[0].name == "part");
    CHECK(run.parts[1].name == "other.0");
    CHECK(run.parts[2].mesh.face_count() == 10);
    // An attribute given by name must exist.
    CHECK(failure([&] {
              run_stage("separate", "{by: group, attribute: patch}", scene);
          }).find("no face attribute 'patch'") != std::string::npos);
}

TEST_CASE("separate refuses a group that is not there, and too many parts", "[stages]") {
    CHECK(failure([] { run_stage("separate", "group", scene_of(shapes::cube())); }) ==
          "stage [E-GROUP] separate: part 'part' has no face attribute 'group' | merge creates 'group'; "
          "facetmill info lists the attributes");
    for (const double value : {0.5, HUGE_VAL - HUGE_VAL, HUGE_VAL, 1e300}) {
        Scene scene = scene_of(shapes::tetrahedron());
        scene.parts[0].mesh.attributes.push_back(
            {"group", Domain::face, Role::generic, 1, false, std::vector<double>{1, 2, value, -3}});
        CHECK(failure([&] { run_stage("separate", "group", scene); })
                  .starts_with(
                      "stage [E-GROUP] separate: 'group' of part 'part' does not number groups: it is "));
        scene.parts[0].mesh.attributes[0].set_value(2, 0, 1);
        CHECK(run_stage("separate", "group", scene).scene.parts.size() == 3);
    }
    Mesh soup;
    for (Index i = 0; i < 9; ++i) {
        soup.positions.push_back({double(i), double(i * i), 0});
        soup.corners.push_back(i);
    }
    CHECK(failure([&] { run_stage("separate", "{max_parts: 2}", scene_of(soup)); }) ==
          "stage [E-PARTS] separate: there would be at least 3 parts, but max_parts is 2 | use clean: "
          "{components: {min_faces: 10}} first to remove small components, or raise max_parts");
}
