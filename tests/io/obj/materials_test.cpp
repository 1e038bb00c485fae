// MTL libraries as glTF materials, with their textures.
#include "io/convert.hpp"
#include "io/images/pixels.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

#include <cmath>
#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;
namespace fs = std::filesystem;

namespace {

const char* const quad = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                         "usemtl m\nf 1/1 2/2 3/3 4/4\n";

struct Loaded {
    Scene scene;
    io::ReadLog log;

    /// The material m of a GLB that is written of it.
    Json material() const { return document()["materials"].at(0); }
    Json document() const { return Json::parse(json_of(written(scene, "glb").files.at(0).bytes)); }
    std::string warnings() const {
        std::string all;
        for (const auto& w : log.warnings) all += w.id + " " + w.message + "\n";
        return all;
    }
};

Loaded load(const fs::path& path) {
    Loaded loaded;
    loaded.scene = io::read_scene(io::Input::open(path), {}, loaded.log);
    CHECK(broken_invariants(loaded.scene).empty());
    return loaded;
}

/// A quad with the material m from this text, with image files.
Loaded load_quad(const TemporaryDirectory& dir, const std::string& words, const std::string& obj = quad) {
    put(dir / "a.obj", obj);
    put(dir / "a.mtl", "newmtl m\n" + words);
    put(dir / "red.png", red_png());
    put(dir / "blue.png", blue_png());
    put(dir / "grey.png", png_of(0, "\x40"));
    put(dir / "white.png", png_of(0, "\xff"));
    put(dir / "alpha.png", png_of(6, "\x10\x20\x30\x40"));
    return load(dir / "a.obj");
}

} // namespace

TEST_CASE("a transparent MTL material is drawn transparent", "[io]") {
    const TemporaryDirectory dir;
    for (const char* words : {"Kd 0.5 0.25 1\nd 0.3\n", "Kd 0.5 0.25 1\nTr 0.7\n"}) {
        const Json m = load_quad(dir, words).material();
        CHECK(m["alphaMode"] == "BLEND");
        CHECK(m["pbrMetallicRoughness"]["baseColorFactor"][0] == 0.5);
        CHECK(m["pbrMetallicRoughness"]["baseColorFactor"][3].get<double>() == Approx(0.3));
        CHECK(m["pbrMetallicRoughness"]["metallicFactor"] == 0);
    }
    CHECK_FALSE(load_quad(dir, "Kd 1 1 1\nd 1\n").material().contains("alphaMode"));
    // MeshLab writes this for opaque materials.
    CHECK_FALSE(load_quad(dir, "Kd 1 1 1\nTr 1\n").material().contains("alphaMode"));
}

TEST_CASE("MTL highlights, light and physical words are kept", "[io]") {
    const TemporaryDirectory dir;
    Json m = load_quad(dir, "Kd 1 1 1\nKs 0.5 0.25 0.5\nNs 30\nKe 0.5 0 0\nillum 2\n").material();
    CHECK(m["pbrMetallicRoughness"]["roughnessFactor"] == 0.5); // (2 / 32)^(1/4)
    CHECK(m["extensions"]["KHR_materials_specular"]["specularColorFactor"] == Json({0.5, 0.25, 0.5}));
    CHECK(m["emissiveFactor"] == Json({0.5, 0, 0}));
    // A model without highlights is rough, whatever the value of Ns.
    m = load_quad(dir, "Kd 1 1 1\nKs 1 1 1\nNs 30\nillum 1\n").material();
    CHECK_FALSE(m["pbrMetallicRoughness"].contains("roughnessFactor"));
    CHECK_FALSE(m.contains("extensions"));
    m = load_quad(dir, "Kd 1 1 1\nKs 1 1 1\nNs 30\nPr 0.25\nPm 0.75\nKe 2 1 0\n").material();
    CHECK(m["pbrMetallicRoughness"]["roughnessFactor"] == 0.25);
    CHECK(m["pbrMetallicRoughness"]["metallicFactor"] == 0.75);
    CHECK(m["emissiveFactor"] == Json({1, 0.5, 0}));
    CHECK(m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] == 2);
    CHECK(m["extensions"].size() == 1);
}

TEST_CASE("a textured OBJ is a textured GLB", "[io]") {
    const TemporaryDirectory dir;
    const Loaded loaded = load_quad(dir, "Kd 1 1 1\nmap_Kd red.png\nmap_Ke blue.png\nnorm -bm 0.5 red.png\n");
    CHECK(loaded.warnings().empty());
    std::vector<fs::path> read;
    for (const auto& file : loaded.log.files) read.push_back(file.path);
    CHECK(read == std::vector<fs::path>{dir / "a.mtl", dir / "red.png", dir / "blue.png"});
    const Json all = loaded.document(), m = all["materials"].at(0);
    REQUIRE(all["images"].size() == 2);
    const auto image_of = [&](const Json& texture) {
        return all["images"]
                  [all["textures"][texture["index"].get<std::size_t>()]["source"].get<std::size_t>()];
    };
    CHECK(image_of(m["pbrMetallicRoughness"]["baseColorTexture"])["name"] == "red");
    CHECK(image_of(m["emissiveTexture"])["name"] == "blue");
    CHECK(image_of(m["emissiveTexture"])["mimeType"] == "image/png");
    CHECK(m["emissiveFactor"] == Json({1, 1, 1}));
    CHECK(image_of(m["normalTexture"])["name"] == "red");
    CHECK(m["normalTexture"]["scale"] == 0.5);
    // The textures are still present after reading it back.
    CHECK(test::again(loaded.scene).documents.at(0)->json.find("baseColorTexture") != std::string::npos);
}

TEST_CASE("options of MTL textures are kept", "[io]") {
    const TemporaryDirectory dir;
    const Loaded loaded = load_quad(
        dir, "map_Kd -s 2 4 1 -o 0.25 0.5 -clamp on -blendu off red.png\nmap_Ke -mm 0.1 2 red.png\n");
    const Json all = loaded.document(),
               texture = all["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    const Json transform = texture["extensions"]["KHR_texture_transform"];
    CHECK(transform["scale"] == Json({2, 4}));
    CHECK(transform["offset"] == Json({0.25, -3.5}));
    // At the quad's corner (1, 1), OBJ reads the texture at (2.25, 4.5), from the bottom. From the top this
    // is -3.5, where glTF reads at (1, 0).
    CHECK(1 - 4.5 == transform["offset"][1].get<double>() + 4 * 0.0);
    const Json sampler =
        all["samplers"][all["textures"][texture["index"].get<std::size_t>()]["sampler"].get<std::size_t>()];
    CHECK(sampler["wrapS"] == 33071);
    CHECK(all["extensionsUsed"] == Json::array({"KHR_texture_transform"}));
    CHECK(loaded.warnings() == "W-MTL material 'm': glTF cannot represent -mm\n");
}

TEST_CASE("opacity, roughness, metalness and relief go where glTF has them", "[io]") {
    const TemporaryDirectory dir;
    const auto pixel_of = [](const Loaded& loaded, const Json& texture) {
        const Json all = Json::parse(loaded.scene.documents.at(0)->json);
        const std::string uri =
            all["images"][all["textures"][texture["index"].get<std::size_t>()]["source"].get<std::size_t>()]
               ["uri"];
        const auto pixels = io::decoded_image(loaded.scene.documents[0]->files.at(uri));
        return pixels.value().rgba;
    };
    const auto material_of = [](const Loaded& loaded) {
        CHECK(loaded.warnings().empty());
        return Json::parse(loaded.scene.documents.at(0)->json)["materials"].at(0);
    };
    using Rgba = std::vector<std::uint8_t>;

    // An image that already has the opacity is used unchanged.
    Loaded loaded = load_quad(dir, "map_Kd alpha.png\nmap_d alpha.png\n");
    Json m = material_of(loaded);
    CHECK(m["alphaMode"] == "BLEND");
    CHECK(loaded.scene.documents[0]->files.count("alpha.png") == 1);
    CHECK(loaded.scene.documents[0]->files.size() == 1);
    loaded = load_quad(dir, "map_Kd red.png\nmap_d grey.png\n");
    m = material_of(loaded);
    CHECK(m["alphaMode"] == "BLEND");
    CHECK(pixel_of(loaded, m["pbrMetallicRoughness"]["baseColorTexture"]) == Rgba{0xff, 0x10, 0x10, 0x40});

    // Grey for the roughness alone needs no change, because the blue channel is not used without metal.
    loaded = load_quad(dir, "map_Pr grey.png\n");
    m = material_of(loaded);
    CHECK(m["pbrMetallicRoughness"]["roughnessFactor"] == 1);
    CHECK(m["pbrMetallicRoughness"]["metallicFactor"] == 0);
    CHECK(loaded.scene.documents[0]->files.count("grey.png") == 1);
    loaded = load_quad(dir, "map_Pr grey.png\nmap_Pm white.png\n");
    m = material_of(loaded);
    CHECK(m["pbrMetallicRoughness"]["metallicFactor"] == 1);
    CHECK(pixel_of(loaded, m["pbrMetallicRoughness"]["metallicRoughnessTexture"]) ==
          Rgba{255, 0x40, 255, 255});
    loaded = load_quad(dir, "map_RMA alpha.png\n"); // roughness 0x10, metalness 0x20, occlusion 0x30
    m = material_of(loaded);
    CHECK(pixel_of(loaded, m["occlusionTexture"]) == Rgba{0x30, 0x10, 0x20, 255});
    m = material_of(load_quad(dir, "map_ORM red.png\n"));
    CHECK(m["occlusionTexture"]["index"] == m["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"]);

    // A grey map_Bump is a relief, here a flat one; others hold normals.
    loaded = load_quad(dir, "map_Bump -bm 2 grey.png\n");
    m = material_of(loaded);
    CHECK(pixel_of(loaded, m["normalTexture"]) == Rgba{128, 128, 255, 255});
    CHECK_FALSE(m["normalTexture"].contains("scale"));
    m = material_of(load_quad(dir, "map_Bump -bm 2 red.png\n"));
    CHECK(m["normalTexture"]["scale"] == 2);

    loaded = load_quad(dir, "map_Kd red.png\nmap_d -s 2 2 grey.png\n");
    CHECK(loaded.warnings().find("W-MTL material 'm': the opacity of map_d \"grey.png\" is not kept") == 0);
}

TEST_CASE("textures are read from below the OBJ's folder only, and missing ones are said", "[io]") {
    const TemporaryDirectory dir;
    fs::create_directories(dir / "in/maps");
    put(dir / "secret.png", red_png());
    put(dir / "in/maps/a.mtl", "newmtl m\nmap_Kd ..\\red.png\nmap_Ke ../../secret.png\nnorm gone.png\n");
    put(dir / "in/red.png", red_png());
    put(dir / "in/a.obj", "mtllib maps/a.mtl\n" + std::string(quad).substr(13));
    const Loaded loaded = load(dir / "in/a.obj");
    CHECK(loaded.material()["pbrMetallicRoughness"].contains("baseColorTexture"));
    CHECK_FALSE(loaded.material().contains("emissiveTexture"));
    REQUIRE(loaded.log.warnings.size() == 2);
    CHECK(loaded.warnings().find("secret.png\" is not a file in the directory") != std::string::npos);
    CHECK(loaded.warnings().find("the file \"" + (dir / "in/maps/gone.png").string() + "\" is missing") !=
          std::string::npos);
    put(dir / "a.obj", quad);
    put(dir / "a.mtl", "newmtl m\nmap_Kd photo.tga\n");
    put(dir / "photo.tga", "no PNG");
    CHECK(load(dir / "a.obj").warnings().find("neither PNG nor JPEG") != std::string::npos);
}

TEST_CASE("an OBJ may name several libraries, in one statement or in several", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "a.mtl", "newmtl red\nKd 1 0 0\n");
    put(dir / "b b.mtl", "newmtl blue\nKd 0 0 1\n");
    put(dir / "none.mtl", "newmtl\nKd 0 1 0\n"); // without a name
    const std::string faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 3 2 1\n";
    for (const std::string libraries :
         {"mtllib a.mtl b b.mtl\n", "mtllib b b.mtl a.mtl\n", "mtllib a.mtl\nmtllib b b.mtl\n"}) {
        INFO(libraries);
        put(dir / "a.obj", libraries + faces);
        const Loaded loaded = load(dir / "a.obj");
        CHECK(loaded.warnings().empty());
        REQUIRE(loaded.scene.materials.size() == 2);
        CHECK(loaded.scene.materials[0].base_colour[0] == 1);
        CHECK(loaded.scene.materials[1].base_colour[2] == 1);
        CHECK(loaded.log.files.size() == 2);
    }
    // Faces before the first usemtl have no material; usemtl without a name means the one without a name.
    put(dir / "a.obj", "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl\nf 3 2 1\n");
    const Loaded unnamed = load(dir / "a.obj");
    REQUIRE(unnamed.scene.materials.size() == 1);
    CHECK(unnamed.scene.materials[0].name.empty());
    CHECK(unnamed.scene.materials[0].base_colour[1] == 1);
    const auto& primitives = unnamed.scene.parts.at(0).mesh.primitives;
    REQUIRE(primitives.size() == 2);
    CHECK(primitives[0].material == none);
    CHECK(primitives[1].material == 0);
}

TEST_CASE("black beside a texture does not blacken it", "[io]") {
    const TemporaryDirectory dir;
    const Json m = load_quad(dir, "Kd 0 0 0\nmap_Kd red.png\nKe 0 0 0\nmap_Ke red.png\n").material();
    CHECK(m["pbrMetallicRoughness"]["baseColorFactor"] == Json({1, 1, 1, 1}));
    CHECK(m["emissiveFactor"] == Json({1, 1, 1}));
    CHECK(load_quad(dir, "Kd 0 0 0\n").material()["pbrMetallicRoughness"]["baseColorFactor"] ==
          Json({0, 0, 0, 1}));
}

TEST_CASE("faces of an OBJ without texture points get none, and no textures", "[io]") {
    const TemporaryDirectory dir;
    const std::string two = std::string(quad) + "f 4 3 2 1\n";
    const Loaded loaded = load_quad(dir, "Kd 0.5 0.5 0.5\nmap_Kd red.png\n", two);
    const Json all = loaded.document(), primitives = all["meshes"][0]["primitives"];
    REQUIRE(primitives.size() == 2);
    CHECK(primitives[0]["attributes"].contains("TEXCOORD_0"));
    CHECK_FALSE(primitives[1]["attributes"].contains("TEXCOORD_0"));
    const auto pbr = [&](std::size_t p) {
        return all["materials"][primitives[p]["material"].get<std::size_t>()]["pbrMetallicRoughness"];
    };
    CHECK(pbr(0).contains("baseColorTexture"));
    CHECK_FALSE(pbr(1).contains("baseColorTexture"));
    CHECK(pbr(1)["baseColorFactor"][0] == 0.5);

    // The same through OBJ.
    const io::Written obj = written(loaded.scene, "obj");
    const std::string text(io::as_text(obj.files[0].bytes));
    CHECK(text.find("/") != std::string::npos);
    CHECK(text.find("\nf 4 3 2 1\n") != std::string::npos);

    // A separate object without texture points has no such attribute.
    const std::string objects = "o one\n" + std::string(quad) + "o two\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 5 6 7\n";
    const Loaded parts = load_quad(dir, "map_Kd red.png\n", objects);
    REQUIRE(parts.scene.parts.size() == 2);
    CHECK(parts.scene.parts[0].mesh.find("TEXCOORD_0", Domain::wedge));
    CHECK_FALSE(parts.scene.parts[1].mesh.find("TEXCOORD_0", Domain::wedge));
    CHECK(parts.scene.parts[1].mesh.primitives.at(0).attributes.empty());
}

TEST_CASE("a textured OBJ beside a glTF keeps both", "[stages]") {
    const TemporaryDirectory dir;
    Loaded obj = load_quad(dir, "map_Kd red.png\n");
    io::ReadLog log;
    const Scene box = io::read_scene(
        io::Input::of("box.glb", written(scene_in_metres(shapes::cube(), "box"), "glb").files[0].bytes), {},
        log);
    Scene scene = obj.scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::y;
    io::add_scene(scene, box);
    const Json all = Json::parse(json_of(written(scene, "glb").files[0].bytes));
    CHECK(all["nodes"].size() == 2);
    CHECK(all["nodes"][0]["name"] == "box"); // the document that has nodes is the one that is patched
    CHECK(all["images"].size() == 1);
    CHECK(all["materials"].at(0)["pbrMetallicRoughness"].contains("baseColorTexture"));
}
