#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include <fmt/format.h>

using namespace facetmill;
using test::run_stage;

namespace {

/// A triangle of one metre with a material, below a node.
Scene triangle(const std::string& node, const std::string& material) {
    return test::read_text(fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
 "nodes":[{{"name":"root",{}"mesh":0}}],"materials":[{{"name":"paint","pbrMetallicRoughness":{}}}],
 "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],
 "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}],
 "bufferViews":[{{"buffer":0,"byteLength":36}}],
 "buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}]}})",
        node, material));
}

/// The names of the failed checks, separated by blanks.
std::string failed(const std::string& options, const Scene& scene) {
    const auto run = run_stage("validate", options, scene);
    std::string all;
    for (const auto& check : run.state->record.checks)
        if (!check.passed) all += (all.empty() ? "" : " ") + check.name;
    return all;
}

constexpr const char* grey = R"({"baseColorFactor":[0.2,0.2,0.2,1],"metallicFactor":0})";

} // namespace

TEST_CASE("validate: each fault of an asset fails its own check", "[stages][validate]") {
    CHECK(failed("{for: shop}", triangle("", grey)).empty());
    CHECK(failed("{for: shop}", triangle(R"("translation":[0,0,1],)", grey)) == "moved_roots");
    CHECK(failed("{for: unreal}", triangle(R"("rotation":[0,1,0,0],)", grey)) == "moved_roots");
    CHECK(failed("{for: unity}", triangle(R"("scale":[1,1,1],"translation":[0,0,0],)", grey)).empty());
    CHECK(
        failed("{for: shop}", triangle("", R"({"baseColorFactor":[0.2,0.2,0.2,1],"metallicFactor":0.5})")) ==
        "partial_metals");
    // 0.01 of linear light is 25 of 255 in sRGB, and 1 is 255.
    CHECK(failed("{for: shop}", triangle("", R"({"baseColorFactor":[0.01,0,0,1],"metallicFactor":1})")) ==
          "base_colours");
    CHECK(failed("{for: shop}", triangle("", R"({"metallicFactor":1})")) == "base_colours");
    CHECK(failed("{for: ar}", triangle("", R"({"metallicFactor":1})")) == "pivot");
    CHECK(failed("{for: shop, limits: {longest_side: {min: 5}}}", triangle("", grey)) == "longest_side");
    CHECK(failed("{for: godot, limits: {primitives: 0}}", triangle("", grey)) == "primitives");
}
