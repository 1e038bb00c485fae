// Geometry that several meshes share is stored once, under every encoding.
#include "support/catch.hpp"

#include "base/json.hpp"
#include "mesh/shapes.hpp"
#include "support/bench.hpp"
#include "support/gltf.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace builder_test {

using namespace facetmill;

/// Balls of different materials, apart from each other.
Scene balls(std::size_t count) {
    Scene scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::y;
    for (std::size_t i = 0; i < count; ++i) {
        Material material;
        material.name = fmt::format("m{}", i);
        material.base_colour[0] = static_cast<double>(i) / static_cast<double>(count);
        scene.materials.push_back(material);
        Part& part = scene.parts.emplace_back();
        part.name = fmt::format("ball{}", i);
        part.mesh = shapes::icosphere(3);
        part.mesh.primitives.resize(1);
        part.mesh.primitives[0].material = static_cast<Index>(i);
        part.transform.m[0][3] = 2.3 * static_cast<double>(i);
    }
    return scene;
}

struct File {
    std::uintmax_t bytes = 0;
    Json json;
};

File written(Scene scene, const Value& given) {
    test::Bench b;
    b.scene = std::move(scene);
    b.run("write", given);
    b.state.outputs.commit();
    std::ifstream stream(b.dir / "a.glb", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    return {bytes.size(), Json::parse(test::json_of(test::to_bytes(bytes)))};
}

TEST_CASE("balls of different materials share their geometry under every encoding", "[gltf]") {
    using test::options;
    const Value encodings[] = {options({{"path", "a.glb"}}), options({{"path", "a.glb"}, {"draco", "true"}}),
                               options({{"path", "a.glb"}, {"quantize", "true"}}),
                               options({{"path", "a.glb"}, {"meshopt", "true"}}),
                               options({{"path", "a.glb"}, {"meshopt", "true"}, {"quantize", "false"}})};
    for (const Value& given : encodings) {
        const File one = written(balls(2), given), many = written(balls(12), given);
        INFO(one.bytes << " " << many.bytes);
        CHECK(many.json["meshes"].size() == 12);
        CHECK(many.json["accessors"].size() == one.json["accessors"].size());
        CHECK(many.json["bufferViews"].size() == one.json["bufferViews"].size());
        CHECK(many.bytes < one.bytes + 10 * 500); // only JSON: a mesh, a node and a material
    }
}

TEST_CASE("morph displacements of zero take no bytes", "[gltf]") {
    Mesh mesh = shapes::icosphere(3);
    std::vector<float> moves(3 * mesh.vertex_count(), 0.25F), zeros(3 * mesh.vertex_count(), 0.0F);
    std::vector<float> outward; // the normals of a unit sphere
    outward.reserve(moves.size());
    for (const Vec3& p : mesh.positions)
        for (std::size_t c = 0; c < 3; ++c) outward.push_back(static_cast<float>(p[c]));
    mesh.attributes.push_back({"NORMAL", Domain::vertex, Role::normal, 3, false, outward});
    mesh.attributes.push_back({"TARGET_0_POSITION", Domain::vertex, Role::morph_vector, 3, false, moves});
    mesh.attributes.push_back({"TARGET_0_NORMAL", Domain::vertex, Role::morph_vector, 3, false, zeros});
    const Scene scene = test::scene_in_metres(mesh);
    const io::Bytes bytes = test::written(scene, "glb").files.at(0).bytes;
    const Json json = Json::parse(test::json_of(bytes));
    const Json& target = json["meshes"][0]["primitives"][0]["targets"][0];
    CHECK(json["accessors"][target["POSITION"].get<std::size_t>()].contains("bufferView"));
    CHECK(!json["accessors"][target["NORMAL"].get<std::size_t>()].contains("bufferView"));
    const Scene again = test::read_bytes(bytes, "glb");
    const Attribute* normals = again.parts.at(0).mesh.find("TARGET_0_NORMAL", Domain::wedge);
    REQUIRE(normals);
    CHECK(normals->value(0, 0) == 0);
}

/// A triangle, and an accessor that nothing uses, with an extension in the document.
Json with_extension(const char* name, const char* content) {
    Json json = Json::parse(R"({
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 1, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteLength": 4}],
        "buffers": [{"byteLength": 36,
                     "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
    })");
    json["extensionsUsed"] = Json::array({name});
    json["nodes"][0]["extensions"][name] = Json::parse(content);
    return json;
}

TEST_CASE("extensions that name nothing do not keep what is unused", "[gltf]") {
    const auto accessors_after = [](const char* name, const char* content) {
        test::Bench b;
        b.scene = test::read_text(with_extension(name, content).dump());
        b.run("optimize", Value::map({}));
        const Json json = Json::parse(test::json_of(test::written(b.scene, "glb").files.at(0).bytes));
        return json["accessors"].size();
    };
    CHECK(accessors_after("ACME_marker", "{}") == 1);
    CHECK(accessors_after("ACME_marker", R"({"kind": "door", "open": true, "width": 0.5})") == 1);
    CHECK(accessors_after("KHR_interactivity", R"({"graphs": [{"nodes": [{"declaration": 0}]}]})") == 1);
    CHECK(accessors_after("ACME_data", R"({"values": 1})") == 2);
    CHECK(accessors_after("ACME_data", R"({"values": "/accessors/1"})") == 2);
}

} // namespace builder_test
