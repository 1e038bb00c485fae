#include "io/gltf/document/shorten.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

namespace shorten_test {

using namespace facetmill;

Json shortened(const char* text, const Box& bounds) {
    Json json = Json::parse(text);
    io::gltf::shorten(json, bounds);
    return json;
}

const Box unit{{0, 0, 0}, {1, 1, 1}};

TEST_CASE("a matrix that only moves and scales is told as that", "[io]") {
    const Json json = shortened(
        R"({"nodes":[{"matrix":[2,0,0,0, 0,-2,0,0, 0,0,2,0, 1,0.5,0,1]},
                     {"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]},
                     {"matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 0,0,0,1]},
                     {"translation":[0,0,0],"rotation":[0,0,0,1],"scale":[1,1,1]}]})",
        unit);
    CHECK(json["nodes"][0].dump() == R"({"translation":[1,0.5,0],"scale":[2,-2,2]})");
    CHECK(json["nodes"][1].empty());
    CHECK(json["nodes"][2].contains("matrix"));
    CHECK(json["nodes"][3].empty());
}

TEST_CASE("nodes that animations move keep what is animated", "[io]") {
    const char* animation = R"("animations":[{"samplers":[{"input":0,"output":1}],"channels":[
        {"sampler":0,"target":{"node":0,"path":"scale"}}]}],"nodes":[{"scale":[1,1,1]}]})";
    CHECK(shortened((std::string("{") + animation).c_str(), unit)["nodes"][0].contains("scale"));
    const std::string pointer = std::string(R"({"extensionsUsed":["KHR_animation_pointer"],)") + animation;
    CHECK(shortened(pointer.c_str(), unit)["nodes"][0].contains("scale"));
}

TEST_CASE("numbers of nodes keep the digits that a scene of its size needs", "[io]") {
    const char* near = R"({"nodes":[{"translation":[0.123456789012345,0,0],"rotation":[0,0,0.7071067811865475,
        0.7071067811865476]}]})";
    const Json short_ones = shortened(near, unit);
    CHECK(short_ones["nodes"][0]["translation"][0].dump().size() < 13);
    CHECK(std::abs(short_ones["nodes"][0]["translation"][0].get<double>() - 0.123456789012345) < 2e-8);
    CHECK(std::abs(short_ones["nodes"][0]["rotation"][2].get<double>() - 0.7071067811865475) < 2e-8);

    // Two translations that cancel, and a node that is turned far away from where it ends up.
    const char* far = R"({"nodes":[{"translation":[6378137.123456789,0,0],"children":[1]},
        {"rotation":[0,0,0.0000123456789012345,0.99999999992379],"translation":[-6378137.023456781,0,0]}]})";
    const Json far_ones = shortened(far, unit);
    const auto x = [&](std::size_t n) { return far_ones["nodes"][n]["translation"][0].get<double>(); };
    CHECK(std::abs(x(0) + x(1) - 0.100000008) < 5e-8);
    CHECK(std::abs(far_ones["nodes"][1]["rotation"][2].get<double>() - 0.0000123456789012345) * 6e6 < 5e-8);

    // Nothing is known of a scene without a size.
    CHECK(shortened(near, Box{})["nodes"][0]["translation"][0] == 0.123456789012345);
}

TEST_CASE("offsets of nothing go, and factors are float32's", "[io]") {
    const Json json = shortened(
        R"({"bufferViews":[{"buffer":1,"byteOffset":0,"byteLength":4,"extensions":
              {"EXT_meshopt_compression":{"byteOffset":0},"OTHER":{"byteOffset":0}}},{"byteOffset":4}],
            "accessors":[{"byteOffset":0}],
            "materials":[{"alphaCutoff":0.30000001192092896,"extras":{"own":0.30000001192092896}}]})",
        unit);
    CHECK(
        json["bufferViews"][0].dump() ==
        R"({"buffer":1,"byteLength":4,"extensions":{"EXT_meshopt_compression":{},"OTHER":{"byteOffset":0}}})");
    CHECK(json["bufferViews"][1]["byteOffset"] == 4);
    CHECK(json["accessors"][0].empty());
    CHECK(json["materials"][0]["alphaCutoff"] == 0.3);
    CHECK(json["materials"][0]["extras"]["own"] == 0.30000001192092896);
}

TEST_CASE("names go on request, not those that something is looked up by", "[io]") {
    Json json = Json::parse(
        R"({"asset":{"version":"2.0","generator":"x"},"nodes":[{"name":"a","mesh":0}],"meshes":[{"name":"b"}],
        "materials":[{"name":"c"}],"animations":[{"name":"d"}],"scenes":[{"name":"e"}],"cameras":[{"name":"f"}]})");
    io::gltf::drop_names(json);
    CHECK(json["nodes"][0].dump() == R"({"mesh":0})");
    CHECK(json["meshes"][0].empty());
    CHECK(json["asset"].dump() == R"({"version":"2.0"})");
    for (const char* list : {"materials", "animations", "scenes", "cameras"})
        CHECK(json[list][0].contains("name"));

    // Joints, and nodes with other contents, lose their names. A node without contents is found by its name.
    Json places = Json::parse(R"({"nodes":[{"name":"seat","translation":[1,2,3]},{"name":"bone"},
        {"name":"group","children":[0]}],"skins":[{"joints":[1]}]})");
    io::gltf::drop_names(places);
    CHECK(places["nodes"][0]["name"] == "seat");
    CHECK(!places["nodes"][1].contains("name"));
    CHECK(!places["nodes"][2].contains("name"));

    const Scene scene = test::scene_in_metres(shapes::cube(), "thing");
    io::WriteSettings settings;
    CHECK(test::json_of(test::written(scene, "glb", settings).files[0].bytes).find("thing") !=
          std::string::npos);
    settings.drop_names = true;
    CHECK(test::json_of(test::written(scene, "glb", settings).files[0].bytes).find("thing") ==
          std::string::npos);
}

TEST_CASE("default members of materials go", "[io]") {
    Json json = Json::parse(
        R"({"extensions":{},"samplers":[{"wrapS":10497,"wrapT":33071}],"materials":[{"name":"a",
        "pbrMetallicRoughness":{"baseColorFactor":[1.0,1.0,1.0,1.0],"metallicFactor":0,"roughnessFactor":1.0},
        "emissiveFactor":[0,0,0],"alphaMode":"OPAQUE","doubleSided":false},
        {"pbrMetallicRoughness":{"metallicFactor":1},"alphaMode":"MASK","alphaCutoff":0.25,
        "normalTexture":{"index":0,"texCoord":0,"scale":1,"extensions":{"KHR_texture_transform":
        {"offset":[0,0],"rotation":0.5,"scale":[1,1],"texCoord":0}}},"extras":{"alphaMode":"OPAQUE"}}]})");
    io::gltf::shorten(json, {});
    CHECK_FALSE(json.contains("extensions"));
    CHECK(json["samplers"][0].dump() == R"({"wrapT":33071})");
    CHECK(json["materials"][0].dump() == R"({"name":"a","pbrMetallicRoughness":{"metallicFactor":0}})");
    CHECK(json["materials"][1].dump() ==
          R"({"alphaMode":"MASK","alphaCutoff":0.25,"normalTexture":{"index":0,"extensions":)"
          R"({"KHR_texture_transform":{"rotation":0.5,"texCoord":0}}},"extras":{"alphaMode":"OPAQUE"}})");
}

} // namespace shorten_test
