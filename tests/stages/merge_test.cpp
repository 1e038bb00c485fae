#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/meshes.hpp"
#include "support/run_stage.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;
using test::run_stage;
using test::scene_of;

TEST_CASE("merge joins parts in the world, separate takes them apart again", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "other";
    scene.parts[1].transform.m[0][3] = 5;
    auto run = run_stage("merge", "{name: both}", scene);
    REQUIRE(run.scene.parts.size() == 1);
    CHECK(run.scene.parts[0].name == "both");
    CHECK(run.scene.parts[0].mesh.face_count() == 24);
    CHECK(run.scene.bounds().min == Vec3{0, 0, 0});
    CHECK(run.scene.bounds().max == Vec3{6, 1, 1});
    for (const std::string by : {"group", "component"}) {
        const auto apart = run_stage("separate", by, run.scene);
        REQUIRE(apart.scene.parts.size() == 2);
        CHECK(apart.scene.parts[1].name == "both.1");
        CHECK(apart.scene.parts[0].mesh.vertex_count() == 8);
        CHECK(apart.scene.parts[1].mesh.bounds().min == Vec3{5, 0, 0});
        CHECK(inspect(apart.scene).closed);
    }
}

TEST_CASE("merge welds coincident vertices", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].transform.m[0][3] = 1;
    const auto run = run_stage("merge", "{weld: true}", scene);
    CHECK(run.record.result["welded_vertices"] == 4);
    CHECK(run.scene.parts[0].mesh.vertex_count() == 12);
}

TEST_CASE("merge gives no part the name of another", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    for (const char* name : {"arm", "leg"}) {
        scene.parts.push_back(scene.parts[0]);
        scene.parts.back().name = name;
    }
    const StageInfo& merge = test::stage_for_test("merge");
    Problems problems;
    const auto use = test::use_of(merge, Value::scalar("leg"), problems);
    test::StageRun run;
    const PartFilter some{{"part", "arm"}};
    Context context(*run.state, run.record, some, scene.bounds(), {});
    const Scene merged = use->run(std::move(scene), context);
    REQUIRE(merged.parts.size() == 2);
    CHECK(merged.parts[0].name == "leg_2");
}

TEST_CASE("merge leaves no joints without a skin", "[stages]") {
    const auto merged = run_stage("merge", "", test::skinned_cube());
    CHECK_FALSE(merged.scene.parts[0].skinned);
    CHECK(merged.warnings() == std::vector<std::string>{"W-SKIN"});
    CHECK(merged.scene.parts[0].mesh.find("JOINTS_0", Domain::wedge) == nullptr);
    CHECK(merged.scene.parts[0].mesh.find("WEIGHTS_0", Domain::wedge) == nullptr);
}

TEST_CASE("merge reports the parts that it leaves, and why", "[stages]") {
    const Scene scene = test::read_text(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"mesh":0,"name":"still"},{"mesh":0,"name":"moving"},{"mesh":0,"name":"other"},{"mesh":0,"name":"unseen"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":52,"byteLength":8}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
{"bufferView":0,"componentType":5126,"count":2,"type":"VEC3"}],
"animations":[{"samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]}]})");
    const auto run = run_stage("merge", "", scene);
    CHECK(run.record.result["merged"] == Json::array({"still", "other"}));
    REQUIRE(run.record.result["staying"].size() == 2);
    CHECK(run.record.result["staying"][0]["reason"] == "animated");
    CHECK(run.record.result["staying"][0]["parts"] == Json::array({"moving"}));
    CHECK(run.record.result["staying"][1]["reason"] == "hidden");
    CHECK(run.record.result["staying"][1]["parts"] == Json::array({"unseen"}));
}

TEST_CASE("merge without attributes leaves a surface without seams", "[stages]") {
    Scene scene = scene_of(shapes::uv_cube());
    scene.materials.resize(1);
    scene.parts[0].mesh.primitives.resize(1);
    scene.parts[0].mesh.primitives[0].material = 0;
    const auto run = run_stage("merge", "{attributes: none}", scene);
    const Mesh& mesh = run.scene.parts[0].mesh;
    CHECK_FALSE(mesh.has_seams());
    CHECK(mesh.wedge_count() == 8);
    CHECK(mesh.primitives.empty());
    CHECK(mesh.attributes.empty());
}
