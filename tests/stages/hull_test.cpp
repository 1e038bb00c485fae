#include "support/catch.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::refusal_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("hull: replaces a part, or stays next to it by the name of an engine", "[stages]") {
    const auto plain = run_stage("hull", "", scene_of(shapes::uv_cube()));
    REQUIRE(plain.scene.parts.size() == 1);
    CHECK(plain.scene.parts[0].name == "part");
    CHECK(plain.mesh().vertex_count() == 8);
    CHECK(plain.mesh().attributes.empty());
    CHECK(plain.record.result["shapes"][0]["volume"] == 1);

    const auto kept = run_stage("hull", "{engine: unreal, keep: true}", scene_of(shapes::uv_cube()));
    REQUIRE(kept.scene.parts.size() == 2);
    CHECK(kept.scene.parts[0].name == "part");
    CHECK(kept.scene.parts[0].mesh.has_seams());
    CHECK(kept.scene.parts[1].name == "UCX_part_00");
    const auto name = [](const char* options) {
        return run_stage("hull", options, scene_of(shapes::cube())).scene.parts.at(0).name;
    };
    CHECK(name("{engine: unreal, shape: box}") == "UBX_part_00");
    CHECK(name("{engine: unreal, shape: sphere}") == "USP_part_00");
    CHECK(name("{engine: unreal, shape: capsule}") == "UCP_part_00");
    CHECK(name("{engine: godot}") == "part-convcolonly");
    CHECK(name("{engine: unity}") == "part_collider");
}

TEST_CASE("hull: one shape around a scene is in world space", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].transform.m[0][3] = 9;
    const auto run = run_stage("hull", "{per: scene}", scene);
    REQUIRE(run.scene.parts.size() == 1);
    CHECK(run.record.result["shapes"][0]["volume"] == 10);
    CHECK(run.scene.bounds().max.x == 10);
}

TEST_CASE("hull: refuses parts without a hull, and nodes that distort shapes", "[stages]") {
    Mesh line;
    line.positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    CHECK(refusal_of("hull", "", scene_of(line)).find("all its points are on a line") != std::string::npos);
    CHECK(refusal_of("hull", "", scene_of(Mesh{})).find("it has no points") != std::string::npos);
    Scene wide = scene_of(shapes::cube());
    wide.parts[0].transform.m[0][0] = 2;
    CHECK(refusal_of("hull", "box", wide).find("scales directions differently") != std::string::npos);
    CHECK(run_stage("hull", "", wide).record.result["shapes"][0]["volume"] == 2);
    CHECK(run_stage("hull", "", scene_of(shapes::grid(3, 3))).warnings() ==
          std::vector<std::string>{"W-HULL-FLAT"});
}

TEST_CASE("hull: numbers the shapes of a divided part", "[stages][convex-parts]") {
    Mesh mesh = shapes::cube();
    Mesh far = mesh;
    for (Vec3& p : far.positions) p.x += 3;
    append(mesh, far);
    const auto names = [&](const std::string& engine) {
        std::vector<std::string> all;
        for (const Part& part :
             run_stage("hull", "{max_parts: 4, engine: " + engine + "}", scene_of(mesh)).scene.parts)
            all.push_back(part.name);
        return all;
    };
    using Names = std::vector<std::string>;
    CHECK(names("none") == Names{"part_00", "part_01"});
    CHECK(names("unreal") == Names{"UCX_part_00", "UCX_part_01"});
    CHECK(names("godot") == Names{"part_00-convcolonly", "part_01-convcolonly"});
    CHECK(names("unity") == Names{"part_collider_00", "part_collider_01"});
    Scene scene = scene_of(mesh);
    scene.parts[0].transform.m[0][0] = 2;
    CHECK(refusal_of("hull", "{max_parts: 4}", scene).find("would distort distances") != std::string::npos);
    const auto world = run_stage("hull", "{max_parts: 4, per: scene, concavity: 0.2}", scene);
    REQUIRE(world.scene.parts.size() == 2);
    CHECK(world.record.result["shapes"][0]["volume"].get<double>() == Approx(2).epsilon(1e-4));
    CHECK(refusal_of("hull", "{max_parts: 4}", scene_of(Mesh{})).find("cannot be divided") !=
          std::string::npos);
}
