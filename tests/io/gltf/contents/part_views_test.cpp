// What viewers draw decides how parts are sized, merged and baked.
#include "io/gltf/gltf.hpp"
#include "io/gltf/read/skinned_pose.hpp"
#include "mesh/drawn_box.hpp"
#include "mesh/shapes.hpp"
#include "support/bench.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// A triangle, its scales at three times (0.01, 1, 0.5), and the times.
const char* const viewed_buffer =
    R"("buffers":[{"byteLength":84,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAACtcjPArXIzwK1yM8AACAPwAAgD8AAIA/AAAAPwAAAD8AAAA/AAAAAAAAgD8AAABA"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},{"buffer":0,"byteOffset":72,"byteLength":12}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":2,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";

Scene viewed_document(const std::string& nodes, const std::string& scenes, const std::string& more = "") {
    return read_text(fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":{},"nodes":{},{}{}}})",
                                 scenes, nodes, viewed_buffer, more));
}

const char* const growing_node =
    R"(,"animations":[{"samplers":[{"input":2,"output":1}],"channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}]}])";

Json viewed_json(const Scene& scene, const io::WriteSettings& settings = {}) {
    return Json::parse(json_of(written(scene, "glb", settings).files.at(0).bytes));
}

} // namespace

TEST_CASE("the largest pose is that of the largest key", "[io]") {
    const Scene scene = viewed_document(
        R"([{"scale":[0.01,0.01,0.01],"children":[1]},{"mesh":0,"translation":[2,0,0]},{"mesh":0}])",
        R"([{"nodes":[0,2]}])", growing_node);
    const auto views = io::part_views(scene);
    CHECK(views[0].animated);
    CHECK_FALSE(views[1].animated);
    CHECK(views[0].largest.point({1, 0, 0}) == Vec3{3, 0, 0});
    CHECK(io::drawn_bounds(scene).max == Vec3{3, 1, 0});
    CHECK(scene.bounds().max == Vec3{1, 1, 0});
    // Stages may have moved the part: the pose moves along.
    Scene moved = scene;
    moved.parts[0].transform.m[1][3] += 5;
    CHECK(io::part_views(moved)[0].largest.point({1, 0, 0}).y == Approx(5));
}

TEST_CASE("transform fits and centres what viewers draw", "[stages]") {
    const Scene scene = viewed_document(
        R"([{"scale":[0.01,0.01,0.01],"children":[1]},{"mesh":0,"translation":[2,0,0]},{"mesh":0}])",
        R"([{"nodes":[0,2]}])", growing_node);
    CHECK(io::posed_bounds(scene).max == Vec3{3, 1, 0});
    CHECK(io::posed_bounds(scene, {false, true}).max == Vec3{1, 1, 0});
    CHECK(io::posed_bounds(scene, {true, false}).min == Vec3{2, 0, 0});
    CHECK(run_stage("transform", "{fit: 6}", scene).record.result["fit_factor"] == 2);
    const Box centred = io::posed_bounds(run_stage("transform", "{centre: true}", scene).scene);
    CHECK(centred.min.x == Approx(-1.5));
    CHECK(centred.max.x == Approx(1.5));
    const Scene hidden = viewed_document(R"([{"mesh":0},{"mesh":0,"scale":[9,9,9]}])", R"([{"nodes":[0]}])");
    CHECK(run_stage("transform", "{fit: 6}", hidden).record.result["fit_factor"] == 6);
}

TEST_CASE("digits below a node that growing_node stay", "[io]") {
    const Scene scene = viewed_document(
        R"([{"scale":[1e-7,1e-7,1e-7],"children":[1]},{"mesh":0,"translation":[4.18033,1.23456,-2.71828]}])",
        R"([{"nodes":[0]}])", growing_node);
    for (const bool draco : {true, false}) {
        io::WriteSettings settings;
        (draco ? settings.draco.on : settings.quantize.on) = true;
        CHECK(viewed_json(scene, settings)["nodes"][1]["translation"] == Json({4.18033, 1.23456, -2.71828}));
    }
}

TEST_CASE("hidden scenes and lower levels do not count as drawn", "[io]") {
    const char* const levels =
        R"([{"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]}}},{"mesh":0,"scale":[9,9,9]},
{"mesh":0,"scale":[99,99,99]},{"mesh":0,"scale":[999,999,999],"extensions":{"KHR_node_visibility":{"visible":false}}}])";
    const Scene scene = viewed_document(levels, R"([{"nodes":[0,3]},{"nodes":[2]}])");
    const auto views = io::part_views(scene);
    CHECK(views[0].has_levels);
    CHECK(views[1].lower_level);
    CHECK(views[2].hidden);
    CHECK(views[3].hidden);
    CHECK(io::drawn_bounds(scene).max == Vec3{1, 1, 0});
}

TEST_CASE("unused vertices do not count as drawn", "[mesh]") {
    Mesh cube = shapes::cube();
    CHECK_FALSE(has_unused_vertices(cube));
    cube.positions.push_back({1e6, 0, 0});
    CHECK(has_unused_vertices(cube));
    CHECK(drawn_box(cube).max == Vec3{1, 1, 1});
    CHECK(drawn_box(cube).min == Vec3{0, 0, 0});
    cube.corners.clear();
    CHECK_FALSE(has_unused_vertices(cube)); // a cloud
    CHECK(drawn_box(cube).max.x == 1e6);
}

TEST_CASE("unused vertices do not widen the grid", "[stages]") {
    for (const char* option : {"quantize", "draco", "meshopt"}) {
        Bench b;
        b.scene = scene_in_metres(shapes::cube());
        b.scene.parts[0].mesh.positions[0] = {0.2501, 0.3334, 0.4143};
        b.scene.parts[0].mesh.positions.push_back({1e6, 1e6, 1e6});
        b.run("write", options({{"path", "c.glb"}, {option, "true"}}));
        CHECK(b.scene.parts[0].mesh.vertex_count() == 9);
        b.state.outputs.commit();
        Bench again;
        again.state.places = b.state.places;
        again.run("load", Value::scalar("c.glb"));
        REQUIRE(again.scene.parts[0].mesh.vertex_count() == 8);
        double nearest = HUGE_VAL;
        for (const Vec3& p : again.scene.parts[0].mesh.positions)
            nearest = std::min(
                nearest, length(again.scene.parts[0].transform.point(p) - Vec3{0.2501, 0.3334, 0.4143}));
        CHECK(nearest < 1.0 / 16383);
    }
}

TEST_CASE("merge leaves alone what it would show differently", "[stages]") {
    const Scene moving = viewed_document(R"([{"mesh":0},{"mesh":0},{"mesh":0,"translation":[1,0,0]}])",
                                         R"([{"nodes":[0,1,2]}])", growing_node);
    auto run = run_stage("merge", "", moving);
    CHECK(run.warnings() == std::vector<std::string>{"W-MERGE-STAYS"});
    CHECK(run.scene.parts.size() == 2);
    const Json json = viewed_json(run.scene);
    CHECK(json["nodes"].size() == 2); // the emptied nodes are gone
    CHECK(json["animations"][0]["channels"][0]["target"]["node"] == 0);

    const Scene hidden =
        viewed_document(R"([{"mesh":0},{"mesh":0},{"mesh":0}])", R"([{"nodes":[0,1]},{"nodes":[2]}])");
    run = run_stage("merge", "", hidden);
    CHECK(run.warnings() == std::vector<std::string>{"W-MERGE-STAYS"});
    CHECK(run.scene.parts.size() == 2);

    const Scene levels = viewed_document(R"([{"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]}}},{"mesh":0}])",
                                         R"([{"nodes":[0]}])");
    run = run_stage("merge", "", levels);
    CHECK(run.scene.parts.size() == 2);
    CHECK(run.record.result.contains("part") == false);
}

TEST_CASE("merge and bake leave instances where they are", "[stages]") {
    const Scene scene = viewed_document(
        R"([{"mesh":0,"scale":[1,2,1],"translation":[10,0,0],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}])",
        R"([{"nodes":[0]}])", R"(,"extensionsUsed":["EXT_mesh_gpu_instancing"])");
    for (const char* stage : {"merge", "transform"}) {
        const auto run = run_stage(stage, stage == std::string("merge") ? "" : "{bake: true}", scene);
        CHECK(run.record.warnings.size() == 1);
        CHECK(viewed_json(run.scene)["nodes"] == Json::parse(scene.documents[0]->json)["nodes"]);
    }
}

TEST_CASE("baking keeps the node of a camera", "[stages]") {
    const Scene scene = viewed_document(
        R"([{"mesh":0,"camera":0,"translation":[1,0,0]}])", R"([{"nodes":[0]}])",
        R"(,"cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":9,"znear":1}}])");
    const auto run = run_stage("transform", "{bake: true}", scene);
    CHECK(run.warnings() == std::vector<std::string>{"W-TRANSFORM"});
    CHECK(viewed_json(run.scene)["nodes"][0]["translation"] == Json({1, 0, 0}));
}

TEST_CASE("cameras and lights move with the scene as a whole", "[stages]") {
    const Scene scene = viewed_document(
        R"([{"mesh":0},{"camera":0,"translation":[1,2,3]},{"extensions":{"KHR_lights_punctual":{"light":0}},"translation":[4,0,0],"children":[3]},{"mesh":0}])",
        R"([{"nodes":[0,1,2]}])",
        R"(,"cameras":[{"type":"perspective","perspective":{"yfov":1,"zfar":100,"znear":0.5}}],
"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","range":8,"intensity":40}]}})");
    const auto run = run_stage("transform", "{scale: 0.5, translate: [0, 1, 0]}", scene);
    const Json json = viewed_json(run.scene);
    CHECK(json["cameras"][0]["perspective"] == Json({{"yfov", 1}, {"zfar", 50.0}, {"znear", 0.25}}));
    const Json& light = json["extensions"]["KHR_lights_punctual"]["lights"][0];
    CHECK(light["range"] == 4.0);
    CHECK(light["intensity"] == 10.0); // 10 cd at half the distance light as much as 40 cd
    CHECK(json["nodes"][1]["matrix"] ==
          Json({1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.5, 2.0, 1.5, 1.0}));
    const Scene back = again(run.scene);
    CHECK(back.bounds().max == run.scene.bounds().max);
    CHECK(back.bounds().min == run.scene.bounds().min);
}
