// Nodes without meshes, and animations, move along with the scene. CESIUM_RTC is a place of the whole file.
#include "io/gltf/document/container.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include <cstring>

namespace moved_nodes_test {

using namespace facetmill;

namespace {

/// A document with a cube whose JSON has been changed.
Scene cube_with(const std::function<void(Json&)>& change) {
    const io::Written cube = test::written(test::scene_in_metres(shapes::cube(), "cube"), "glb");
    const io::Bytes& bytes = cube.files.at(0).bytes;
    Json json = Json::parse(test::json_of(bytes));
    change(json);
    const std::size_t length = json["buffers"][0]["byteLength"].get<std::size_t>();
    const io::Bytes binary(bytes.end() - static_cast<std::ptrdiff_t>((length + 3) / 4 * 4), bytes.end());
    io::ReadLog log;
    return io::read_scene(io::Input::of("a.glb", io::gltf::join_glb(json.dump(), binary)), {}, log);
}

/// The places of the nodes in a file of the scene, by name. at: a node's translation when an animation ends.
std::map<std::string, Vec3> places(const Scene& scene, const std::map<std::string, Vec3>& at = {}) {
    Json json = Json::parse(test::json_of(test::written(scene, "glb").files.at(0).bytes));
    for (Json& node : json["nodes"])
        if (const auto end = at.find(node.value("name", "")); end != at.end())
            node["translation"] = {end->second.x, end->second.y, end->second.z};
    const auto frames = io::gltf::node_frames(json);
    std::map<std::string, Vec3> all;
    for (std::size_t n = 0; n < frames.size(); ++n)
        if (json["nodes"][n].contains("name"))
            all[json["nodes"][n]["name"].get<std::string>()] = frames[n].world.point({});
    return all;
}

void check_near(const Vec3& a, const Vec3& b) {
    for (std::size_t i = 0; i < 3; ++i) CHECK(a[i] == Approx(b[i]).margin(1e-12));
}

/// Adds an animation of the nodes' translations, with the accessors of the mesh for its numbers.
void animate(Json& json, const std::vector<int>& nodes) {
    Json channels = Json::array();
    for (const int n : nodes)
        channels.push_back({{"sampler", 0}, {"target", {{"node", n}, {"path", "translation"}}}});
    json["accessors"].push_back(
        {{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}, {"min", {0}}, {"max", {0}}});
    json["accessors"].push_back({{"componentType", 5126}, {"count", 1}, {"type", "VEC3"}});
    const std::size_t last = json["accessors"].size() - 1;
    json["animations"] = {{{"channels", channels}, {"samplers", {{{"input", last - 1}, {"output", last}}}}}};
}

} // namespace

TEST_CASE("named places move along with the scene", "[io]") {
    const auto scene = [] {
        return cube_with([](Json& json) { // seat below a group, hand below the cube
            json["nodes"].push_back({{"name", "seat"}, {"translation", {1, 2, 3}}});
            json["nodes"].push_back({{"name", "group"}, {"translation", {5, 0, 0}}, {"children", {1}}});
            json["nodes"].push_back({{"name", "hand"}, {"translation", {0, 1, 0}}});
            json["nodes"][0]["children"] = {3};
            json["scenes"][0]["nodes"] = {0, 2};
        });
    };
    for (const char* options : {"{scale: 2}", "{scale: 2, bake: true}"}) {
        auto at = places(test::run_stage("transform", options, scene()).scene);
        check_near(at["seat"], {12, 4, 6});
        check_near(at["hand"], {0, 2, 0});
    }
    auto turned = places(test::run_stage("transform", "{rotate: 90, translate: [0, 0, 7]}", scene()).scene);
    check_near(turned["seat"], {-2, 6, 10});
    check_near(turned["hand"], {-1, 0, 7});
}

TEST_CASE("animations play around the place to which a scene has moved", "[io]") {
    const auto scene = [] {
        return cube_with([](Json& json) {
            json["nodes"].push_back({{"name", "root"}, {"children", {0, 2}}});
            json["nodes"].push_back({{"name", "seat"}, {"translation", {0, 1, 0}}});
            json["nodes"].push_back({{"name", "view"}, {"camera", 0}});
            json["nodes"][0]["translation"] = {1, 0, 0};
            json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
            json["scenes"][0]["nodes"] = {1, 3};
            animate(json, {1, 3});
        });
    };
    const std::map<std::string, Vec3> end{{"root", {0, 3, 0}}, {"view", {0, 3, 0}}};
    const auto scaled = test::run_stage("transform", "{scale: 2}", scene());
    CHECK(scaled.record.warnings.empty());
    auto at = places(scaled.scene, end);
    check_near(at["cube"], {2, 6, 0});
    check_near(at["seat"], {0, 8, 0});
    check_near(at["view"], {0, 6, 0});
    at = places(test::run_stage("transform", "{translate: [0, 0, 7]}", scene()).scene, end);
    check_near(at["cube"], {1, 3, 7});
    check_near(at["seat"], {0, 4, 7});
}

TEST_CASE("cameras move although a pointer animates one of their lengths, which is named", "[io]") {
    const auto scene = [](const char* pointer) {
        return cube_with([&](Json& json) {
            json["nodes"].push_back({{"name", "view"}, {"translation", {1, 2, 3}}, {"camera", 0}});
            json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
            json["scenes"][0]["nodes"] = {0, 1};
            json["extensionsUsed"] = {"KHR_animation_pointer"};
            animate(json, {0});
            Json& target = json["animations"][0]["channels"][0]["target"];
            target = {{"path", "pointer"},
                      {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
        });
    };
    constexpr const char* near = "/cameras/0/perspective/znear";
    const auto moved = test::run_stage("transform", "{translate: [0, 0, 7]}", scene(near));
    CHECK(moved.record.warnings.empty());
    auto at = places(moved.scene);
    check_near(at["view"], {1, 2, 10});
    const auto scaled = test::run_stage("transform", "{scale: 2}", scene(near));
    REQUIRE(scaled.record.warnings.size() == 1);
    CHECK(scaled.record.warnings[0].id == "W-TRANSFORM");
    at = places(scaled.scene);
    check_near(at["view"], {2, 4, 6});
    CHECK(test::run_stage("transform", "{scale: 2}", scene("/materials/0/alphaCutoff"))
              .record.warnings.empty());
}

TEST_CASE("the centre of CESIUM_RTC moves the whole file", "[io]") {
    const Scene scene = cube_with([](Json& json) {
        json["extensions"]["CESIUM_RTC"]["center"] = {100, 200, 300}; // with z up
        json["extensionsUsed"] = {"CESIUM_RTC"};
        json["extensionsRequired"] = {"CESIUM_RTC"};
    });
    CHECK(scene.bounds().min == Vec3{100, 300, -200});
    CHECK(test::json_of(test::written(scene, "glb").files.at(0).bytes).find("CESIUM_RTC") ==
          std::string::npos);
}

} // namespace moved_nodes_test
