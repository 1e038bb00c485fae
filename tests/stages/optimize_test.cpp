#include "support/bench.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"
#include "support/run_stage.hpp"

#include "geometry/render/srgb.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/images/pixels.hpp"
#include "io/images/png.hpp"
#include "mesh/separate_wedges.hpp"
#include "mesh/shapes.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

const char* const buffer =
    R"("buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}])";

/// A document with these nodes, meshes and other members.
std::string document_text(const std::string& nodes, const std::string& meshes, const std::string& more = "") {
    const Json list = Json::parse("[" + nodes + "]");
    std::set<std::size_t> children;
    for (const Json& node : list)
        for (const Json& child : node.value("children", Json::array()))
            children.insert(child.get<std::size_t>());
    Json roots = Json::array();
    for (std::size_t n = 0; n < list.size(); ++n)
        if (!children.contains(n)) roots.push_back(n);
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":{}}}],"nodes":[{}],"meshes":[{}],{}{}}})",
        roots.dump(), nodes, meshes, buffer, more.empty() ? "" : "," + more);
}

Scene document(const std::string& nodes, const std::string& meshes, const std::string& more = "") {
    return read_text(document_text(nodes, meshes, more));
}

std::string mesh(int material, int accessor = 0, const std::string& more = "") {
    return fmt::format(
        R"({{"primitives":[{{"attributes":{{"POSITION":{},"TEXCOORD_0":1}},"material":{}}}]{}}})", accessor,
        material, more);
}

std::string colour(const std::string& name, double red) {
    return fmt::format(R"({{"name":"{}","pbrMetallicRoughness":{{"baseColorFactor":[{},0,0,1]}}}})", name,
                       red);
}

/// A wedge for each corner.
void separate_corners(Mesh& mesh) {
    std::vector<Index> own(mesh.corners.size());
    for (Index c = 0; c < own.size(); ++c) own[c] = c;
    separate_wedges(mesh, own);
}

/// The drawn geometry in world space.
std::vector<std::vector<float>> drawn_in_world(Scene scene) {
    std::vector<std::vector<float>> all;
    for (Part& part : scene.parts) {
        apply(part.mesh, part.transform);
        for (auto& face : drawn(part.mesh)) all.push_back(face);
    }
    std::sort(all.begin(), all.end());
    return all;
}

Json json_again(const Scene& scene) { return Json::parse(again(scene).documents.at(0)->json); }

} // namespace

TEST_CASE("optimize joins parts of equal materials, and what is seen stays", "[stages]") {
    const Scene scene = document(
        R"({"mesh":0,"name":"a"},{"mesh":1,"name":"b","translation":[5,0,0]},{"name":"group","children":[3],"scale":[2,2,2]},
{"mesh":2,"name":"c","rotation":[0,0,1,0]})",
        mesh(0) + "," + mesh(1, 2) + "," + mesh(2, 2),
        R"("materials":[)" + colour("red", 1) + "," + colour("rot", 1) + "," + colour("dark", 0.1) + "]");
    // Else the first two would share one mesh.
    Scene own = scene;
    own.parts[1].mesh.positions[0].z = 0.5;
    own.parts[1].changed = true;
    const auto run = run_stage("optimize", "{}", own);
    CHECK(run.warnings().empty());
    REQUIRE(run.scene.parts.size() == 2);
    CHECK(run.record.result["draw_calls_before"] == 3);
    CHECK(run.record.result["draw_calls_after"] == 2);
    CHECK(run.record.result["equal_materials"] == 1);
    CHECK(run.record.result["joined"] == Json::array({"a"}));
    CHECK(run.record.result["erased"]["nodes"] == 1);
    CHECK(run.record.result["erased"]["materials"] == 1);
    CHECK(drawn_in_world(run.scene) == drawn_in_world(own));
    CHECK(drawn_in_world(again(run.scene)) == drawn_in_world(own));
    const Json json = json_again(run.scene);
    CHECK(json["meshes"].size() == 2);
    CHECK(json["materials"].size() == 2);
    CHECK(json["nodes"].size() == 3);
}

TEST_CASE("parts that share some materials become one, with a primitive for each material", "[stages]") {
    const auto two = [](int one, int other) {
        const std::string primitive = R"({{"attributes":{{"POSITION":{},"TEXCOORD_0":1}},"material":{}}})";
        return R"({"primitives":[)" + fmt::format(fmt::runtime(primitive), 0, one) + "," +
               fmt::format(fmt::runtime(primitive), 2, other) + "]}";
    };
    const Scene scene = document(
        R"({"mesh":0,"name":"a"},{"mesh":1,"translation":[5,0,0]},{"mesh":2,"translation":[9,0,0]},
{"mesh":3,"translation":[0,5,0]})",
        two(0, 1) + "," + two(1, 2) + "," + mesh(3) + "," + mesh(2, 2),
        R"("materials":[)" + colour("a", 1) + "," + colour("b", 0.5) + "," + colour("c", 0.25) + "," +
            colour("d", 0.1) + "]");
    const auto run = run_stage("optimize", "{}", scene);
    REQUIRE(run.scene.parts.size() == 2); // the third has a material of its own
    CHECK(run.record.result["draw_calls_before"] == 6);
    CHECK(run.record.result["draw_calls_after"] == 4);
    CHECK(drawn_in_world(again(run.scene)) == drawn_in_world(scene));
}

TEST_CASE("parts that share one of several materials are joined, others are not", "[stages]") {
    const auto primitive = [](int material, int position) {
        return fmt::format(R"({{"attributes":{{"POSITION":{},"TEXCOORD_0":1}},"material":{}}})", position,
                           material);
    };
    const auto of = [](const std::string& primitives) { return R"({"primitives":[)" + primitives + "]}"; };
    Scene scene = document(
        R"({"mesh":0,"name":"a"},{"mesh":1,"name":"b","translation":[5,0,0]},{"mesh":2,"name":"c"},
{"mesh":3,"name":"d","translation":[0,0,3]})",
        of(primitive(0, 0)) + "," + of(primitive(0, 2) + "," + primitive(1, 0)) + "," + of(primitive(2, 2)) +
            "," + of(primitive(1, 0)),
        R"("materials":[)" + colour("red", 1) + "," + colour("dark", 0.1) + "," + colour("black", 0) + "]");
    for (std::size_t i = 0; i < scene.parts.size(); ++i) { // else some would share a mesh
        scene.parts[i].mesh.positions[0].z = 0.1 * static_cast<double>(i + 1);
        scene.parts[i].changed = true;
    }
    const auto run = run_stage("optimize", "{}", scene);
    REQUIRE(run.scene.parts.size() == 2);
    CHECK(run.record.result["joined"] == Json::array({"a"}));
    CHECK(run.record.result["joined_parts"] == 2);
    CHECK(run.record.result["draw_calls_before"] == 5);
    CHECK(run.record.result["draw_calls_after"] == 3);
    CHECK(drawn_in_world(run.scene) == drawn_in_world(scene));
    CHECK(drawn_in_world(again(run.scene)) == drawn_in_world(scene));
}

TEST_CASE("meshes that are equal to the bit become one, which stays shared", "[stages]") {
    const auto run =
        run_stage("optimize", "{}",
                  document(R"({"mesh":0,"name":"a"},{"mesh":1,"name":"b","translation":[5,0,0]})",
                           mesh(0) + "," + mesh(0, 2), R"("materials":[)" + colour("red", 1) + "]"));
    CHECK(run.scene.parts.size() == 2);
    CHECK(run.record.result["equal_meshes"] == 1);
    const Json json = json_again(run.scene);
    CHECK(json["meshes"].size() == 1);
    CHECK(json["nodes"][1]["mesh"] == 0);
    CHECK(json["nodes"][1]["name"] == "b");
    CHECK(json["accessors"].size() == 2);
    const auto apart = run_stage("optimize", "{dedup: false, join: false, prune: false}",
                                 document(R"({"mesh":0},{"mesh":1})", mesh(0) + "," + mesh(0, 2),
                                          R"("materials":[)" + colour("red", 1) + "]"));
    CHECK(json_again(apart.scene)["meshes"].size() == 2);
    CHECK(json_again(apart.scene)["accessors"].size() == 3);
}

TEST_CASE("meshes that stand together wherever they stand become one, which stays shared", "[stages]") {
    const std::string meshes = mesh(0) + "," + mesh(0, 2), red = R"("materials":[)" + colour("red", 1) + "]";
    const Scene scene =
        document(R"({"mesh":0},{"mesh":1},{"mesh":0,"translation":[5,0,0]},{"mesh":1,"translation":[5,0,0]})",
                 meshes, red);
    const auto run = run_stage("optimize", "{dedup: false}", scene);
    CHECK(run.scene.parts.size() == 2);
    CHECK(run.record.result["joined_parts"] == 2);
    CHECK(drawn_in_world(run.scene) == drawn_in_world(scene));
    const Json json = json_again(run.scene);
    CHECK(json["meshes"].size() == 1);
    CHECK(json["nodes"].size() == 2);
    CHECK(json["nodes"][1]["mesh"] == 0);
    const auto apart = run_stage(
        "optimize", "{dedup: false}",
        document(R"({"mesh":0},{"mesh":1},{"mesh":0,"translation":[5,0,0]},{"mesh":1,"translation":[6,0,0]})",
                 meshes, red));
    CHECK(apart.scene.parts.size() == 4);
}

TEST_CASE("levels of detail of a material stay, and follow their numbers", "[stages]") {
    const std::string lods = R"("materials":[)" + colour("unused", 0.5) + "," +
                             R"({"name":"near","extensions":{"MSFT_lod":{"ids":[3,2]}}},)" +
                             colour("far", 0.2) + "," + colour("middle", 0.3) +
                             R"(],"extensionsUsed":["MSFT_lod"])";
    Bench b;
    b.scene = document(R"({"mesh":0})", mesh(1), lods);
    b.run("optimize", Value::map({}));
    const Json json = json_again(b.scene);
    const Json& near = json["materials"].at(0);
    CHECK(near["name"] == "near"); // the unused material is erased
    const auto level = [&](std::size_t i) -> const Json& {
        return json["materials"][near["extensions"]["MSFT_lod"]["ids"][i].get<std::size_t>()]["name"];
    };
    CHECK(level(0) == "middle");
    CHECK(level(1) == "far");
}

TEST_CASE("images of equal bytes become one, with their textures and materials", "[stages]") {
    const std::string uri = "data:image/png;base64," + io::base64(to_bytes(red_png()));
    const auto textured = [](int texture) {
        return fmt::format(R"({{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":{}}}}}}})", texture);
    };
    const std::string more = fmt::format(
        R"("images":[{{"uri":"{0}","name":"x"}},{{"uri":"{0}"}},{{"uri":"unused.png","name":"y"}}],
"textures":[{{"source":0}},{{"source":1}}],"materials":[{1},{2}],"samplers":[{{"magFilter":9728}}])",
        uri, textured(0), textured(1));
    io::ReadLog log;
    const Scene scene =
        document(R"({"mesh":0},{"mesh":1,"translation":[3,0,0]})", mesh(0) + "," + mesh(1, 2), more);
    const auto run = run_stage("optimize", "{}", scene);
    const Json json = json_again(run.scene);
    CHECK(json["images"].size() == 1);
    CHECK(json["textures"].size() == 1);
    CHECK(json["materials"].size() == 1);
    CHECK(json["meshes"].size() == 1);
    CHECK_FALSE(json.contains("samplers"));
    CHECK(run.record.result["erased"]["images"] == 2);
}

TEST_CASE("optimize leaves alone what something else depends on", "[stages]") {
    const std::string materials = R"("materials":[)" + colour("red", 1) + "]";
    const std::string channel =
        R"("animations":[{"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}],
"samplers":[{"input":3,"output":0}]}])";
    const auto parts_left = [&](const std::string& second, const std::string& second_mesh,
                                const std::string& more, const std::string& options = "{dedup: false}") {
        const Scene scene =
            document(R"({"mesh":0,"name":"a"},)" + second, mesh(0) + "," + second_mesh, materials + more);
        return run_stage("optimize", options, scene).scene.parts.size();
    };
    const std::string plain = R"({"mesh":1,"name":"b","translation":[5,0,0]})";
    CHECK(parts_left(plain, mesh(0, 2), "") == 1);
    CHECK(parts_left(plain, mesh(0, 2), "", "{dedup: false, keep_names: true}") == 2);
    CHECK(parts_left(plain, mesh(0, 2), "", "{dedup: false, join: false}") == 2);
    CHECK(parts_left(R"({"mesh":1,"extras":{"door":1}})", mesh(0, 2), "") == 2);
    CHECK(parts_left(plain, mesh(0, 2, R"(,"extras":{"door":1})"), "") == 2);
    CHECK(parts_left(R"({"mesh":1,"camera":0})", mesh(0, 2),
                     R"(,"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}])") == 2);
    CHECK(parts_left(R"({"mesh":1,"scale":[0,1,1]})", mesh(0, 2), "") == 2);
    Json animated = Json::parse("{" + channel + "}");
    animated["animations"][0]["samplers"][0]["input"] = 1;
    CHECK(parts_left(plain, mesh(0, 2), R"(,"animations":)" + animated["animations"].dump()) == 2);
    CHECK(parts_left(R"({"children":[2],"name":"g"},{"mesh":1})", mesh(0, 2),
                     R"(,"animations":)" + animated["animations"].dump()) == 2);
}

TEST_CASE("nothing is erased beside an extension that is not known", "[stages]") {
    const auto run = run_stage(
        "optimize", "{}",
        document(R"({"mesh":0},{"mesh":1,"translation":[5,0,0],"extensions":{"ACME_door":{"node":0}}})",
                 mesh(0) + "," + mesh(0, 2),
                 R"("extensionsUsed":["ACME_door"],"materials":[)" + colour("red", 1) + "," +
                     colour("blue", 0) + "]"));
    CHECK(run.warnings() == std::vector<std::string>{"W-OPTIMIZE"});
    CHECK(run.scene.parts.size() == 2);
    CHECK(json_again(run.scene)["materials"].size() == 2);
}

TEST_CASE("optimize takes scenes of any origin, also empty ones", "[stages]") {
    CHECK(run_stage("optimize", "{}", scene_of(Mesh{})).record.result["draw_calls_before"] == 0);
    Scene two = scene_of(shapes::cube());
    two.parts.push_back(two.parts[0]);
    two.parts[1].transform.m[0][3] = 9;
    two.parts[1].name = "other";
    const auto run = run_stage("optimize", "{}", two);
    REQUIRE(run.scene.parts.size() == 1);
    CHECK(run.scene.parts[0].mesh.face_count() == 2 * two.parts[0].mesh.face_count());
    CHECK(run.scene.bounds().max.x == two.bounds().max.x);
    CHECK(run_stage("optimize", "{join: false}", two).scene.parts.size() == 2);
}

namespace {

/// Six triangles, each of a material of its own, in a row.
/// A triangle of each of so many colours.
Scene coloured(int count, double least) {
    std::string nodes, meshes, materials;
    for (int i = 0; i < count; ++i) {
        nodes += fmt::format(R"({}{{"mesh":{},"translation":[{},0,0]}})", i ? "," : "", i, 2 * i);
        meshes += (i ? "," : "") + mesh(i);
        materials += (i ? "," : "") + colour(fmt::format("m{}", i), i * least);
    }
    return document(nodes, meshes, R"("materials":[)" + materials + "]");
}

Scene six_colours() { return coloured(6, 0.1); }

bool has_attribute(const Scene& scene, std::string_view name) {
    for (const Part& part : scene.parts)
        for (const Attribute& a : part.mesh.attributes)
            if (a.name == name) return true;
    return false;
}

} // namespace

TEST_CASE("attributes that no material needs go on request", "[stages]") {
    const auto kept = run_stage("optimize", "{}", six_colours());
    CHECK(has_attribute(kept.scene, "TEXCOORD_0"));
    const auto dropped = run_stage("optimize", "{drop_attributes: true}", six_colours());
    CHECK_FALSE(has_attribute(dropped.scene, "TEXCOORD_0"));
    CHECK(dropped.record.result["dropped_attributes"] == Json::array({"TEXCOORD_0"}));
    CHECK(json_again(dropped.scene)["meshes"][0]["primitives"][0]["attributes"].size() == 1);

    const std::string textured =
        R"({"images":[{"uri":"data:image/png;base64,)" + io::base64(to_bytes(red_png())) +
        R"("}],"textures":[{"source":0}],"materials":[{"normalTexture":{"index":0}}]})";
    const Scene needed = document(R"({"mesh":0})", mesh(0), textured.substr(1, textured.size() - 2));
    CHECK(has_attribute(run_stage("optimize", "{drop_attributes: true}", needed).scene, "TEXCOORD_0"));
}

TEST_CASE("tangents go with what morph targets displace of them, unless a target had nothing else",
          "[stages]") {
    Scene scene = six_colours();
    Mesh& mesh = scene.parts[0].mesh;
    const auto count = mesh.wedge_count();
    mesh.attributes.push_back(
        {"TANGENT", Domain::wedge, Role::tangent, 4, false, std::vector<float>(4 * count, 0.5F)});
    CHECK_FALSE(has_attribute(run_stage("optimize", "{drop_attributes: true}", scene).scene, "TANGENT"));
    const auto displaces = [&](const char* name) {
        scene.parts[0].mesh.attributes.push_back(
            {name, Domain::wedge, Role::morph_vector, 3, false, std::vector<float>(3 * count)});
    };
    displaces("TARGET_0_TANGENT");
    const auto alone = run_stage("optimize", "{drop_attributes: true}", scene);
    CHECK(has_attribute(alone.scene, "TANGENT"));
    CHECK(has_attribute(alone.scene, "TARGET_0_TANGENT"));
    displaces("TARGET_0_POSITION");
    const auto beside = run_stage("optimize", "{drop_attributes: true}", scene);
    CHECK_FALSE(has_attribute(beside.scene, "TANGENT"));
    CHECK_FALSE(has_attribute(beside.scene, "TARGET_0_TANGENT"));
    CHECK(has_attribute(beside.scene, "TARGET_0_POSITION"));
}

TEST_CASE("attributes of one's own go on request only", "[stages]") {
    Scene scene = six_colours();
    Mesh& mesh = scene.parts[0].mesh;
    mesh.attributes.push_back(
        {"quality", Domain::vertex, Role::generic, 1, false, std::vector<float>(mesh.vertex_count(), 0.5F)});
    mesh.attributes.push_back(
        {"_weight", Domain::wedge, Role::generic, 1, false, std::vector<float>(mesh.wedge_count(), 2)});
    const auto kept = run_stage("optimize", "{drop_attributes: true}", scene);
    CHECK(has_attribute(kept.scene, "quality"));
    CHECK(has_attribute(kept.scene, "_weight"));
    const auto dropped = run_stage("optimize", "{drop_own: true}", scene);
    CHECK_FALSE(has_attribute(dropped.scene, "quality"));
    CHECK(has_attribute(dropped.scene, "TEXCOORD_0"));
    CHECK(dropped.record.result["dropped_attributes"] == Json::array({"_weight", "quality"}));
    // They stay if an extension of a primitive may read them.
    for (Primitive& p : scene.parts[0].mesh.primitives)
        p.json = R"({"extensions":{"EXT_mesh_features":{"featureIds":[{"featureCount":1}]}}})";
    CHECK(has_attribute(run_stage("optimize", "{drop_own: true}", scene).scene, "_weight"));
}

TEST_CASE("wedges that only a dropped attribute kept apart become one", "[stages]") {
    Scene scene = six_colours();
    scene.parts.resize(1);
    Mesh& mesh = scene.parts[0].mesh;
    mesh.positions.push_back(
        {1, 1, 0}); // a second face across an edge, whose wedges differ only in TEXCOORD_0
    mesh.wedge_vertex = {0, 1, 2, 1, 2, 3};
    mesh.corners = {0, 1, 2, 4, 3, 5};
    mesh.find("TEXCOORD_0", Domain::wedge)->data =
        std::vector<float>{0, 0, 1, 0, 0, 1, 0.5F, 0, 0, 0.5F, 1, 1};
    Attribute* primitive = mesh.find(primitive_attribute, Domain::face);
    if (primitive) primitive->resize(2);
    CHECK(mesh.wedge_count() == 6);
    const auto run = run_stage("optimize", "{drop_attributes: true}", scene);
    CHECK(run.mesh().wedge_count() == 4);
    CHECK(run.mesh().face_count() == 2);
    CHECK_FALSE(run.mesh().has_seams());
}

TEST_CASE("plain materials become pixels of one, and their parts one draw call", "[stages]") {
    const Scene scene = six_colours();
    CHECK(run_stage("optimize", "{palette: true}", scene).record.result["palettes"] ==
          0); // it has coordinates
    const auto run = run_stage("optimize", "{palette: true, drop_attributes: true}", scene);
    CHECK(run.record.result["palettes"] == 1);
    CHECK(run.record.result["palette_materials"] == 6);
    CHECK(run.record.result["draw_calls_before"] == 6);
    CHECK(run.record.result["draw_calls_after"] == 1);
    CHECK(run.scene.bounds().max.x == scene.bounds().max.x);
    const Json json = json_again(run.scene);
    REQUIRE(json["materials"].size() == 1);
    REQUIRE(json["images"].size() == 1);
    CHECK(json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] == 0);
    CHECK(json["samplers"][0]["minFilter"] == 9728);
    const auto images = io::document_images(*again(run.scene).documents.at(0), {});
    const auto pixels = io::decoded_image(images.at(0).bytes);
    REQUIRE(pixels);
    CHECK(pixels->width == 6);
    const Attribute* uv = run.mesh().find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    for (Index f = 0; f < 6; ++f) { // the pixel that a face reads is the colour that its material had
        const Index w = run.mesh().corners[3 * f];
        const double place = run.scene.parts[0].transform.point(run.mesh().point(3 * f)).x;
        const auto column = static_cast<std::size_t>(uv->value(w, 0) * 6);
        const double red = std::floor(place / 2 + 0.5) / 10;
        CHECK(std::abs(double(linear_of(pixels->rgba[4 * column])) - red) < 0.005);
        CHECK(pixels->rgba[4 * column + 1] == 0);
    }
    CHECK(run_stage("optimize", "{palette: true, drop_attributes: true, palette_min: 7}", scene)
              .record.result["palettes"] == 0);
}

TEST_CASE("that a palette would have too many looks is told", "[stages]") {
    const auto run = run_stage("optimize", "{palette: true, drop_attributes: true}", coloured(513, 0.001));
    CHECK(run.record.result["palettes"] == 0);
    REQUIRE(run.record.warnings.size() == 1);
    CHECK(run.record.warnings[0].id == "W-PALETTE");
    CHECK(run.record.warnings[0].message ==
          "optimize: no palette was made of 513 materials: it has at most 512");
    CHECK(run_stage("optimize", "{palette: true, drop_attributes: true}", coloured(512, 0.001))
              .record.warnings.empty());
}

TEST_CASE("a vertex between two plain materials has a texture coordinate for each", "[stages]") {
    Scene scene = document(R"({"mesh":0})", mesh(0),
                           R"("materials":[)" + colour("red", 1) + "," + colour("dark", 0.1) + "]");
    Mesh& m = scene.parts[0].mesh;
    m.attributes.clear();
    m.positions.push_back({1, 1, 0});
    m.wedge_vertex.clear();
    m.corners = {0, 1, 2, 2, 1, 3};
    m.primitives.resize(2);
    for (Index p = 0; p < 2; ++p) m.primitives[p].material = p;
    m.attributes.push_back({std::string(primitive_attribute), Domain::face, Role::index, 1, false,
                            std::vector<std::uint32_t>{0, 1}});
    const auto run = run_stage("optimize", "{palette: true, palette_min: 2}", scene);
    CHECK(run.mesh().wedge_count() == 6);
    CHECK(run.mesh().vertex_count() == 4);
    CHECK(run.record.result["draw_calls_after"] == 1);
    CHECK(drawn_in_world(again(run.scene)).size() == 2);
}

TEST_CASE("parts of one mesh become instances, and instances parts", "[stages]") {
    std::string nodes;
    for (int i = 0; i < 6; ++i)
        nodes +=
            fmt::format(R"({}{{"mesh":0,"translation":[{},0,0],"rotation":[0,0,{},{}],"scale":[2,{},1]}})",
                        i ? "," : "", 10 * i, i % 2, 1 - i % 2, i == 5 ? -1 : 1);
    const Scene scene = document(nodes, mesh(0), R"("materials":[)" + colour("red", 1) + "]");
    CHECK(run_stage("optimize", "{instance: true, instance_min: 6}", scene).scene.parts.size() == 6);
    const auto run = run_stage("optimize", "{instance: true}", scene);
    REQUIRE(run.scene.parts.size() == 2); // one is mirrored
    CHECK(run.warnings().empty());        // of surface that is lost: it is at five places
    CHECK(run.record.result["instances"] == 5);
    CHECK(run.record.result["draw_calls_after"] == 2);
    for (const bool meshopt : {false, true}) {
        io::WriteSettings settings;
        settings.meshopt.on = settings.quantize.on = meshopt;
        const auto glb = written(run.scene, "glb", settings).files.at(0).bytes;
        const Json json = Json::parse(json_of(glb));
        CHECK(json["nodes"].size() == 2);
        CHECK(json["extensionsRequired"].dump().find("EXT_mesh_gpu_instancing") != std::string::npos);
        io::ReadSettings expand;
        expand.expand_instances = true;
        io::ReadLog log;
        const Scene back = io::codec_named("glb")->read(io::Input::of("x", io::Bytes(glb)), expand, log);
        CHECK(log.warnings.empty());
        REQUIRE(back.parts.size() == 6);
        const auto before = drawn_in_world(scene), after = drawn_in_world(back);
        REQUIRE(before.size() == after.size());
        for (std::size_t f = 0; f < before.size(); ++f)
            for (std::size_t k = 0; k < before[f].size(); ++k)
                CHECK(std::abs(before[f][k] - after[f][k]) < (meshopt ? 2e-3F : 1e-5F));
        CHECK(back.documents.at(0)->json.find("EXT_mesh_gpu_instancing") == std::string::npos);
    }
}

TEST_CASE("instances that rounding makes nearly equal are read back", "[stages]") {
    std::string nodes;
    for (int i = 0; i < 8; ++i)
        nodes += fmt::format(R"({}{{"mesh":0,"translation":[{},0,0],"scale":[{},{},{}]}})", i ? "," : "",
                             10 * i, 1 - 1e-7 * (i % 3), 1 + 2e-7 * (i % 4), 1 + 1e-7 * (i % 5));
    Bench b;
    b.scene = document(nodes, mesh(0), R"("materials":[)" + colour("red", 1) + "]");
    b.run("optimize", options({{"instance", "true"}}));
    for (const char* option : {"quantize", "meshopt"})
        CHECK_NOTHROW(b.run("write", options({{"path", std::string(option) + ".glb"}, {option, "true"}})));
}

TEST_CASE("a set stays while a later one is needed", "[stages]") {
    Scene scene = document(
        R"({"mesh":0})",
        R"({"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":1,"TEXCOORD_2":1},"material":0}]})",
        R"("images":[{"uri":"data:image/png;base64,AAAA"}],"textures":[{"source":0}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}}])");
    const auto run = run_stage("optimize", "{drop_attributes: true}", scene);
    CHECK(run.record.result["dropped_attributes"] == Json({"TEXCOORD_2"}));
}

TEST_CASE("accessors of different uses stay apart", "[stages]") {
    // Times and weights of equal numbers.
    Json json = Json::parse(document_text(
        R"({"mesh":0})", R"({"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":2}]}]})",
        R"("animations":[{"samplers":[{"input":3,"output":4}],"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]}])"));
    for (int i = 0; i < 2; ++i)
        json["accessors"].push_back({{"bufferView", 1},
                                     {"componentType", 5126},
                                     {"count", 2},
                                     {"type", "SCALAR"},
                                     {"min", {0.0}},
                                     {"max", {0.0}}});
    const auto run = run_stage("optimize", "", read_text(json.dump()));
    const Json after = Json::parse(run.scene.documents[0]->json);
    const Json& sampler = after["animations"][0]["samplers"][0];
    CHECK(sampler["input"] != sampler["output"]);
}

TEST_CASE("what shears cannot be an instance", "[stages]") {
    std::string nodes = R"({"children":[1,2,3,4,5],"scale":[1,2,1]})";
    for (int i = 0; i < 5; ++i)
        nodes += fmt::format(R"(,{{"mesh":0,"translation":[{},0,0],"rotation":[0,0,0.6,0.8]}})", i);
    const Scene scene = document(nodes, mesh(0), R"("materials":[)" + colour("red", 1) + "]");
    CHECK(run_stage("optimize", "{instance: true}", scene).scene.parts.size() == 5);
}

TEST_CASE("flatten moves parts to the top of the scene, where they stand", "[stages]") {
    const Scene scene = document(
        R"({"children":[1],"name":"group","translation":[1,2,3]},{"children":[2,3],"scale":[2,1,1]},{"mesh":0,"name":"a"},
{"mesh":1,"name":"b","rotation":[0,0,0.6,0.8]})",
        mesh(0) + "," + mesh(0, 2), R"("materials":[)" + colour("red", 1) + "]");
    const auto run = run_stage("optimize", "{flatten: true, join: false}", scene);
    CHECK(run.record.result["flattened_parts"] == 2);
    CHECK(run.record.result["erased"]["nodes"] == 2);
    const Json json = json_again(run.scene);
    CHECK(json["nodes"].size() == 2);
    CHECK(json["scenes"][0]["nodes"].size() == 2);
    CHECK(drawn_in_world(again(run.scene)) == drawn_in_world(scene));
    const std::string animated =
        R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],"samplers":[{"input":1,"output":0}]}])";
    const Scene moving = document(R"({"children":[1]},{"mesh":0})", mesh(0),
                                  R"("materials":[)" + colour("red", 1) + "]" + animated);
    CHECK(run_stage("optimize", "{flatten: true}", moving).record.result["flattened_parts"] == 0);
}

TEST_CASE("accessors of equal bytes become one, and needless bounds go", "[stages]") {
    const std::string channels =
        R"("animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}},{"sampler":1,"target":{"node":0,"path":"scale"}}],
"samplers":[{"input":3,"output":0},{"input":4,"output":2}]}],"materials":[)";
    Json json = Json::parse(document_text(R"({"mesh":0})", mesh(0), channels + colour("red", 1) + "]"));
    for (int i = 0; i < 2; ++i)
        json["accessors"].push_back({{"bufferView", 1},
                                     {"componentType", 5126},
                                     {"count", 3},
                                     {"type", "SCALAR"},
                                     {"min", {0}},
                                     {"max", {1}}});
    json["accessors"][1]["min"] = {0, 0};
    json["accessors"][1]["max"] = {1, 1};
    const auto run = run_stage("optimize", "{}", read_text(json.dump()));
    CHECK(run.record.result["equal_accessors"] == 1); // the times; positions and scales have different uses
    const Json after = Json::parse(run.scene.documents.at(0)->json);
    CHECK(after["accessors"].size() == 4);
    CHECK(after["animations"][0]["samplers"][0]["input"] == after["animations"][0]["samplers"][1]["input"]);
    CHECK_FALSE(after["accessors"][1].contains("min"));
    CHECK(after["accessors"][after["animations"][0]["samplers"][0]["input"].get<std::size_t>()].contains(
        "min"));
}

TEST_CASE("equal wedges of a vertex become one, and white colours go on request", "[stages]") {
    Scene scene = test::scene_of(shapes::cube());
    Mesh& mesh = scene.parts[0].mesh;
    separate_corners(mesh);
    mesh.attributes.push_back({"COLOR_0", Domain::wedge, Role::colour, 4, true,
                               std::vector<std::uint8_t>(4 * mesh.wedge_count(), 255)});
    const auto run = run_stage("optimize", "{}", scene);
    CHECK(run.mesh().wedge_count() == 8);
    CHECK(run.record.result["equal_vertices"] == 28);
    CHECK(has_attribute(run.scene, "COLOR_0"));
    CHECK_FALSE(has_attribute(run_stage("optimize", "{drop_attributes: true}", scene).scene, "COLOR_0"));
    CHECK(run_stage("optimize", "{dedup: false}", scene).mesh().wedge_count() == 36);
    std::get<std::vector<std::uint8_t>>(mesh.attributes.back().data)[5] = 254;
    CHECK(has_attribute(run_stage("optimize", "{drop_attributes: true}", scene).scene, "COLOR_0"));
}

TEST_CASE("primitives of one material become one in a mesh that is shared, too", "[stages]") {
    const std::string two =
        R"({"primitives":[{"attributes":{"POSITION":0},"material":0},{"attributes":{"POSITION":2},"material":0}]})";
    const Scene scene = document(R"({"mesh":0},{"mesh":0,"translation":[5,0,0]})", two,
                                 R"("materials":[)" + colour("red", 1) + "]");
    const auto run = run_stage("optimize", "{}", scene);
    CHECK(run.record.result["draw_calls_before"] == 4);
    CHECK(run.record.result["draw_calls_after"] == 2);
    const Json json = json_again(run.scene);
    CHECK(json["meshes"].size() == 1);
    CHECK(json["meshes"][0]["primitives"].size() == 1);
}

TEST_CASE("tracks that keep a node where it is go, and the animation stays as long", "[stages]") {
    // Three keys each: the scale rests, the translation does not; the first times end later.
    const auto moved = [](const std::string& channels) {
        Json json = Json::parse(document_text(
            R"({"mesh":0,"scale":[1,1,1.000001]},{"translation":[2,0,0]})", mesh(0),
            R"("materials":[)" + colour("red", 1) + R"(],"animations":[{"channels":)" + channels +
                R"(,"samplers":[{"input":3,"output":0},{"input":3,"output":4},{"input":5,"output":4}]}])"));
        std::vector<float> numbers{0, 1, 2, 0, 1, 3};
        numbers.insert(numbers.end(), 9, 1.0F);
        const auto bytes = std::as_bytes(std::span(numbers));
        json["buffers"].push_back({{"byteLength", bytes.size()},
                                   {"uri", "data:application/octet-stream;base64," + io::base64(bytes)}});
        for (const auto& [offset, length] : {std::pair(0, 12), {24, 36}, {12, 12}})
            json["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", offset}, {"byteLength", length}});
        for (const auto& [view, type, end] : {std::tuple(2, "SCALAR", 2), {3, "VEC3", 0}, {4, "SCALAR", 3}}) {
            json["accessors"].push_back(
                {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", type}});
            if (end > 0) {
                json["accessors"].back()["min"] = {0};
                json["accessors"].back()["max"] = {end};
            }
        }
        const auto run = run_stage("optimize", "{}", read_text(json.dump()));
        return std::pair(run.record.result["erased"]["tracks"].get<int>(),
                         Json::parse(run.scene.documents.at(0)->json)["animations"][0]);
    };
    const std::string moves = R"({"sampler":0,"target":{"node":0,"path":"translation"}})";
    const auto [dropped, left] = moved("[" + moves + R"(,{"sampler":1,"target":{"node":0,"path":"scale"}}])");
    CHECK(dropped == 1);
    CHECK(left["channels"].size() == 1);
    CHECK(left["channels"][0]["target"]["path"] == "translation");
    CHECK(left["samplers"].size() == 1);
    const auto [none_dropped, longest] =
        moved("[" + moves + R"(,{"sampler":2,"target":{"node":0,"path":"scale"}}])");
    CHECK(none_dropped == 0);
    CHECK(longest["channels"].size() == 2);
    const auto times_of = [&longest = longest](std::size_t channel) {
        return longest["samplers"][longest["channels"][channel]["sampler"].get<std::size_t>()]["input"]
            .get<int>();
    };
    CHECK(times_of(0) != times_of(1)); // one key at the end
    CHECK(moved("[" + moves + R"(,{"sampler":1,"target":{"node":0,"path":"translation"}}])").first == 0);
}

TEST_CASE("what is in the scene and what is not are not joined, and that it is not is told", "[stages]") {
    const Json all = Json::parse(
        document(R"({"mesh":0,"name":"hidden"},{"mesh":1,"name":"seen"},{"mesh":2,"name":"too"})",
                 mesh(0) + "," + mesh(0, 2) + "," + mesh(0), R"("materials":[)" + colour("red", 1) + "]")
            .documents.at(0)
            ->json);
    const auto of_roots = [&](const char* scenes, bool known = true) {
        Json json = all;
        json["scenes"] = Json::parse(scenes);
        if (!known) json.erase("scene");
        if (json["scenes"].empty()) json.erase("scenes");
        return json;
    };
    const auto names_told = [](const Json& json) {
        io::ReadLog log;
        read_text(json.dump(), &log);
        std::string told;
        for (const Diagnostic& w : log.warnings)
            if (w.id == "W-SCENES") told += w.message.substr(w.message.rfind(':') + 2);
        return told;
    };
    CHECK(names_told(of_roots(R"([{"nodes":[0,1,2]}])")).empty());
    CHECK(names_told(of_roots("[]", false)).empty()); // nothing distinguishes scenes
    CHECK(names_told(of_roots(R"([{"nodes":[1,2]}])")) == "hidden");
    CHECK(names_told(of_roots(R"([{"nodes":[2]},{"nodes":[0]}])", false)) == "hidden, seen");
    Json levels = of_roots(R"([{"nodes":[1,2]}])");
    levels["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {0};
    CHECK(names_told(levels).empty()); // shown instead of the node that refers to it

    const auto run = run_stage("optimize", "{}", read_text(of_roots(R"([{"nodes":[1,2]}])").dump()));
    REQUIRE(run.scene.parts.size() == 2);
    CHECK(run.scene.parts[0].mesh.face_count() == 1);
    CHECK(run.scene.parts[1].mesh.face_count() == 2);
    const Json json = json_again(run.scene);
    const Json& root = json["nodes"][json["scenes"][0]["nodes"].at(0).get<std::size_t>()];
    CHECK(root["name"] == "seen");
}
