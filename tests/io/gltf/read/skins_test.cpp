// Skinned parts that are moved, scaled and turned, with their skeletons.
#include "io/convert.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/read/skinned_pose.hpp"
#include "io/read_back.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;

namespace {

/// A triangle on the joint "hip" and its child "knee", which an animation moves, and a separate part.
const char* const leg = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,3]}],
 "nodes":[{"name":"leg","mesh":0,"skin":0},{"name":"hip","children":[2]},{"name":"knee","translation":[0,1,0]},
 {"name":"box","mesh":1,"translation":[5,0,0]}],
 "skins":[{"joints":[1,2],"inverseBindMatrices":3}],
 "animations":[{"channels":[{"sampler":0,"target":{"node":2,"path":"translation"}}],
 "samplers":[{"input":4,"output":0}]}],
 "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]},
 {"primitives":[{"attributes":{"POSITION":0}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,0]},
 {"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},{"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"},
 {"bufferView":3,"componentType":5126,"count":2,"type":"MAT4"},
 {"bufferView":2,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[1]}],
 "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},
 {"buffer":0,"byteOffset":48,"byteLength":48},{"buffer":0,"byteOffset":96,"byteLength":128}],
 "buffers":[{"byteLength":224,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAAAAEAAAABAAAAAQAAAACAPwAAAAAAAAAAAAAAAAAAAD8AAAA/AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIC/AAAAAAAAgD8="}]})";

/// The vertices of part 0 as its skeleton has them, the knee moved by the animation or not.
std::vector<Vec3> posed(const Scene& scene, const std::vector<double>& knee) {
    Json json = Json::parse(scene.documents.at(0)->json);
    json["nodes"][2]["translation"] = knee;
    io::gltf::Source source(json, scene.documents[0]->buffers);
    const auto frames = io::gltf::node_frames(json);
    const auto skin = io::gltf::item(json, "skins", 0);
    const auto numbers = std::get<std::vector<float>>(
        io::gltf::decode(source, io::gltf::accessor(source, skin.at("inverseBindMatrices"))));
    const Part& part = scene.parts.at(0);
    const Attribute* joints = part.mesh.find("JOINTS_0", Domain::wedge);
    const Attribute* weights = part.mesh.find("WEIGHTS_0", Domain::wedge);
    std::vector<Vec3> all;
    for (Index v = 0; v < part.mesh.vertex_count(); ++v) {
        Vec3 sum;
        for (int k = 0; k < 4; ++k) {
            const auto j = static_cast<std::size_t>(joints->value(v, k));
            Transform bind;
            for (std::size_t i = 0; i < 12; ++i) bind.m[i % 3][i / 3] = numbers[16 * j + 4 * (i / 3) + i % 3];
            const auto node = skin.at("joints").at(j).natural();
            sum += (frames[node].world * bind).point(part.mesh.positions[v]) * weights->value(v, k);
        }
        all.push_back(sum);
    }
    return all;
}

void check_same(const std::vector<Vec3>& found, const std::vector<Vec3>& wanted) {
    REQUIRE(found.size() == wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        CHECK(length(found[i] - wanted[i]) < 1e-5 * (1 + length(wanted[i])));
}

} // namespace

TEST_CASE("that places are in a bind pose that is not what is shown is told", "[stages]") {
    Json json = Json::parse(leg);
    const auto told = [&](const char* stage, const char* options) {
        const auto ids = test::run_stage(stage, options, test::read_text(json.dump())).warnings();
        return std::count(ids.begin(), ids.end(), "W-BIND-POSE");
    };
    const std::pair<const char*, const char*> stages[] = {
        {"clip", "y=0.5"},
        {"crop", "{footprint: [[-1, -1], [2, -1], [2, 1]], axis: z}"},
        {"tile", "0.7"},
        {"section", "y=0.5"},
        {"probe", "[0, 0, 1]"}};
    for (const auto& [stage, options] : stages)
        CHECK(told(stage, options) == 0); // the joints are in this pose
    CHECK(told("clean", "{}") == 0);
    json["nodes"][1]["rotation"] = {0.5, 0.5, 0.5, 0.5}; // the y axis appears along z
    for (const auto& [stage, options] : stages) {
        INFO(stage);
        CHECK(told(stage, options) == 1);
    }
    CHECK(told("clean", "{}") == 0);
}

TEST_CASE("a skinned part that is moved plays as before, where it is now", "[io]") {
    const Scene scene = test::read_text(leg);
    REQUIRE(scene.parts.at(0).skinned);
    for (const char* options : {"{scale: 2}", "{scale: [1, 2, -3]}", "{translate: [1, 2, 3]}", "{up: z}",
                                "{unit: cm}", "{rotate: {axis: [1, 1, 0], angle: 40deg}, scale: 0.5}"}) {
        INFO(options);
        const auto run = test::run_stage("transform", options, scene);
        CHECK(run.record.warnings.empty());
        const Part& part = run.scene.parts.at(0);
        CHECK(part.skinned);
        io::WriteSettings settings;
        settings.order = io::TriangleOrder::keep; // vertices are compared by their numbers
        const io::Written written = test::written(run.scene, "glb", settings);
        CHECK(written.warnings.empty());
        const Scene again = test::read_bytes(written.files.at(0).bytes, "glb");
        CHECK(again.parts.at(0).skinned);
        for (const auto& knee : {std::vector<double>{0, 1, 0}, std::vector<double>{0.5, 2, 1}}) {
            std::vector<Vec3> wanted = posed(scene, knee);
            for (Vec3& p : wanted) p = part.transform.point(p);
            check_same(posed(again, knee), wanted);
        }
        // The bind pose and the part next to it are also in the right position.
        io::read_back(io::Input::of("a.glb", written.files[0].bytes), *io::codec_named("glb"), run.scene, {});
        CHECK(length(again.parts.at(1).transform.point({}) - run.scene.parts[1].transform.point({})) < 1e-6);
        const Json json = Json::parse(again.documents[0]->json);
        CHECK(json["nodes"][2] == Json::parse(leg)["nodes"][2]); // joints and animations are as they were
        CHECK(json["animations"][0]["channels"] == Json::parse(leg)["animations"][0]["channels"]);
    }
}

TEST_CASE("pictures show skinned parts as the nodes place their joints", "[io]") {
    Json json = Json::parse(leg);
    json["nodes"][2]["translation"] = {3, 1, 0};
    json["nodes"][2]["rotation"] = {0, 0, 0.6, 0.8};
    const Scene scene = test::read_text(json.dump());
    const auto seen = io::posed(scene);
    REQUIRE(seen);
    check_same(seen->parts.at(0).mesh.positions, posed(scene, {3, 1, 0}));
    CHECK(seen->parts[0].mesh.positions[2] != scene.parts[0].mesh.positions[2]);
    CHECK(seen->parts.at(1).mesh.positions == scene.parts.at(1).mesh.positions);
    // An invalid joint and invalid matrices: drawn without skinning.
    for (const char* member : {"joints", "inverseBindMatrices"}) {
        Scene broken = scene;
        json["skins"][0][member] = member[0] == 'j' ? Json{1, 99} : Json(0);
        Document document = *scene.documents.at(0);
        document.json = json.dump();
        broken.documents[0] = std::make_shared<const Document>(std::move(document));
        CHECK_FALSE(io::posed(broken));
        json = Json::parse(scene.documents.at(0)->json);
    }
}

TEST_CASE("a skinned part in another unit is written as it was", "[io]") {
    Scene scene = test::read_text(leg);
    const Scene before = scene;
    scene.unit = Unit::cm; // as load: {unit: cm} has it
    io::convert(scene, {Unit::m, UpAxis::y});
    const Scene again = test::again(scene);
    CHECK(again.parts.at(0).skinned);
    std::vector<Vec3> wanted = posed(before, {0, 1, 0});
    for (Vec3& p : wanted) p = p * 0.01;
    check_same(posed(again, {0, 1, 0}), wanted);
}

TEST_CASE("parts of one skeleton that go different ways cannot all keep it", "[io]") {
    Json json = Json::parse(leg);
    json["nodes"][3]["skin"] = 0;
    json["nodes"][3]["mesh"] = 0;
    Scene scene = test::read_text(json.dump());
    REQUIRE((scene.parts.at(0).skinned && scene.parts.at(1).skinned));
    scene.parts[1].transform.m[0][3] = 4;
    const io::Written written = test::written(scene, "glb");
    CHECK(std::count_if(written.warnings.begin(), written.warnings.end(),
                        [](const Diagnostic& w) { return w.id == "W-SKIN"; }) == 1);
    const Scene again = test::read_bytes(written.files.at(0).bytes, "glb");
    CHECK(again.parts.at(0).skinned);
    CHECK_FALSE(again.parts.at(1).skinned);
    CHECK(again.parts.at(1).mesh.bounds().min.x == 4);
}
