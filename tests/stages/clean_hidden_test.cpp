#include "io/images/png.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::run_stage;

namespace {

std::size_t add_floats(Json& json, const std::vector<float>& numbers, const char* type, std::size_t count) {
    const auto bytes = std::as_bytes(std::span(numbers));
    json["buffers"].push_back(
        {{"byteLength", bytes.size()},
         {"uri", "data:application/octet-stream;base64," + io::base64({bytes.begin(), bytes.end()})}});
    json["bufferViews"].push_back({{"buffer", json["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", 5126},
                                 {"count", count},
                                 {"type", type}});
    return json["accessors"].size() - 1;
}

/// A ball of radius 1 around a small cube, in nodes 0 and 1.
Json cube_in_ball() {
    Scene scene = test::scene_in_metres(shapes::icosphere(2), "ball");
    Mesh cube = shapes::cube();
    for (Vec3& p : cube.positions) p = p * 0.1;
    Part part;
    part.name = "seed";
    part.mesh = cube;
    scene.parts.push_back(std::move(part));
    const Scene read = test::again(scene);
    Json json = Json::parse(read.documents.at(0)->json);
    json["buffers"][0]["uri"] =
        "data:application/octet-stream;base64," + io::base64(read.documents[0]->buffers.at(0));
    return json;
}

/// The faces of the cube that remain.
std::size_t faces_left(const Json& json) {
    const auto run = run_stage("clean", "{hidden: true}", test::read_text(json.dump()));
    for (const Part& part : run.scene.parts) {
        if (part.name == "ball") CHECK(part.mesh.face_count() == 320);
        if (part.name == "seed") return part.mesh.face_count();
    }
    return 0;
}

Json with_instances(const std::vector<float>& translations) {
    Json json = cube_in_ball();
    const std::size_t at = add_floats(json, translations, "VEC3", translations.size() / 3);
    for (Json& node : json["nodes"])
        if (node["name"] == "seed")
            node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = at;
    json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    return json;
}

} // namespace

TEST_CASE("clean: a face is hidden only if it is hidden at every instance", "[stages][hidden]") {
    CHECK(faces_left(cube_in_ball()) == 0);
    CHECK(faces_left(with_instances({0, 0, 0, 0.2F, 0, 0})) == 0);
    CHECK(faces_left(with_instances({0, 0, 0, 5, 0, 0})) == 12);
}

TEST_CASE("clean: instances hide faces", "[stages][hidden]") {
    Json json = cube_in_ball(); // the ball at 9 and at the cube
    const std::size_t at = add_floats(json, {9, 0, 0, 0, 0, 0}, "VEC3", 2);
    for (Json& node : json["nodes"])
        if (node["name"] == "ball")
            node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = at;
    json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    CHECK(faces_left(json) == 0);
}

TEST_CASE("clean: animated parts keep their faces and hide nothing", "[stages][hidden]") {
    for (const char* moved : {"seed", "ball"}) {
        Json json = cube_in_ball();
        const std::size_t times = add_floats(json, {0, 1}, "SCALAR", 2),
                          values = add_floats(json, {0, 0, 0, 5, 0, 0}, "VEC3", 2);
        json["accessors"][times]["min"] = {0.0};
        json["accessors"][times]["max"] = {1.0};
        std::size_t node = 0;
        while (json["nodes"][node]["name"] != moved) ++node;
        json["animations"] = {
            {{"samplers", {{{"input", times}, {"output", values}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}}};
        CHECK(faces_left(json) == 12);
    }
}
