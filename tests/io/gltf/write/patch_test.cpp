// Rewriting a glTF document keeps all data that no stage was asked to change.
#include "io/codec.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

using namespace facetmill;
using test::drawn;

namespace {

Scene read_data(const char* name) {
    io::ReadLog log;
    return io::read_scene(io::Input::open(std::string(FACETMILL_SOURCE_DIR "/tests/data/") + name), {}, log);
}

Json written_json(const Scene& scene, const io::WriteSettings& settings = {}) {
    return Json::parse(test::json_of(test::written(scene, "glb", settings).files.at(0).bytes));
}

/// A triangle, with much other data that facetmill does not interpret.
const char* const rich =
    R"({"asset":{"version":"2.0","extras":{"big":9007199254740993,"none":null,"empty":{}}},
 "unknown":[18446744073709551615,-1,{}],"extensionsUsed":["KHR_lights_punctual"],
 "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},
 "scene":0,"scenes":[{"nodes":[0,1]}],
 "nodes":[{"mesh":0,"translation":[1,2,3],"extras":[]},{"name":"lamp","extensions":{"KHR_lights_punctual":{"light":0}}}],
 "meshes":[{"name":"m","extras":{"a":1},"primitives":[{"attributes":{"POSITION":0},"extras":{"b":2}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0],"name":"p"}],
 "bufferViews":[{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

} // namespace

TEST_CASE("an untouched document keeps all but its buffers", "[io]") {
    Json before = Json::parse(rich), after = written_json(test::read_text(rich));
    for (Json* json : {&before, &after}) {
        json->erase("buffers");
        json->erase("bufferViews");
    }
    CHECK(after == before);
}

TEST_CASE("a changed part changes its mesh only", "[io]") {
    Scene scene = test::read_text(rich);
    scene.parts[0].mesh = shapes::cube();
    scene.parts[0].changed = true;
    Json before = Json::parse(rich), after = written_json(scene);
    CHECK(after["meshes"][0]["name"] == "m");
    CHECK(after["meshes"][0]["extras"] == before["meshes"][0]["extras"]);
    CHECK(after["accessors"].size() == 2); // the old positions are removed
    for (Json* json : {&before, &after})
        for (const char* key : {"meshes", "accessors", "bufferViews", "buffers"}) json->erase(key);
    CHECK(after == before);
}

TEST_CASE("what is gone need not be known to be dropped", "[io]") {
    Json document = Json::parse(rich);
    document["accessors"][0]["extensions"]["EXT_of_somebody"] = {{"a", 1}};
    Scene scene = test::read_text(document.dump());
    scene.parts[0].mesh = shapes::cube();
    scene.parts[0].changed = true;
    CHECK(written_json(scene)["accessors"].size() == 2);
}

TEST_CASE("positions without a view are gone with their part", "[io]") {
    Json document = Json::parse(rich);
    document["accessors"][0].erase("bufferView"); // all are zero
    document["accessors"][0]["max"] = {0, 0, 0};
    document.erase("bufferViews");
    document.erase("buffers");
    Scene scene = test::read_text(document.dump());
    scene.parts.clear();
    const Json after = written_json(scene);
    CHECK(after["nodes"][1] == Json::parse(rich)["nodes"][1]);
    CHECK_FALSE(after.contains("accessors"));
    CHECK_FALSE(after.contains("bufferViews"));
}

TEST_CASE("a part that moved gets a matrix, its neighbours keep their words", "[io]") {
    Scene scene = test::read_text(rich);
    CHECK(scene.parts[0].transform.m[2][3] == 3);
    scene.parts[0].transform.m[2][3] = 7;
    const Json after = written_json(scene);
    CHECK_FALSE(after["nodes"][0].contains("translation"));
    CHECK(after["nodes"][0]["matrix"] == Json::parse("[1,0,0,0,0,1,0,0,0,0,1,0,1,2,7,1]"));
    CHECK(after["nodes"][1] == Json::parse(rich)["nodes"][1]);
}

TEST_CASE("an animated node that moved gets a node above it, and plays as before", "[io]") {
    Json document = Json::parse(rich);
    document["animations"] =
        Json::parse(R"([{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
        "samplers":[{"input":0,"output":0}]}])");
    document["nodes"][0]["children"] = {1};
    document["nodes"][1]["translation"] = {0, 0, 5};
    document["scenes"][0]["nodes"] = {0};
    Scene scene = test::read_text(document.dump());
    Transform turn; // a quarter turn about z, twice as large
    turn.m[0][0] = turn.m[1][1] = 0;
    turn.m[0][1] = -2;
    turn.m[1][0] = 2;
    turn.m[2][2] = 2;
    scene.parts[0].transform = turn * scene.parts[0].transform;
    const io::Written written = test::written(scene, "glb");
    CHECK(written.warnings.empty());
    const Json after = Json::parse(test::json_of(written.files.at(0).bytes));
    CHECK(after["nodes"][0]["translation"] == document["nodes"][0]["translation"]);
    CHECK(after["animations"] == document["animations"]);
    CHECK(after["scenes"][0]["nodes"] == Json::array({2}));
    CHECK(after["nodes"][2]["children"] == Json::array({0}));
    CHECK(after["nodes"][2]["matrix"] == Json::parse("[0,2,0,0,-2,0,0,0,0,0,2,0,0,0,0,1]"));
    const Scene again = test::read_bytes(written.files.at(0).bytes, "glb");
    CHECK(again.parts.at(0).transform == scene.parts[0].transform);
}

TEST_CASE("what is split off an animated part moves along", "[io]") {
    Json document = Json::parse(rich);
    document["meshes"][0]["primitives"][0]["targets"] = Json::parse(R"([{"POSITION":0}])");
    document["nodes"][0]["weights"] = {0.5};
    document["animations"] = Json::parse(R"([{"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}],
        "samplers":[{"input":0,"output":0}]}])");
    const auto in_two = [](const Json& given) {
        Scene scene = test::read_text(given.dump());
        scene.parts.push_back(scene.parts[0]);
        scene.parts[1].name = "piece";
        return scene;
    };
    const Json still =
        written_json(in_two(document)); // the animation has weights only, so the piece is independent
    CHECK(still["nodes"][2]["weights"] == document["nodes"][0]["weights"]);
    CHECK(still["nodes"][2].contains("matrix"));
    CHECK(still["scenes"][0]["nodes"] == Json::array({0, 1, 2}));
    CHECK(still["animations"][0]["channels"][1]["target"] == Json{{"node", 2}, {"path", "weights"}});
    document["animations"][0]["channels"][0]["target"]["path"] = "translation";
    Scene scene = in_two(document);
    scene.parts[1].transform.m[0][3] += 5;
    const Json moving = written_json(scene);
    CHECK(moving["nodes"][0]["children"] == Json::array({2}));
    CHECK(moving["nodes"][2]["matrix"] == Json::parse("[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]"));
    CHECK(moving["scenes"][0]["nodes"] == document["scenes"][0]["nodes"]);
    CHECK(moving["animations"][0]["channels"].size() == 1);
}

TEST_CASE("a part that lost its skin moves by its node", "[io]") {
    Json document = Json::parse(rich);
    document["skins"] = Json::parse(R"([{"joints":[1]}])");
    document["nodes"][0]["skin"] = 0;
    Scene scene = test::read_text(document.dump());
    REQUIRE(scene.parts.at(0).skinned);
    CHECK(written_json(scene)["nodes"] == document["nodes"]);
    scene.parts[0].skinned = false;
    scene.parts[0].transform.m[0][3] = 4;
    const Json after = written_json(scene);
    CHECK_FALSE(after["nodes"][0].contains("skin"));
    CHECK(after["nodes"][0]["matrix"] == Json::parse("[1,0,0,0,0,1,0,0,0,0,1,0,4,0,0,1]"));
}

TEST_CASE("morph targets that are gone take the animation of their weights along", "[io]") {
    Json document = Json::parse(rich);
    document["meshes"][0]["primitives"][0]["targets"] = Json::parse(R"([{"POSITION":0}])");
    document["animations"] = Json::parse(R"([{"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}],
        "samplers":[{"input":0,"output":0}]}])");
    Scene scene = test::read_text(document.dump());
    CHECK(written_json(scene)["animations"] == document["animations"]);
    scene.parts[0].mesh = shapes::cube();
    scene.parts[0].changed = true;
    const io::Written written = test::written(scene, "glb");
    CHECK_FALSE(Json::parse(test::json_of(written.files[0].bytes)).contains("animations"));
    REQUIRE(written.warnings.size() == 1);
    CHECK(written.warnings[0].id == "W-MORPH");
}

TEST_CASE("instances share a mesh until they differ", "[io]") {
    Json document = Json::parse(rich);
    document["nodes"].push_back({{"mesh", 0}, {"name", "twin"}});
    document["scenes"][0]["nodes"].push_back(2);
    Scene scene = test::read_text(document.dump());
    REQUIRE(scene.parts.size() == 2);
    CHECK(written_json(scene)["meshes"].size() == 1);
    for (auto& part : scene.parts) {
        part.mesh = shapes::tetrahedron();
        part.changed = true;
    }
    CHECK(written_json(scene)["meshes"].size() == 1);
    scene.parts[1].mesh = shapes::cube();
    const io::Written written = test::written(scene, "glb");
    CHECK(Json::parse(test::json_of(written.files[0].bytes))["meshes"].size() == 2);
    REQUIRE(written.warnings.size() == 1);
    CHECK(written.warnings[0].message ==
          "the instances of meshes[0] differ now: 1 of them has a mesh of its own");
}

TEST_CASE("a part that is gone leaves its node behind", "[io]") {
    Scene scene = test::read_text(rich);
    scene.parts.clear();
    const Json after = written_json(scene);
    CHECK(after["nodes"].size() == 2);
    CHECK_FALSE(after["nodes"][0].contains("mesh"));
    CHECK_FALSE(after.contains("meshes"));
    CHECK_FALSE(after.contains("accessors"));
}

TEST_CASE("embedded textures come along", "[io]") {
    Scene scene = read_data("box-textured.glb");
    scene.parts[0].changed = true;
    const Scene read = test::again(scene);
    CHECK(drawn(read.parts[0].mesh) == drawn(scene.parts[0].mesh));
    const Json before = Json::parse(scene.documents[0]->json), after = Json::parse(read.documents[0]->json);
    CHECK(after["textures"] == before["textures"]);
    CHECK(after["materials"] == before["materials"]);
    const auto image = [](const Scene& s, const Json& json) {
        const Json& view = json["bufferViews"][json["images"][0]["bufferView"].get<std::size_t>()];
        const auto& bytes = s.documents[0]->buffers[0];
        const auto from = bytes.begin() + view.value("byteOffset", 0);
        return io::Bytes(from, from + view["byteLength"].get<int>());
    };
    CHECK(image(read, after) == image(scene, before));
}

TEST_CASE("morph targets survive, plain and beside Draco", "[io]") {
    Scene scene = read_data("morph-cube/AnimatedMorphCube.gltf");
    scene.parts[0].changed = true;
    CHECK(drawn(test::again(scene).parts[0].mesh) == drawn(scene.parts[0].mesh));
    io::WriteSettings settings;
    settings.draco.on = true;
    const Scene read = test::again(scene, settings);
    CHECK(read.parts[0].mesh.find("TARGET_1_POSITION", Domain::wedge));
    CHECK(read.parts[0].mesh.face_count() == 12);
}

TEST_CASE("compressed documents are read", "[io]") {
    for (const char* name : {"box-meshopt.glb", "box-draco.glb", "box-ext-mesh-manifold.glb"}) {
        INFO(name);
        const Scene scene = read_data(name);
        REQUIRE(scene.parts.size() == 1);
        CHECK(scene.parts[0].mesh.face_count() == 12);
        CHECK(scene.parts[0].mesh.vertex_count() == 8);
        CHECK(test::again(scene).parts[0].mesh.vertex_count() == 8);
    }
}

TEST_CASE("a second document brings its textures", "[io]") {
    Scene scene = test::read_text(rich);
    Scene other = read_data("box-textured.glb");
    for (auto& part : other.parts) {
        part.document = 1;
        for (auto& p : part.mesh.primitives) p.material += static_cast<Index>(scene.materials.size());
        scene.parts.push_back(part);
    }
    for (auto& material : other.materials) {
        material.document = 1;
        scene.materials.push_back(material);
    }
    scene.documents.push_back(other.documents[0]);
    const Json after = written_json(scene);
    CHECK(after["meshes"].size() == 2);
    CHECK(after["images"].size() == 1);
    CHECK(after["meshes"][1]["primitives"][0]["material"] == 0);
    CHECK(after["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] == 0);
}

TEST_CASE("the same scene gives the same bytes", "[io]") {
    const Scene scene = read_data("box-textured.glb");
    io::WriteSettings settings;
    for (const bool draco : {false, true}) {
        settings.draco.on = draco;
        CHECK(test::written(scene, "glb", settings).files[0].bytes ==
              test::written(scene, "glb", settings).files[0].bytes);
    }
}

TEST_CASE("levels of detail stand in for their node, wherever it is", "[io]") {
    // The parent is moved and scaled, so a level's position must be computed relative to it.
    Scene scene = test::read_text(
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
 "nodes":[{"name":"root","translation":[1,2,3],"scale":[2,2,2],"children":[1]},{"name":"bust","mesh":0,"translation":[0,0,5]}],
 "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
 "bufferViews":[{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    Part coarse = scene.parts.at(0);
    for (const char* name : {"bust.lod2", "bust.lod1", "bust.lod", "other.lod1"}) {
        coarse.name = name;
        coarse.changed = true;
        scene.parts.push_back(coarse);
    }
    io::WriteSettings settings;
    settings.lods.on = true;
    const Json json = written_json(scene, settings);
    CHECK(json["extensionsUsed"] == Json::parse(R"(["MSFT_lod"])"));
    const Json& ids = json["nodes"][1]["extensions"]["MSFT_lod"]["ids"];
    REQUIRE(ids.size() == 2);
    CHECK(json["nodes"][ids[0].get<std::size_t>()]["name"] == "bust.lod1");
    CHECK(json["nodes"][ids[1].get<std::size_t>()]["name"] == "bust.lod2");
    CHECK(json["nodes"][ids[0].get<std::size_t>()]["matrix"][14] == 5); // under root, as the bust is
    CHECK(json["nodes"][1]["extras"] ==
          Json::parse(R"({"MSFT_screencoverage":[1.0,1.0,0.0],"lod_errors":[0.0,0.0,0.0]})"));
    const Json roots = json["scenes"][0]["nodes"];
    CHECK(roots.size() == 3); // root, and the two that are no levels
    for (const auto& id : ids) CHECK(std::find(roots.begin(), roots.end(), id) == roots.end());
    const Scene again = test::again(scene, settings);
    REQUIRE(again.parts.size() == 5);
    for (const Part& part : again.parts) CHECK(part.transform == scene.parts[0].transform);
    // Rewriting the file keeps the levels. Without levels, a warning is given.
    const Json twice = written_json(again, settings);
    CHECK(twice["nodes"] == json["nodes"]);
    Scene coarser = scene; // levels are no instances that differ
    for (std::size_t i = 1; i < coarser.parts.size(); ++i) coarser.parts[i].mesh.positions[0].x = 0.1;
    coarser.parts.resize(3);
    CHECK(test::written(coarser, "glb", settings).warnings.empty());
    // The corner at the origin moves by 0.01 * 2 along the edge to (1, 0, 0), within the plane. So the old
    // corner is 0.02 / sqrt(1.0001) from the new edge to (0, 1, 0).
    for (std::size_t i = 1; i < coarser.parts.size(); ++i) coarser.parts[i].mesh.positions[0].x = 0.01;
    settings.lods.pixels = 0.2;
    const Json moved = written_json(coarser, settings);
    const Json& extras = moved["nodes"][1]["extras"];
    const double error = 0.02 / std::sqrt(1.0001), radius = std::sqrt(2.0);
    CHECK(extras["lod_errors"][1].get<double>() == Approx(error));
    CHECK(extras["MSFT_screencoverage"][0].get<double>() ==
          Approx(3.14159265358979 * std::pow(radius / error * 0.2, 2) / (1920 * 1080)));
    Scene alone = scene;
    alone.parts.resize(1);
    CHECK(test::written(alone, "glb", settings).warnings.at(0).id == "W-LODS");
}
