// Documents that break rules of glTF 2.0. Severities and places are those of the Khronos validator, whose own
// files these are like.
#include "support/catch.hpp"

#include "io/gltf/document/container.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"

#include <cstring>
#include <fmt/format.h>

namespace check_test {

using namespace facetmill;
using test::failure;

/// A triangle with all that a document can have.
Json triangle() {
    return Json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"doubleSided": true}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR",
                       "min": [0], "max": [0]},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36,
                     "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
    })");
}

/// The error or the warnings of reading the document with changes (a merge patch).
std::string said(const char* changes) {
    Json json = triangle();
    json.merge_patch(Json::parse(changes));
    io::ReadLog log;
    std::string text = failure([&] { static_cast<void>(test::read_text(json.dump(), &log)); });
    for (const auto& warning : log.warnings) text += fmt::format(" | {} {}", warning.id, warning.message);
    return text;
}

TEST_CASE("a valid document gives no warning", "[gltf]") { CHECK(said("{}") == "nothing"); }

TEST_CASE("references to nothing and wrong types are refused with their place", "[gltf]") {
    const std::pair<const char*, const char*> cases[] = {
        {R"({"materials": [{"normalTexture": {"index": 2}}]})",
         "materials[0].normalTexture.index: refers to texture 2, but there are 0"},
        {R"({"textures": [{"sampler": 1}]})", "textures[0].sampler: refers to sampler 1, but there are 0"},
        {R"({"textures": [{"extensions": {"EXT_texture_webp": {"source": 0}}}], "extensionsUsed": ["EXT_texture_webp"]})",
         "textures[0].extensions.EXT_texture_webp.source: refers to image 0, but there are 0"},
        {R"({"nodes": [{"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}], "extensionsUsed": ["KHR_lights_punctual"]})",
         "nodes[0].extensions.KHR_lights_punctual.light: refers to light 0, but there are 0"},
        {R"({"nodes": [{"mesh": 0, "camera": 0}]})", "nodes[0].camera: refers to camera 0, but there are 0"},
        {R"({"animations": [{"channels": [{"sampler": 1, "target": {"path": "scale"}}], "samplers": [{"input": 1, "output": 0}]}]})",
         "animations[0].channels[0].sampler: refers to animation sampler 1, but there are 1"},
        {R"({"animations": [{"channels": [], "samplers": [{"output": 0}]}]})",
         "animations[0].samplers[0]: \"input\" is missing"},
        {R"({"materials": [{"doubleSided": 1}]})",
         "materials[0].doubleSided: expected true or false, found 1"},
        {R"({"materials": [{"name": 5}]})", "materials[0].name: expected a string, found 5"},
        {R"({"samplers": {}})", "samplers: expected an array, found an object"},
    };
    for (const auto& [changes, message] : cases) {
        INFO(changes);
        CHECK(said(changes).starts_with(std::string("malformed [E-GLTF] test: ") + message));
    }
}

TEST_CASE("other broken rules give a warning with their place", "[gltf]") {
    const std::pair<const char*, const char*> cases[] = {
        {R"({"materials": [{"pbrMetallicRoughness": {"roughnessFactor": 1.5}}]})",
         "materials[0].pbrMetallicRoughness.roughnessFactor: 1.5 is out of range"},
        {R"({"materials": [{"alphaMode": "GLASS"}]})", "materials[0].alphaMode: \"GLASS\" is not one of"},
        {R"({"nodes": [{"mesh": 0, "rotation": [0, 0, 0.5, 0.5]}]})",
         "nodes[0].rotation: is not a unit quaternion"},
        {R"({"cameras": [{"type": "perspective"}]})", "cameras[0]: its type is perspective, without"},
        {R"({"images": [{}]})", "images[0]: has no uri and no buffer view"},
        {R"({"textures": []})", "textures: is empty"},
        {R"({"nodes": [{"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": true}}}]})",
         "nodes[0].extensions.KHR_node_visibility: is not in extensionsUsed"},
        {R"({"animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}], "samplers": [{"input": 1, "output": 2}]}]})",
         "animations[0].samplers[0].output: has 3 values, expected 2"},
        {R"({"materials": [{"emissiveTexture": {"index": 0}}], "textures": [{}]})",
         "meshes[0].primitives[0].material: its emissiveTexture needs TEXCOORD_0"},
        {R"({"skins": [{"joints": [0], "inverseBindMatrices": 1}]})",
         "skins[0].inverseBindMatrices: must be MAT4 of floats"},
    };
    for (const auto& [changes, message] : cases) {
        INFO(changes);
        CHECK(said(changes).find(std::string("W-GLTF the document breaks a rule of glTF 2.0: ") + message) !=
              std::string::npos);
    }
}

TEST_CASE("wrong and missing minima and maxima are corrected", "[gltf]") {
    Json json = triangle();
    json["accessors"][0]["max"] = {2, 1, 0};
    json["accessors"][0].erase("min");
    io::ReadLog log;
    const Scene scene = test::read_text(json.dump(), &log);
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].message ==
          "the document breaks 2 rules of glTF 2.0: accessors[0]: \"min\" is missing; accessors[0]: \"max\" "
          "is wrong");
    const Json written = Json::parse(test::json_of(test::written(scene, "glb").files.at(0).bytes));
    CHECK(written["accessors"][0]["min"] == Json({0.0, 0.0, 0.0}));
    CHECK(written["accessors"][0]["max"] == Json({1.0, 1.0, 0.0}));
}

TEST_CASE("decimals of the same float32 are right minima", "[gltf]") {
    Json json = triangle();
    const float tenth = 0.1f;
    std::vector<float> positions{0, 0, 0, tenth, 0, 0, 0, 1, 0};
    io::Bytes binary(36);
    std::memcpy(binary.data(), positions.data(), 36);
    json["buffers"] = {{{"byteLength", 36}}};
    json["accessors"].erase(1);
    json["accessors"][0]["max"] = {0.1, 1, 0};
    io::ReadLog log;
    static_cast<void>(test::read_bytes(io::gltf::join_glb(json.dump(), binary), "glb", &log));
    CHECK(log.warnings.empty());
}

} // namespace check_test
