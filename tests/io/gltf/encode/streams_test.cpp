// Animations under meshopt's filters.
#include "support/catch.hpp"
#include "support/gltf.hpp"

#include <fmt/format.h>

using namespace facetmill;

namespace {

std::string in_base64(std::span<const std::byte> bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
        const auto x = std::to_integer<unsigned>(bytes[i]) << 16 |
                       std::to_integer<unsigned>(bytes[i + 1]) << 8 | std::to_integer<unsigned>(bytes[i + 2]);
        for (const int shift : {18, 12, 6, 0}) text += digits[x >> shift & 63];
    }
    return text;
}

/// The type of the written rotations of an animation with these two keys.
int type_of_rotations(std::array<float, 4> first, std::array<float, 4> second) {
    std::vector<float> all{0, 0, 0, 1, 0, 0, 0, 1, 0}; // a triangle
    all.insert(all.end(), first.begin(), first.end());
    all.insert(all.end(), second.begin(), second.end());
    all.insert(all.end(), {0, 1, 0, 0}); // the times, and a rest for whole digits
    const std::string text = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
"animations":[{{"samplers":[{{"input":2,"output":1}}],"channels":[{{"sampler":0,"target":{{"node":0,"path":"rotation"}}}}]}}],
"skins":[{{}}],
"buffers":[{{"byteLength":84,"uri":"data:application/octet-stream;base64,{}"}}],
"bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":32}},{{"buffer":0,"byteOffset":68,"byteLength":8}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5126,"count":2,"type":"VEC4"}},
{{"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]}}]}})",
        in_base64(std::as_bytes(std::span(all))));
    io::WriteSettings settings;
    settings.quantize.on = settings.meshopt.on = true;
    const auto glb = test::written(test::read_text(text), "glb", settings).files.at(0).bytes;
    const Json json = Json::parse(test::json_of(glb));
    CHECK(json["skins"][0] == Json::object()); // no "joints": null
    const auto output = json["animations"][0]["samplers"][0]["output"].get<std::size_t>();
    return json["accessors"][output]["componentType"].get<int>();
}

} // namespace

TEST_CASE("a half turn keeps its direction, so its keys are not rounded", "[io]") {
    CHECK(type_of_rotations({0, 0, 0, 1}, {0, 0, 1, -4e-8F}) == 5126);
    CHECK(type_of_rotations({0, 0, 0, 1}, {0, 0, 1, 0}) == 5126);
    CHECK(type_of_rotations({0, 0, 0, 1}, {0, 0, 0.6F, 0.8F}) == 5122);
}
