#include "support/catch.hpp"
#include "support/gltf.hpp"

using namespace facetmill;

TEST_CASE("a node with several parents is written under the first only", "[gltf]") {
    const std::string text =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
 "nodes":[{"children":[3,3]},{"children":[4,3],"scale":[4,4,4]},{"children":[3]},{"mesh":0},{"mesh":0}],
 "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
 "bufferViews":[{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    io::ReadLog log;
    const Scene scene = test::read_text(text, &log);
    std::size_t named = 0;
    for (const auto& warning : log.warnings) named += warning.id == std::string("W-NODES");
    CHECK(named >= 1);
    REQUIRE(scene.parts.size() == 2);
    CHECK(scene.parts[0].transform.point({1, 0, 0}) == Vec3{1, 0, 0});
    const Json nodes = Json::parse(test::json_of(test::written(scene, "glb").files.at(0).bytes))["nodes"];
    REQUIRE(nodes.size() == 5);
    CHECK(nodes[0]["children"].dump() == "[3]");
    CHECK(nodes[1]["children"].dump() == "[4]");
    CHECK_FALSE(nodes[2].contains("children"));
}
