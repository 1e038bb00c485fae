// Titles, licences and comments are kept where a format has a place, and named where it has none.
#include "base/json.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

const char* const commented_ply = R"(ply
format ascii 1.0
comment Scanned by Ann, temple of Aphaia
comment VCGLIB generated
comment unit: mm
obj_info num_cols 512
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
)";

Scene titled_scene(const char* more = "") {
    return read_text(std::string(R"({"asset":{"version":"2.0","copyright":"Museum X","extras":
{"Title":"Bust","unit":"cm","comments":["up: z"]}},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"extras":{"id":7}}],)") +
                     more + R"("buffers":[{"byteLength":36,"uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,
"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})");
}

std::string text_of(const io::Written& written) {
    const auto& bytes = written.files.at(0).bytes;
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string losses(const io::Written& written) {
    std::string all;
    for (const Diagnostic& w : written.warnings)
        if (w.id == "W-LOST") all += w.message + "\n";
    return all;
}

bool has_text(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_CASE("comments of PLY stay, except those of programs and facetmill's own", "[io]") {
    const Scene scene = read_bytes(to_bytes(commented_ply), "ply");
    CHECK(scene.unit == Unit::mm);
    REQUIRE(scene.documents.size() == 1);
    CHECK(Json::parse(scene.documents[0]->json)["asset"]["extras"]["comments"] ==
          Json({"Scanned by Ann, temple of Aphaia", "obj_info num_cols 512"}));
    const auto ply = written(scene, "ply");
    CHECK(has_text(text_of(ply), "\ncomment Scanned by Ann, temple of Aphaia\nobj_info num_cols 512\n"));
    CHECK(losses(ply).empty());
    for (const char* format : {"obj", "off"}) {
        const auto other = written(scene, format);
        CHECK(has_text(text_of(other), "\n# Scanned by Ann, temple of Aphaia\n"));
        CHECK(losses(other).empty());
    }
    CHECK(losses(written(scene, "stl")).empty()); // most scans have comments, and few need them
}

TEST_CASE("metadata that look like statements of facetmill state nothing", "[io]") {
    Scene scene = titled_scene();
    for (const char* format : {"ply", "off", "obj"}) {
        const auto file = written(scene, format);
        CHECK(has_text(text_of(file), "copyright: Museum X\n"));
        CHECK(has_text(text_of(file), "Title: Bust\n"));
        const Scene again = read_bytes(file.files.at(0).bytes, format);
        CHECK(again.unit == Unit::m);
        CHECK(again.up == UpAxis::y);
    }
}

TEST_CASE("one warning names all that a format cannot hold", "[io]") {
    const Scene scene = titled_scene(R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}],
"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},)");
    CHECK(losses(written(scene, "stl")) == "not written, because STL cannot hold it: the metadata copyright, "
                                           "Title, unit, 1 camera, the "
                                           "lights, the extras of 1 node\n");
    CHECK(losses(written(scene, "3mf")) == "not written, because 3MF cannot hold it: the metadata unit, "
                                           "1 camera, the lights, the extras "
                                           "of 1 node\n");
    CHECK(losses(written(scene, "ply")) ==
          "not written, because PLY cannot hold it: 1 camera, the lights, the extras of 1 node\n");
    CHECK(losses(written(scene, "glb")).empty());
}

TEST_CASE("other values of a further file are kept or named", "[io]") {
    Scene scene = titled_scene();
    Scene other = scene;
    Document document = *other.documents.at(0);
    Json json = Json::parse(document.json);
    json["asset"]["extras"]["Title"] = "Head";
    document.json = json.dump();
    scene.documents.push_back(std::make_shared<const Document>(std::move(document)));
    for (const char* format : {"ply", "obj", "off"}) {
        const std::string text = text_of(written(scene, format));
        CHECK(text.find("Title: Bust") != text.npos);
        CHECK(text.find("Title: Head") != text.npos);
    }
    CHECK(losses(written(scene, "3mf")).find("the metadata unit, Title of a further file") !=
          std::string::npos);
}

TEST_CASE("extras of data that is rewritten are named", "[io]") {
    Scene scene = titled_scene();
    Document document = *scene.documents.at(0);
    Json json = Json::parse(document.json);
    json["accessors"][0]["extras"] = {{"survey", 7}};
    document.json = json.dump();
    scene.documents[0] = std::make_shared<const Document>(document);
    CHECK(losses(written(scene, "gltf")).empty()); // the mesh is unchanged
    scene.parts.at(0).mesh.positions[0].x += 1;
    scene.parts[0].changed = true;
    const std::string lost = losses(written(scene, "gltf"));
    CHECK(lost.find("the extras of data that is rewritten are lost: 1 accessor") == 0);
}
