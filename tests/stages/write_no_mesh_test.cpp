// Documents without meshes: clips of animations, cameras, named places.
#include "support/catch.hpp"

#include "io/gltf/document/container.hpp"
#include "support/bench.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"

#include <cstring>
#include <fstream>
#include <iterator>

namespace write_no_mesh_test {

using namespace facetmill;
using test::failure;
using test::options;

/// Two joints; the second turns by 90 degrees, and a track leaves the first where it is.
Scene clip() {
    const float numbers[] = {0, 1, 0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f, 0, 0, 0, 0, 0, 0};
    io::Bytes binary(sizeof numbers);
    std::memcpy(binary.data(), numbers, sizeof numbers);
    Json json = Json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "hips", "children": [1]},
                  {"name": "spine", "translation": [0, 1, 0], "extras": {"side": "left"}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC4"},
                      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 8}, {"buffer": 0, "byteOffset": 8, "byteLength": 32},
                        {"buffer": 0, "byteOffset": 40, "byteLength": 24}],
        "buffers": [{"byteLength": 64}],
        "animations": [{"name": "walk",
                        "channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}},
                                     {"sampler": 1, "target": {"node": 0, "path": "translation"}}],
                        "samplers": [{"input": 0, "output": 1}, {"input": 0, "output": 2}]}]
    })");
    io::ReadLog log;
    Scene scene = io::read_scene(io::Input::of("clip.glb", io::gltf::join_glb(json.dump(), binary)), {}, log);
    CHECK(log.warnings.empty());
    return scene;
}

Json written_after(test::Bench& b, const Value& given) {
    b.run("write", given);
    b.state.outputs.commit();
    std::ifstream stream(b.dir / "a.glb", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    return Json::parse(test::json_of(test::to_bytes(bytes)));
}

TEST_CASE("a document without meshes is written with its tracks, and optimize drops those at rest",
          "[stages]") {
    for (const auto& given : {options({{"path", "a.glb"}}),
                              options({{"path", "a.glb"}, {"meshopt", "true"}, {"quantize", "true"}}),
                              options({{"path", "a.glb"}, {"draco", "true"}, {"drop_names", "true"}})}) {
        test::Bench b;
        b.scene = clip();
        CHECK(b.scene.parts.empty());
        b.run("optimize", Value::map({}));
        const Json json = written_after(b, given);
        CHECK(json["nodes"][0]["name"] == "hips");
        CHECK(json["nodes"][1]["extras"]["side"] == "left");
        CHECK(json["cameras"].size() == 1);
        REQUIRE(json["animations"].size() == 1);
        REQUIRE(json["animations"][0]["channels"].size() == 1);
        CHECK(json["animations"][0]["channels"][0]["target"] == Json({{"node", 1}, {"path", "rotation"}}));
    }
}

TEST_CASE("a library of materials without scenes and nodes is written", "[stages]") {
    test::Bench b;
    io::ReadLog log;
    b.scene = io::read_scene(io::Input::of("a.gltf", test::to_bytes(std::string(R"({
        "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_xmp_json_ld"],
        "extensions": {"KHR_xmp_json_ld": {"packets": [{"dc:title": "Oak"}]}},
        "materials": [{"name": "oak", "doubleSided": true}]})"))),
                             {}, log);
    const Json json = written_after(b, options({{"path", "a.glb"}}));
    CHECK(json["materials"] == Json::parse(R"([{"name": "oak", "doubleSided": true}])"));
    CHECK(json["extensions"]["KHR_xmp_json_ld"]["packets"][0]["dc:title"] == "Oak");
    CHECK(!json.contains("scenes"));
}

TEST_CASE("formats of meshes refuse a document without meshes, and so does a scene that lost its parts",
          "[stages]") {
    for (const char* name : {"stl", "ply", "obj", "off", "3mf"}) {
        test::Bench b;
        b.scene = clip();
        CHECK(
            failure([&] { b.run("write", Value::scalar(std::string("a.") + name)); }) ==
            fmt::format("stage [E-EMPTY] there is nothing to write to 'a.{0}': the scene has no meshes, and "
                        "{0} stores nothing else | glb, gltf can store nodes, cameras and animations",
                        name));
    }
    test::Bench b;
    CHECK(failure([&] { b.run("write", Value::scalar("a.glb")); }).starts_with("stage [E-EMPTY]"));
}

TEST_CASE("a picture of a document without meshes is blank, with a warning", "[stages]") {
    test::Bench b;
    b.scene = clip();
    b.run("render", Value::scalar("a.png"));
    REQUIRE(b.record.warnings.size() == 1);
    CHECK(b.record.warnings[0].id == "W-BLANK");
}

} // namespace write_no_mesh_test
