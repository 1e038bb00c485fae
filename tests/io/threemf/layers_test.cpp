// Textures of 3MF: images and their points, alone and among layers.
#include "support/catch.hpp"

#include "base/json.hpp"
#include "io/threemf/zip.hpp"
#include "support/colours.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

const std::string materials = R"(<m:texture2d id="1" path="/3D/Textures/wood.png" contenttype="image/png"/>
<m:texture2dgroup id="2" texid="1"><m:tex2coord u="0" v="0"/><m:tex2coord u="1" v="0.25"/>
<m:tex2coord u="0.5" v="1"/></m:texture2dgroup>
<m:colorgroup id="3"><m:color color="#FF8000"/><m:color color="#00FF00"/></m:colorgroup>
<basematerials id="4"><base name="red" displaycolor="#FF0000"/></basematerials>
)";

std::string model(const std::string& more, const std::string& triangles) {
    return fmt::format(
        R"(<?xml version="1.0"?><model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"><resources>{}{}<object id="9"><mesh>
<vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/>
<vertex x="1" y="1" z="0"/></vertices><triangles>{}</triangles></mesh></object></resources>
<build><item objectid="9"/></build></model>)",
        materials, more, triangles);
}

struct Loaded {
    Scene scene;
    io::ReadLog log;
};

Loaded load(const std::string& model, const std::string& image) {
    std::vector<io::threemf::ArchiveFile> files{{"3D/3dmodel.model", to_bytes(model)}};
    if (!image.empty()) files.push_back({"3D/Textures/wood.png", to_bytes(image)});
    Loaded loaded;
    loaded.scene = io::read_scene(io::Input::of("a.3mf", io::threemf::make_archive(files)), {}, loaded.log);
    return loaded;
}

std::array<double, 2> point_at(const Mesh& mesh, Index corner) {
    const Attribute* a = mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(a);
    return {a->value(mesh.corners[corner], 0), a->value(mesh.corners[corner], 1)};
}

} // namespace

TEST_CASE("textures of 3MF keep their images and points, also beside colours", "[io]") {
    const std::string png = png_of(2, "\x80\x40\x20");
    const auto [scene, log] = load(model("", R"(<triangle v1="0" v2="1" v3="2" pid="2" p1="0" p2="1" p3="2"/>
<triangle v1="1" v2="3" v3="2" pid="3" p1="0"/><triangle v1="0" v2="2" v3="1"/>)"),
                                   png);
    CHECK(log.warnings.empty());
    const Mesh& mesh = scene.parts.at(0).mesh;
    CHECK(point_at(mesh, 0) == std::array{0.0, 1.0}); // v is from the top in glTF
    CHECK(point_at(mesh, 1) == std::array{1.0, 0.75});
    CHECK(point_at(mesh, 2) == std::array{0.5, 0.0});
    REQUIRE(mesh.primitives.size() == 3);
    const auto of = [&](Index f) -> const Primitive& { return mesh.primitives[mesh.primitive_of(f)]; };
    CHECK(scene.materials.at(of(0).material).name == "wood");
    CHECK(of(0).lists("TEXCOORD_0"));
    CHECK_FALSE(of(0).lists("COLOR_0"));
    CHECK(of(1).material == none);
    CHECK(of(1).lists("COLOR_0"));
    CHECK(of(2).material == none);
    CHECK_FALSE(of(2).lists("TEXCOORD_0"));
    REQUIRE(scene.documents.size() == 1);
    const Json json = parse_json(scene.documents[0]->json, Broken::discarded);
    const std::string uri = json["images"][0]["uri"];
    CHECK(uri == "wood.png");
    CHECK(scene.documents[0]->files.at(uri) == to_bytes(png));
    const Scene glb = read_bytes(written(scene, "glb").files.at(0).bytes, "glb");
    CHECK(glb.parts.at(0).mesh.find("TEXCOORD_0", Domain::wedge) != nullptr);
}

TEST_CASE("layers of 3MF with a texture are what glTF can show", "[io]") {
    const std::string png = png_of(2, "\x80\x40\x20");
    const auto layers = [&](const char* groups, const char* methods) {
        return load(model(fmt::format(R"(<m:multiproperties id="5" pids="{}" blendmethods="{}">
<m:multi pindices="0 1"/></m:multiproperties>)",
                                      groups, methods),
                          R"(<triangle v1="0" v2="1" v3="2" pid="5" p1="0"/>)"),
                    png);
    };
    for (const char* order : {"3 2", "2 3"}) { // a colour that multiplies the texture
        const auto [scene, log] = layers(order, "multiply");
        CHECK(log.warnings.empty());
        const Mesh& mesh = scene.parts.at(0).mesh;
        CHECK(scene.materials.size() == 1);
        const Attribute* colour = mesh.find("COLOR_0", Domain::wedge);
        REQUIRE(colour);
        CHECK(srgb_byte(*colour, mesh.corners[0], 1) == (order[0] == '3' ? 128 : 255));
        CHECK(point_at(mesh, 0) == (order[0] == '3' ? std::array{1.0, 0.75} : std::array{0.0, 1.0}));
    }
    const auto [covered, log] = layers("4 2", "mix"); // the texture hides the material
    CHECK(covered.parts.at(0).mesh.find("COLOR_0", Domain::wedge) == nullptr);
    CHECK(covered.materials.at(0).name == "wood");
    CHECK(log.warnings.at(0).message ==
          "elements that cannot be kept are skipped: layers beside a texture (1)");
    const auto [colour, more] = layers("2 3", "mix"); // the colour hides the texture
    CHECK(colour.materials.empty());
    CHECK(more.warnings.size() == 1);
    const auto [alone, none_said] = layers("2", "");
    CHECK(none_said.warnings.empty());
    CHECK(alone.materials.size() == 1);
}

TEST_CASE("a texture of 3MF without an image leaves the material, and is named", "[io]") {
    const std::string triangle = R"(<triangle v1="0" v2="1" v3="2" pid="2" p1="0"/>)";
    for (const std::string& image : {std::string(), std::string("GIF89a")}) {
        const auto [scene, log] = load(model("", triangle), image);
        CHECK(scene.materials.empty());
        CHECK(scene.parts.at(0).mesh.attributes.empty());
        REQUIRE(log.warnings.size() == 1);
        CHECK(log.warnings[0].id == "W-IMAGE");
        CHECK(log.warnings[0].message == fmt::format("the texture '/3D/Textures/wood.png' {}",
                                                     image.empty()
                                                         ? "is not in the archive"
                                                         : "is neither PNG nor JPEG, and is not kept"));
    }
    const auto [unknown, log] = load(model(R"(<m:compositematerials id="6" matid="4" matindices="0"/>
<m:multiproperties id="7" pids="6"><m:multi pindices="0"/></m:multiproperties>)",
                                           R"(<triangle v1="0" v2="1" v3="2" pid="7" p1="0"/>)"),
                                     "");
    CHECK(unknown.parts.at(0).mesh.attributes.empty()); // no white
    CHECK(log.warnings.at(0).id == "W-SKIPPED");
}
