// glTF contents other than meshes, without their indices.
#include "io/codec.hpp"
#include "io/gltf/gltf.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

using namespace facetmill;

namespace {

/// A triangle with a textured material, an animation and a skin. Parameters set the number of the texture,
/// the entries before it, and the JSON that holds the image.
std::string document(int padding, const std::string& image, const std::string& factor = "0.5") {
    std::string first = padding > 0 ? R"({"name":"unused","uri":"data:,"},)" : "";
    std::string sampler = padding > 0 ? R"({"magFilter":9728},)" : "", texture = padding > 0 ? "{}," : "";
    const std::string p = std::to_string(padding);
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
 "nodes":[{"name":"body","mesh":0,"skin":0},{"name":"bone"}],
 "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
 "materials":[{"name":"skin","pbrMetallicRoughness":{"roughnessFactor":)" +
           factor + R"(,"baseColorTexture":{"index":)" + p + R"(,"texCoord":0}}}],
 "textures":[)" +
           texture + R"({"source":)" + p + R"(,"sampler":)" + p + R"(}],
 "samplers":[)" +
           sampler + R"({"wrapS":33071}],"images":[)" + first + R"({"uri":")" + image + R"("}],
 "animations":[{"samplers":[{"input":1,"output":0}],"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]}],
 "skins":[{"joints":[1]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
              {"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[0]}],
 "bufferViews":[{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

Json material_of(const std::string& text) {
    const Scene scene = test::read_text(text.c_str());
    return io::MaterialContents(scene).of(scene.materials.at(0));
}

const std::string picture = "data:image/png;base64,AAECAwQF",
                  other_picture = "data:image/png;base64,AAECAwQG";

} // namespace

TEST_CASE("a material's contents do not depend on numbers in the document", "[io]") {
    CHECK(material_of(document(0, picture)) == material_of(document(1, picture)));
    CHECK(material_of(document(0, picture)) != material_of(document(0, other_picture)));
    CHECK(material_of(document(0, picture)) != material_of(document(0, picture, "0.25")));
    const Json image = material_of(document(0, picture))["pbrMetallicRoughness"]["baseColorTexture"]["index"];
    // SHA-256 of the bytes 0 1 2 3 4 5
    CHECK(image["source"] == "17e88db187afd62c16e5debf3e6527cd006bc012bc90b51a810cd80c2d511f43");
    CHECK(image["sampler"]["wrapS"] == 33071);
}

TEST_CASE("animations and skins name nodes and have digests of their numbers", "[io]") {
    const Json contents = io::document_contents(test::read_text(document(0, picture).c_str()));
    CHECK(contents["animations"][0]["channels"][0]["target"]["node"] == "bone");
    CHECK(contents["animations"][0]["samplers"][0]["output"]["count"] == 3);
    CHECK(contents["animations"][0]["samplers"][0]["output"]["sha256"] !=
          contents["animations"][0]["samplers"][0]["input"]["sha256"]);
    CHECK(contents["skins"][0]["joints"] == Json::array({"bone"}));
    CHECK(contents["cameras"].empty());
    CHECK(io::document_contents(Scene{}).is_null());
}

TEST_CASE("what an animation drives is known, however the document spells it", "[io]") {
    std::string text = document(0, picture);
    const std::size_t bone = text.find("\"node\":1");
    text.replace(bone, 8, "\"node\":0");
    CHECK(io::part_views(test::read_text(text)).at(0).animated);
    CHECK_FALSE(io::part_views(test::read_text(document(0, picture))).at(0).animated);
    text.replace(text.find("\"animations\""), 12, R"("\u0061nimations")");
    CHECK(io::part_views(test::read_text(text)).at(0).animated);
}
