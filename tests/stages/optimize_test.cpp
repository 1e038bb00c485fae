#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"
#include "support/run_stage.hpp"

#include "io/png.hpp"
#include "mesh/shapes.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

const char* const buffer =
    R"("buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}])";

/// A document of these nodes, meshes and whatever else.
Scene document(const std::string& nodes, const std::string& meshes, const std::string& more = "") {
    const Json list = Json::parse("[" + nodes + "]");
    std::set<std::size_t> children;
    for (const Json& node : list)
        for (const Json& child : node.value("children", Json::array()))
            children.insert(child.get<std::size_t>());
    Json roots = Json::array();
    for (std::size_t n = 0; n < list.size(); ++n)
        if (!children.contains(n)) roots.push_back(n);
    return read_text(fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":{}}}],"nodes":[{}],"meshes":[{}],{}{}}})",
        roots.dump(), nodes, meshes, buffer, more.empty() ? "" : "," + more));
}

std::string mesh(int material, int accessor = 0, const std::string& more = "") {
    return fmt::format(
        R"({{"primitives":[{{"attributes":{{"POSITION":{},"TEXCOORD_0":1}},"material":{}}}]{}}})", accessor,
        material, more);
}

std::string colour(const std::string& name, double red) {
    return fmt::format(R"({{"name":"{}","pbrMetallicRoughness":{{"baseColorFactor":[{},0,0,1]}}}})", name,
                       red);
}

/// What is drawn, in the world.
std::vector<std::vector<float>> drawn_in_world(Scene scene) {
    std::vector<std::vector<float>> all;
    for (Part& part : scene.parts) {
        apply(part.mesh, part.transform);
        for (auto& face : drawn(part.mesh)) all.push_back(face);
    }
    std::sort(all.begin(), all.end());
    return all;
}

Json json_again(const Scene& scene) { return Json::parse(again(scene).documents.at(0)->json); }

} // namespace

TEST_CASE("optimize joins parts of equal materials, and what is seen stays", "[stages]") {
    const Scene scene = document(
        R"({"mesh":0,"name":"a"},{"mesh":1,"name":"b","translation":[5,0,0]},{"name":"group","children":[3],"scale":[2,2,2]},
{"mesh":2,"name":"c","rotation":[0,0,1,0]})",
        mesh(0) + "," + mesh(1, 2) + "," + mesh(2, 2),
        R"("materials":[)" + colour("red", 1) + "," + colour("rot", 1) + "," + colour("dark", 0.1) + "]");
    // Else the first two would share one mesh.
    Scene own = scene;
    own.parts[1].mesh.positions[0].z = 0.5;
    own.parts[1].changed = true;
    const auto run = run_stage("optimize", "{}", own);
    CHECK(run.warnings().empty());
    REQUIRE(run.scene.parts.size() == 2);
    CHECK(run.record.result["draw_calls_before"] == 3);
    CHECK(run.record.result["draw_calls_after"] == 2);
    CHECK(run.record.result["equal_materials"] == 1);
    CHECK(run.record.result["joined"] == Json::array({"a"}));
    CHECK(run.record.result["erased"]["nodes"] == 1);
    CHECK(run.record.result["erased"]["materials"] == 1);
    CHECK(drawn_in_world(run.scene) == drawn_in_world(own));
    CHECK(drawn_in_world(again(run.scene)) == drawn_in_world(own));
    const Json json = json_again(run.scene);
    CHECK(json["meshes"].size() == 2);
    CHECK(json["materials"].size() == 2);
    CHECK(json["nodes"].size() == 3);
}

TEST_CASE("meshes that are equal to the bit become one, which stays shared", "[stages]") {
    const auto run =
        run_stage("optimize", "{}",
                  document(R"({"mesh":0,"name":"a"},{"mesh":1,"name":"b","translation":[5,0,0]})",
                           mesh(0) + "," + mesh(0, 2), R"("materials":[)" + colour("red", 1) + "]"));
    CHECK(run.scene.parts.size() == 2);
    CHECK(run.record.result["equal_meshes"] == 1);
    const Json json = json_again(run.scene);
    CHECK(json["meshes"].size() == 1);
    CHECK(json["nodes"][1]["mesh"] == 0);
    CHECK(json["nodes"][1]["name"] == "b");
    CHECK(json["accessors"].size() == 2);
    const auto apart = run_stage("optimize", "{dedup: false, join: false, prune: false}",
                                 document(R"({"mesh":0},{"mesh":1})", mesh(0) + "," + mesh(0, 2),
                                          R"("materials":[)" + colour("red", 1) + "]"));
    CHECK(json_again(apart.scene)["meshes"].size() == 2);
    CHECK(json_again(apart.scene)["accessors"].size() == 3);
}

TEST_CASE("images of equal bytes become one, with their textures and materials", "[stages]") {
    const std::string uri = "data:image/png;base64," + io::base64(to_bytes(red_png()));
    const auto textured = [](int texture) {
        return fmt::format(R"({{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":{}}}}}}})", texture);
    };
    const std::string more = fmt::format(
        R"("images":[{{"uri":"{0}","name":"x"}},{{"uri":"{0}"}},{{"uri":"unused.png","name":"y"}}],
"textures":[{{"source":0}},{{"source":1}}],"materials":[{1},{2}],"samplers":[{{"magFilter":9728}}])",
        uri, textured(0), textured(1));
    io::ReadLog log;
    const Scene scene =
        document(R"({"mesh":0},{"mesh":1,"translation":[3,0,0]})", mesh(0) + "," + mesh(1, 2), more);
    const auto run = run_stage("optimize", "{}", scene);
    const Json json = json_again(run.scene);
    CHECK(json["images"].size() == 1);
    CHECK(json["textures"].size() == 1);
    CHECK(json["materials"].size() == 1);
    CHECK(json["meshes"].size() == 1);
    CHECK_FALSE(json.contains("samplers"));
    CHECK(run.record.result["erased"]["images"] == 2);
}

TEST_CASE("optimize leaves alone what something else depends on", "[stages]") {
    const std::string materials = R"("materials":[)" + colour("red", 1) + "]";
    const std::string channel =
        R"("animations":[{"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}],
"samplers":[{"input":3,"output":0}]}])";
    const auto parts_left = [&](const std::string& second, const std::string& second_mesh,
                                const std::string& more, const std::string& options = "{dedup: false}") {
        const Scene scene =
            document(R"({"mesh":0,"name":"a"},)" + second, mesh(0) + "," + second_mesh, materials + more);
        return run_stage("optimize", options, scene).scene.parts.size();
    };
    const std::string plain = R"({"mesh":1,"name":"b","translation":[5,0,0]})";
    CHECK(parts_left(plain, mesh(0, 2), "") == 1);
    CHECK(parts_left(plain, mesh(0, 2), "", "{dedup: false, keep_names: true}") == 2);
    CHECK(parts_left(plain, mesh(0, 2), "", "{dedup: false, join: false}") == 2);
    CHECK(parts_left(R"({"mesh":1,"extras":{"door":1}})", mesh(0, 2), "") == 2);
    CHECK(parts_left(plain, mesh(0, 2, R"(,"extras":{"door":1})"), "") == 2);
    CHECK(parts_left(R"({"mesh":1,"camera":0})", mesh(0, 2),
                     R"(,"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}])") == 2);
    CHECK(parts_left(R"({"mesh":1,"scale":[0,1,1]})", mesh(0, 2), "") == 2);
    Json animated = Json::parse("{" + channel + "}");
    animated["animations"][0]["samplers"][0]["input"] = 1;
    CHECK(parts_left(plain, mesh(0, 2), R"(,"animations":)" + animated["animations"].dump()) == 2);
    CHECK(parts_left(R"({"children":[2],"name":"g"},{"mesh":1})", mesh(0, 2),
                     R"(,"animations":)" + animated["animations"].dump()) == 2);
}

TEST_CASE("nothing is erased beside an extension that is not known", "[stages]") {
    const auto run = run_stage(
        "optimize", "{}",
        document(R"({"mesh":0},{"mesh":1,"translation":[5,0,0],"extensions":{"ACME_door":{"node":0}}})",
                 mesh(0) + "," + mesh(0, 2),
                 R"("extensionsUsed":["ACME_door"],"materials":[)" + colour("red", 1) + "," +
                     colour("blue", 0) + "]"));
    CHECK(run.warnings() == std::vector<std::string>{"W-OPTIMIZE"});
    CHECK(run.scene.parts.size() == 2);
    CHECK(json_again(run.scene)["materials"].size() == 2);
}

TEST_CASE("optimize takes scenes of any origin, also empty ones", "[stages]") {
    CHECK(run_stage("optimize", "{}", scene_of(Mesh{})).record.result["draw_calls_before"] == 0);
    Scene two = scene_of(shapes::cube());
    two.parts.push_back(two.parts[0]);
    two.parts[1].transform.m[0][3] = 9;
    two.parts[1].name = "other";
    const auto run = run_stage("optimize", "{}", two);
    REQUIRE(run.scene.parts.size() == 1);
    CHECK(run.scene.parts[0].mesh.face_count() == 2 * two.parts[0].mesh.face_count());
    CHECK(run.scene.bounds().max.x == two.bounds().max.x);
    CHECK(run_stage("optimize", "{join: false}", two).scene.parts.size() == 2);
}
