#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/run_stage.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/equal_meshes.hpp"
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

TEST_CASE("thicken resolves folds on request, and names that where they are told", "[stages]") {
    const Scene scene = scene_of(test::noisy_icosphere(2, 0.3, 1));
    const auto folded = run_stage("thicken", "0.2", scene);
    REQUIRE(folded.record.warnings.size() > 0);
    CHECK(folded.record.warnings.back().hint.starts_with("thicken: {self_intersections: resolve} rebuilds"));
    const auto resolved = run_stage("thicken", "{thickness: 0.2, self_intersections: resolve}", scene);
    CHECK(resolved.record.result["parts"][0]["resolved"] == true);
    CHECK(resolved.record.result["parts"][0]["self_intersections"] == 0);
    for (const auto& w : resolved.record.warnings) CHECK(w.id == "W-THICKEN-THIN");
    CHECK(run_stage("thicken", "{thickness: 0.2, self_intersections: false}", scene)
              .record.result["parts"][0]
              .count("self_intersections") == 0);
}

TEST_CASE("thicken says lengths with their unit", "[stages]") {
    Mesh tent; // two steep sheets
    tent.positions = {{-0.2, 0, 0}, {-0.2, 1, 0}, {0, 0, 1}, {0, 1, 1}, {0.2, 0, 0}, {0.2, 1, 0}};
    tent.corners = {0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4};
    const auto thin = [&](Unit unit) {
        const auto run = run_stage("thicken", "{thickness: 0.5, side: outward}", scene_of(tent, unit));
        REQUIRE(run.record.warnings.size() > 0);
        CHECK(run.record.warnings[0].id == "W-THICKEN-THIN");
        REQUIRE(run.record.said.size() == 1);
        return run.record.warnings[0].message + " | " + run.record.said[0];
    };
    CHECK(thin(Unit::mm).find("is only 0.133296 mm thick instead of 0.5 mm | part: wall thickness at least "
                              "0.133296 mm, mean ") != std::string::npos);
    CHECK(thin(Unit::unknown).find("0.133296 scene units thick instead of 0.5 scene units | ") !=
          std::string::npos);
}

TEST_CASE("thicken leaves no skin without joints", "[stages]") {
    const auto wires = run_stage("thicken", "{thickness: 0.1, mode: edges}", test::skinned_cube());
    CHECK_FALSE(wires.scene.parts[0].skinned);
    CHECK(wires.scene.bounds().max.x < 2);
    CHECK(wires.record.warnings.at(0).id == "W-SKIN");
}

TEST_CASE("parts of one shape get one solid, and are told as each by itself", "[stages]") {
    Scene scene;
    for (int i = 0; i < 4; ++i) {
        Part& part = scene.parts.emplace_back();
        part.name = "p" + std::to_string(i);
        part.mesh =
            test::noisy_icosphere(2, 0.3, 1); // its walls turn over, and the warning gives the position
        part.transform.m[0][3] = 8.0 * i;
    }
    scene.parts[2].transform.m[1][1] = 2;      // another shape in the world
    scene.parts[3].mesh.positions[5].x += 0.1; // another mesh
    const auto together = run_stage("thicken", "0.5", scene);
    REQUIRE(together.scene.parts.size() == 4);
    CHECK(DistinctParts(together.scene).first == std::vector<std::size_t>{0, 0, 2, 3});
    std::size_t warnings = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        Scene single;
        single.parts.push_back(scene.parts[i]);
        const auto alone = run_stage("thicken", "0.5", single);
        const Part &one = alone.scene.parts[0], &same = together.scene.parts[i];
        CHECK(same.mesh.positions == one.mesh.positions);
        CHECK(same.mesh.corners == one.mesh.corners);
        CHECK(same.transform == one.transform);
        const Json &told = together.record.result["parts"][i], &expected = alone.record.result["parts"][0];
        CHECK(told["part"] == expected["part"]);
        CHECK(told["wall_faces"] == expected["wall_faces"]);
        CHECK(told["self_intersections"] == expected["self_intersections"]);
        CHECK(told["turned_faces"] == expected["turned_faces"]);
        CHECK(told["wall_thickness"]["min"].get<double>() ==
              Approx(expected["wall_thickness"]["min"].get<double>()));
        for (const auto& w : alone.record.warnings) {
            REQUIRE(warnings < together.record.warnings.size());
            CHECK(together.record.warnings[warnings++].message == w.message);
        }
    }
    CHECK(warnings == together.record.warnings.size());
}

TEST_CASE("thicken answers a thickness below zero with the other side", "[stages]") {
    const Value value = Value::scalar("-2mm", {});
    CHECK(test::problems_of("thicken", value)
              .starts_with(
                  "E-RANGE 'thickness' must be in the range x > 0, found '-2mm' | remove the minus sign"));
    CHECK(test::problems_of("thicken", Value::scalar("0", {})) ==
          "E-RANGE 'thickness' must be in the range x > 0, found '0'");
}
