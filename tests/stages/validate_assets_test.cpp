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

TEST_CASE("validate: one moved node at the top of the scene fails, several do not", "[stages][validate]") {
    Scene scene = triangle("", grey);
    scene.parts.front().document = scene.parts.front().node = -1;
    scene.parts.front().transform.m[2][3] = 1;
    CHECK(failed("{for: unity}", scene) == "moved_roots");
    scene.parts.push_back(scene.parts.front());
    CHECK(failed("{for: unity}", scene).empty());
}

TEST_CASE("validate: texture coordinates overlap within a material, beyond rounding", "[stages][validate]") {
    Scene scene = test::scene_in_metres(shapes::grid(1, 1));
    Mesh& mesh = scene.parts.front().mesh;
    // Two triangles of a square, of which the second reaches into the first by the depth.
    const auto put = [&](double depth) {
        const std::array<std::array<double, 2>, 6> uvs{
            {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0.5 - depth, 0}, {1, 0}, {0.5 - depth, 0.5}}};
        mesh = {};
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}};
        mesh.corners = {0, 1, 2, 3, 4, 5};
        Attribute uv{"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::vector<double>(12)};
        for (std::size_t w = 0; w < 6; ++w)
            for (std::size_t k = 0; k < 2; ++k) uv.set_value(w, static_cast<int>(k), uvs[w][k]);
        mesh.attributes = {uv};
    };
    put(1e-8);
    CHECK(failed("{uv_overlaps: 0}", scene).empty());
    put(1e-5);
    CHECK(failed("{uv_overlaps: 0}", scene) == "uv_overlaps");
    scene.materials.resize(2);
    mesh.primitives.resize(2);
    mesh.primitives[0].material = 0;
    mesh.primitives[1].material = 1;
    mesh.attributes.push_back({std::string(primitive_attribute), Domain::face, Role::index, 1, false,
                               std::vector<std::uint32_t>{0, 1}});
    CHECK(failed("{uv_overlaps: 0}", scene).empty()); // each material has its own texture
}

TEST_CASE("validate: a shop refuses mirrored texture coordinates", "[stages][validate]") {
    Scene scene = triangle("", grey);
    scene.parts.front().mesh.attributes.push_back(
        {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::vector<float>{0, 0, 1, 0, 0, 1}});
    CHECK(failed("{for: shop}", scene) == "mirrored_uvs");
    std::get<std::vector<float>>(scene.parts.front().mesh.attributes.back().data) = {0, 1, 1, 1, 0, 0};
    CHECK(failed("{for: shop}", scene).empty());
}
