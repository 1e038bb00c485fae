#include "io/codec.hpp"
#include "io/convert.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

#include <fmt/format.h>

using namespace facetmill;

namespace {

/// A triangle whose material depends on two variants. more: further members of the document.
std::string with_variants(const std::string& names, const std::string& material, const std::string& more) {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"extensionsUsed":["KHR_materials_variants"{}],
 "extensions":{{"KHR_materials_variants":{{"variants":[{}]}}}},
 "scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"materials":[{{"name":"plain"}},{{"name":"{}"}}],
 "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0,
 "extensions":{{"KHR_materials_variants":{{"mappings":[{{"material":1,"variants":[0,1]}}]}}}}}}]}}],
 "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}],
 "bufferViews":[{{"buffer":0,"byteLength":36}}],
 "buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}]}})",
        more, names, material);
}

} // namespace

TEST_CASE("variants of another document follow its materials and variants", "[io]") {
    Scene scene = test::read_text(with_variants(R"({"name":"winter"},{"name":"summer"})", "red", ""));
    // An unknown extension keeps the second document from being joined as a whole.
    io::add_scene(scene, test::read_text(with_variants(R"({"name":"summer"},{"name":"autumn"})", "green",
                                                       R"(,"EXT_of_somebody")")));
    const Json json = Json::parse(test::json_of(test::written(scene, "glb").files.at(0).bytes));
    const Json& variants = json["extensions"]["KHR_materials_variants"]["variants"];
    REQUIRE(variants.size() == 3);
    CHECK(variants[2]["name"] == "autumn");
    REQUIRE(json["meshes"].size() == 2);
    const auto material = [&](std::size_t mesh) {
        const Json& mapping =
            json["meshes"][mesh]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0];
        return std::pair(json["materials"][mapping["material"].get<std::size_t>()]["name"].get<std::string>(),
                         mapping["variants"].get<std::vector<int>>());
    };
    CHECK(material(0) == std::pair(std::string("red"), std::vector{0, 1}));
    CHECK(material(1) == std::pair(std::string("green"), std::vector{1, 2}));
}

TEST_CASE("integers of a glTF with a point are integers", "[io]") {
    std::string text = with_variants(R"({"name":"a"},{"name":"b"})", "red", "");
    const auto put = [&](const std::string& from, const std::string& to) {
        REQUIRE(text.find(from) != std::string::npos);
        text.replace(text.find(from), from.size(), to);
    };
    put(R"("scene":0)", R"("scene":0.0)");
    put(R"("nodes":[0])", R"("nodes":[0.0])");
    put(R"("mesh":0)", R"("mesh":0.0,"extras":{"mesh":1.0})");
    put(R"("POSITION":0)", R"("POSITION":0.0)");
    put(R"("material":0)", R"("material":0.0)");
    put(R"("material":1,"variants":[0,1])", R"("material":1.0,"variants":[0.0,1.0])");
    put(R"("bufferView":0,"componentType":5126,"count":3)",
        R"("bufferView":0.0,"componentType":5126.0,"count":3.0)");
    put(R"("buffer":0,"byteLength":36)", R"("buffer":0.0,"byteLength":36.0)");
    io::ReadLog log;
    Scene scene = test::read_text(text, &log);
    CHECK(log.warnings.empty());
    scene.parts.at(0).mesh.positions.at(0).z = 1;
    scene.parts[0].changed = true;
    const Json json = Json::parse(test::json_of(test::written(scene, "glb").files.at(0).bytes));
    CHECK(json["scenes"][0]["nodes"].dump() == "[0]");
    CHECK(json["nodes"][0].dump() == R"({"mesh":0,"extras":{"mesh":1.0}})");
    CHECK(json["meshes"][0]["primitives"][0]["extensions"].dump() ==
          R"({"KHR_materials_variants":{"mappings":[{"material":1,"variants":[0,1]}]}})");
    CHECK(test::again(scene).parts.at(0).mesh.positions.at(0).z == 1);
}
