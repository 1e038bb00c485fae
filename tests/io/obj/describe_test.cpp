// glTF materials as an MTL library with image files. Materials from an MTL file round-trip exactly, and
// losses of other materials give warnings.
#include "base/hash.hpp"
#include "io/gltf/contents/textures.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>
#include <set>

using namespace facetmill;
using namespace facetmill::test;
namespace fs = std::filesystem;

namespace describe_test {

namespace {

const char* const quad =
    "mtllib a.mtl\no quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl m\nf 1/1 2/2 3/3 4/4\n";

Scene load(const fs::path& path) {
    io::ReadLog log;
    Scene scene = io::read_scene(io::Input::open(path), {}, log);
    INFO(path.string());
    CHECK(log.warnings.empty());
    return scene;
}

void put_images(const fs::path& folder) {
    fs::create_directories(folder);
    put(folder / "red.png", red_png());
    put(folder / "blue.png", blue_png());
    put(folder / "grey.png", png_of(0, "\x40"));
    put(folder / "white.png", png_of(0, "\xff"));
    put(folder / "alpha.png", png_of(6, "\x10\x20\x30\x40"));
}

/// Puts the written files into a folder.
void put_files(const io::Written& written, const fs::path& folder) {
    for (const auto& file : written.files) {
        fs::create_directories((folder / file.name).parent_path());
        put(folder / file.name, std::string(io::as_text(file.bytes)));
    }
}

std::string text_of(const io::Written& written, const std::string& name) {
    for (const auto& file : written.files)
        if (file.name == name) return std::string(io::as_text(file.bytes));
    return "there is no " + name;
}

std::vector<std::string> names_of(const io::Written& written) {
    std::vector<std::string> names;
    for (const auto& file : written.files) names.push_back(file.name.string());
    return names;
}

std::string warnings_of(const io::Written& written) {
    std::string all;
    for (const auto& w : written.warnings) all += w.id + " " + w.message + "\n";
    return all;
}

/// Replaces each texture index by the sampler and the digest of its image.
void resolve(Json& json, const Json& document, const std::vector<io::Bytes>& images) {
    if (!json.is_object()) return;
    for (auto& [key, value] : json.items()) {
        if (key.ends_with("Texture")) {
            const Json texture = document["textures"][value["index"].get<std::size_t>()];
            value["index"] = {document["samplers"][texture["sampler"].get<std::size_t>()],
                              sha256(images[texture["source"].get<std::size_t>()])};
        }
        resolve(value, document, images);
    }
}

/// The materials of a GLB that is written of the scene, with their images.
Json materials_of(const Scene& scene) {
    const Scene read = test::again(scene);
    Json json = Json::parse(read.documents.at(0)->json);
    const auto images = io::image_bytes(*read.documents[0], json);
    Json materials = json["materials"];
    for (Json& material : materials) resolve(material, json, images);
    return materials;
}

/// Declares the extensions that a material uses, as glTF requires.
std::string extensions_used(const std::string& material) {
    std::set<std::string> names;
    const auto collect = [&](const auto& self, const Json& json) -> void {
        if (json.is_object() && json.contains("extensions"))
            for (const auto& [name, content] : json["extensions"].items()) names.insert(name);
        for (const Json& member : json)
            if (member.is_structured()) self(self, member);
    };
    collect(collect, Json::parse("{" + material + "}"));
    return names.empty() ? "" : R"("extensionsUsed":)" + Json(names).dump() + ",";
}

/// A textured triangle of that material; image 0 is the file `uri`, image 1 is in the document.
std::string triangle(const std::string& material, const std::string& uri = "red.png",
                     const std::string& sampler = "{}") {
    return fmt::format(
        R"({{{}"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"name":"t"}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1{}}},"material":0}}]}}],
"materials":[{{"name":"m",{}}}],"samplers":[{}],
"textures":[{{"source":0,"sampler":0}},{{"source":1}}],
"images":[{{"uri":"{}"}},{{"name":"../in it","mimeType":"image/png","uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGMQaPgPAAIzAZDtHsO2AAAAAElFTkSuQmCC"}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}},
{{"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"}}],
"bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":24}},
{{"buffer":0,"byteOffset":36,"byteLength":24}}],
"buffers":[{{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}}]}})",
        extensions_used(material),
        material.find("\"texCoord\":1") == std::string::npos ? "" : R"(,"TEXCOORD_1":2)", material, sampler,
        uri);
}

/// The OBJ output of the triangle.
io::Written obj_of(const TemporaryDirectory& dir, const std::string& material,
                   const std::string& uri = "red.png", const std::string& sampler = "{}") {
    put_images(dir.path());
    put(dir / "t.gltf", triangle(material, uri, sampler));
    return written(load(dir / "t.gltf"), "obj", {.title = "lamp"});
}

const char* const textured = R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0}})";

} // namespace

TEST_CASE("a material of MTL is written so that it is read the same again", "[io]") {
    for (const char* words :
         {"Kd 0.5 0.25 1\nd 0.3\n", "Kd 0.8 0.8 0.8\nKs 0.5 0.25 0.5\nNs 96.078431\nKe 0.5 0 0\nillum 2\n",
          "Kd 1 1 1\nKs 1 1 1\nNs 7.3\nillum 2\n", "Kd 1 1 1\nPr 0.25\nPm 0.75\nKe 2 1 0\n",
          "map_Kd red.png\nmap_Ke blue.png\nnorm -bm 0.5 red.png\n",
          "map_Kd -s 2 4 1 -o 0.25 0.5 -clamp on red.png\nmap_Ke -o 0.5 0 red.png\n",
          "map_Kd alpha.png\nmap_d alpha.png\nd 0.5\n", "map_Kd red.png\nmap_d grey.png\n",
          "map_Ks red.png\n", "Ks 0.5 1 0.5\nNs 30\nmap_Ks red.png\n", "map_Pr grey.png\n",
          "map_Pr grey.png\nmap_Pm white.png\n", "Pr 0.5\nmap_Pr red.png\nmap_Pm red.png\n",
          "map_ORM red.png\n", "map_RMA -clamp on red.png\nPm 0.5\n", "map_Bump grey.png\n"}) {
        INFO(words);
        const TemporaryDirectory dir;
        put_images(dir / "in");
        put(dir / "in/a.obj", quad);
        put(dir / "in/a.mtl", std::string("newmtl m\n") + words);
        const Scene scene = load(dir / "in/a.obj");
        const io::Written obj = written(scene, "obj", {.title = "lamp"});
        CHECK(warnings_of(obj) == "");
        put_files(obj, dir / "out");
        fs::rename(dir / "in", dir / "gone");
        CHECK(materials_of(load(dir / "out/lamp.obj")) == materials_of(scene));
    }
}

TEST_CASE("a material whose both sides are seen stays so through an OBJ", "[io]") {
    const TemporaryDirectory dir;
    const io::Written obj = obj_of(dir, R"("doubleSided":true,"pbrMetallicRoughness":{"metallicFactor":0})");
    CHECK(warnings_of(obj) == "");
    CHECK(text_of(obj, "lamp.mtl").find("# doubleSided: true\n") != std::string::npos);
    put_files(obj, dir / "out");
    const Scene again = load(dir / "out/lamp.obj");
    CHECK(again.materials.at(0).double_sided);
    CHECK(materials_of(again)[0]["doubleSided"] == true);
}

TEST_CASE("materials keep names that MTL does not spell, and that others have, too", "[io]") {
    Scene scene;
    scene.materials = {
        {.name = " dark blue "}, {.name = "red"}, {.name = "red"}, {.name = ""}, {.name = "plain"}};
    Part& part = scene.parts.emplace_back();
    part.name = "cube";
    part.mesh = shapes::cube();
    std::vector<std::uint32_t> of_face;
    for (Index f = 0; f < part.mesh.face_count(); ++f) of_face.push_back(f % 5);
    for (Index m = 0; m < 5; ++m) {
        part.mesh.primitives.push_back({.material = m, .attributes = {}, .json = {}});
        scene.materials[m].base_colour[0] = 0.1 * m;
    }
    part.mesh.attributes.push_back(
        {std::string(primitive_attribute), Domain::face, Role::index, 1, false, of_face});
    const io::Written obj = written(scene, "obj", {.title = "lamp"});
    const std::string mtl = text_of(obj, "lamp.mtl");
    CHECK(mtl.find("newmtl _dark_blue_\n# glTF name:  dark blue \n") != std::string::npos);
    CHECK(mtl.find("newmtl red_2\n# glTF name: red\n") != std::string::npos);
    CHECK(mtl.find("newmtl plain\nKd") != std::string::npos);
    const TemporaryDirectory dir;
    put_files(obj, dir / "out");
    const Scene again = load(dir / "out/lamp.obj");
    REQUIRE(again.materials.size() == 5);
    for (std::size_t m = 0; m < 5; ++m) CHECK(again.materials[m].name == scene.materials[m].name);
}

TEST_CASE("attributes that an OBJ has no place for are told", "[io]") {
    Scene scene;
    Part& part = scene.parts.emplace_back();
    part.mesh = shapes::cube();
    const std::size_t n = part.mesh.vertex_count();
    const auto add = [&](const char* name, Role role, int components, float value) {
        part.mesh.attributes.push_back({name, Domain::wedge, role, components, false,
                                        std::vector<float>(n * static_cast<std::size_t>(components), value)});
    };
    add("TEXCOORD_0", Role::uv, 2, 0.5F);
    add("NORMAL", Role::normal, 3, 1);
    add("TANGENT", Role::tangent, 4, 1);
    add("COLOR_0", Role::colour, 4, 1);
    CHECK(warnings_of(written(scene, "obj")) == "");
    add("TEXCOORD_1", Role::uv, 2, 0.5F);
    add("_HEAT", Role::generic, 1, 0.5F);
    part.mesh.attributes[3].data = std::vector<float>(4 * n, 0.5F);
    CHECK(warnings_of(written(scene, "obj"))
              .find("OBJ cannot store attributes: alpha of COLOR_0, TEXCOORD_1, _HEAT") != std::string::npos);
    Scene seams;
    seams.parts.emplace_back().mesh = shapes::uv_cube();
    Mesh& mesh = seams.parts[0].mesh;
    std::vector<float> colours(3 * mesh.wedge_count(), 0.5F);
    mesh.attributes.push_back({"COLOR_0", Domain::wedge, Role::colour, 3, false, colours});
    CHECK(warnings_of(written(seams, "obj")) == "");
    colours[0] = 1;
    mesh.attributes.back().data = colours;
    CHECK(warnings_of(written(seams, "obj")).find("COLOR_0 that differs between faces at a vertex") !=
          std::string::npos);
}

TEST_CASE("one material for faces with and without texture points is one again", "[io]") {
    const TemporaryDirectory dir;
    put_images(dir / "in");
    const std::string mixed = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                              "usemtl m\nf 1/1 2/2 3/3\nf 3 2 1\n";
    const auto names_in = [](const std::string& mtl) {
        std::vector<std::string> names;
        for (std::size_t at = 0; (at = mtl.find("newmtl ", at)) != std::string::npos; ++at)
            names.push_back(mtl.substr(at + 7, mtl.find('\n', at) - at - 7));
        return names;
    };
    using Names = std::vector<std::string>;
    const auto both = [&](const std::string& words) {
        put(dir / "in/a.obj", mixed);
        put(dir / "in/a.mtl", "newmtl m\n" + words);
        const Scene scene = load(dir / "in/a.obj");
        CHECK(scene.materials.size() == 2); // as glTF has no texture without coordinates
        const io::Written obj = written(scene, "obj", {.title = "lamp"});
        put_files(obj, dir / "out");
        CHECK(load(dir / "out/lamp.obj").materials.size() == 2);
        return names_in(text_of(obj, "lamp.mtl"));
    };
    CHECK(both("Kd 0.5 0.5 1\nmap_Kd red.png\n") == Names{"m"});
    CHECK(both("Kd 1 1 1\nd 0.5\nmap_Kd red.png\nmap_Pr grey.png\nnorm red.png\n") == Names{"m"});
    // Black means white with a texture, and black without a texture.
    CHECK(both("Kd 0 0 0\nmap_Kd red.png\n") == Names{"m", "m_2"});
}

TEST_CASE("a GLB keeps its materials and images through an OBJ", "[io]") {
    const TemporaryDirectory dir;
    const io::Written obj = obj_of(
        dir,
        R"("alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,0.5],"baseColorTexture":
{"index":0,"extensions":{"KHR_texture_transform":{"scale":[2,0.5],"offset":[0.25,0.125]}}},"metallicFactor":0.5,
"metallicRoughnessTexture":{"index":1},"roughnessFactor":0.75},"occlusionTexture":{"index":1},"normalTexture":
{"index":1,"scale":0.5},"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0})",
        "alpha.png", R"({"wrapS":33071,"wrapT":33071})");
    CHECK(warnings_of(obj) == "");
    CHECK(names_of(obj) ==
          std::vector<std::string>{"lamp.obj", "lamp.mtl", "lamp.alpha.png", "lamp..._in_it.png"});
    CHECK(text_of(obj, "lamp.mtl") == R"(# written by facetmill
newmtl m
Kd 0.5 0.25 1
d 0.5
Ke 1 1 1
Pr 0.75
Pm 0.5
map_Kd -s 2 0.5 1 -o 0.25 0.375 0 -clamp on lamp.alpha.png
map_d -s 2 0.5 1 -o 0.25 0.375 0 -clamp on lamp.alpha.png
map_Ke -clamp on lamp.alpha.png
map_Pr lamp..._in_it.png
map_Pm lamp..._in_it.png
map_ORM lamp..._in_it.png
norm -bm 0.5 lamp..._in_it.png
)");
    put_files(obj, dir / "out");
    Json before = Json::parse(load(dir / "t.gltf").documents.at(0)->json)["materials"][0];
    const Json after = materials_of(load(dir / "out/lamp.obj"))[0];
    for (const char* key : {"alphaMode", "emissiveFactor"}) CHECK(after[key] == before[key]);
    CHECK(after["normalTexture"]["scale"] == 0.5);
    const Json pbr = after["pbrMetallicRoughness"], &old = before["pbrMetallicRoughness"];
    for (const char* key : {"baseColorFactor", "metallicFactor", "roughnessFactor"})
        CHECK(pbr[key] == old[key]);
    const Json moved = pbr["baseColorTexture"]["extensions"]["KHR_texture_transform"];
    CHECK(moved["scale"] == Json({2, 0.5}));
    CHECK(moved["offset"] == Json({0.25, 0.125}));
    CHECK(after["occlusionTexture"]["index"] == pbr["metallicRoughnessTexture"]["index"]);
}

TEST_CASE("what MTL cannot say of a material is said", "[io]") {
    const TemporaryDirectory dir;
    const auto told = [&](const std::string& material, const std::string& sampler = "{}") {
        return warnings_of(obj_of(dir, material, "red.png", sampler));
    };
    const std::string start = "W-TEXTURES textures are not written to OBJ: of m: ";
    CHECK(told(textured) == "");
    CHECK(told(R"("occlusionTexture":{"index":0})") == start + "occlusionTexture (MTL has no map of it)\n");
    CHECK(told(R"("normalTexture":{"index":0,"texCoord":1})")
              .find(start + "normalTexture (it does not use the first set") != std::string::npos);
    CHECK(told(R"("normalTexture":{"index":0,"extensions":{"KHR_texture_transform":{"rotation":1}}})")
              .find(start + "normalTexture (it is rotated") == 0);
    CHECK(told(R"("emissiveTexture":{"index":0})") == start + "emissiveTexture (its factor is black)\n");
    CHECK(told(R"("pbrMetallicRoughness":{"roughnessFactor":0,"metallicRoughnessTexture":{"index":0}})")
              .find(start + "metallicRoughnessTexture (roughnessFactor is 0") == 0);
    CHECK(told(textured, R"({"wrapS":33648})").find(start + "the wrapping of baseColorTexture") == 0);
    CHECK(told(textured, R"({"magFilter":9728})").find(start + "the filter of baseColorTexture") == 0);
    CHECK(told(std::string(R"("alphaMode":"MASK","alphaCutoff":0.75,)") + textured) == "");
    CHECK(told(R"("alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25]})") ==
          "W-MTL MTL cannot represent all of materials: of m: alphaMode MASK (it is blended)\n");
    CHECK(told(R"("extensions":{"KHR_materials_clearcoat":{"clearcoatTexture":{"index":0}}})") ==
          start + "clearcoatTexture (MTL has no map of it)\nW-MTL MTL cannot represent all of materials: of "
                  "m: KHR_materials_clearcoat (MTL has no statement for it)\n");
    CHECK(told(R"("extensions":{"KHR_materials_specular":{"specularColorFactor":[0.5,1,1]}})")
              .find("of m: specularColorFactor (MTL cannot combine it with Pr and Pm)") != std::string::npos);
    // Properties that remain visible are written.
    const io::Written masked = obj_of(dir, std::string(R"("alphaMode":"MASK",)") + textured, "alpha.png");
    CHECK(warnings_of(masked).find("W-MTL") == 0);
    CHECK(text_of(masked, "lamp.mtl").find("map_d lamp.alpha.png") != std::string::npos);
}

TEST_CASE("alpha that glTF does not look at makes no OBJ transparent", "[io]") {
    const TemporaryDirectory dir;
    const std::string mtl = text_of(
        obj_of(dir,
               R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25],"baseColorTexture":{"index":0}})",
               "alpha.png"),
        "lamp.mtl");
    CHECK(mtl.find("\nd 1\n") != std::string::npos);
    CHECK(mtl.find("map_d") == std::string::npos);
}

TEST_CASE("images beside an OBJ have names that stand in a line, below its folder", "[io]") {
    const TemporaryDirectory dir;
    fs::create_directories(dir / "in/sub folder");
    put(dir / "up.png", blue_png());
    put(dir / "in/sub folder/-b #1 \xc3\xa4.png", red_png());
    put(dir / "in/t.gltf", triangle(textured, "sub%20folder/-b%20%231%20%C3%A4.png"));
    const io::Written obj = written(load(dir / "in/t.gltf"), "obj", {.title = "my lamp"});
    CHECK(names_of(obj) ==
          std::vector<std::string>{"my lamp.obj", "my lamp.mtl", "sub_folder/my_lamp._b__1_\xc3\xa4.png"});
    put_files(obj, dir / "out");
    CHECK(load(dir / "out/my lamp.obj").documents.at(0)->files.size() == 1);

    put(dir / "in/t.gltf", triangle(textured, "../up.png"));
    io::ReadLog log;
    io::ReadSettings allowed;
    allowed.asset_roots = {dir.path()};
    const Scene scene = io::read_scene(io::Input::open(dir / "in/t.gltf"), allowed, log);
    CHECK(names_of(written(scene, "obj", {.title = "lamp"})).back() == "lamp.up.png");
    CHECK(text_of(
              written(scene, "obj",
                      {.title = "lamp", .textures = io::Textures::reference, .directory = dir / "out/deep"}),
              "lamp.mtl")
              .find("map_Kd ../../up.png\n") != std::string::npos);
    // An embedded image has no other location.
    put(dir / "in/t.gltf", triangle(R"("normalTexture":{"index":1})", "../up.png"));
    const Scene inside = io::read_scene(io::Input::open(dir / "in/t.gltf"), allowed, log);
    CHECK(names_of(written(inside, "obj", {.title = "lamp", .textures = io::Textures::reference})).back() ==
          "lamp..._in_it.png");
}

TEST_CASE("images of textures that MTL has no words for are files beside an OBJ like the others", "[io]") {
    const TemporaryDirectory dir;
    const std::vector<std::string> with_image{"lamp.obj", "lamp.mtl", "lamp.red.png"};
    CHECK(names_of(obj_of(dir, R"("occlusionTexture":{"index":0})")) == with_image);
    CHECK(names_of(obj_of(dir, R"("emissiveTexture":{"index":0})")) == with_image);
    CHECK(names_of(
              obj_of(dir, R"("extensions":{"KHR_materials_clearcoat":{"clearcoatTexture":{"index":0}}})")) ==
          with_image);
    // References to missing textures yield no files.
    CHECK(
        names_of(obj_of(
            dir, R"("extensions":{"A_B":{"aTexture":{"index":9},"bTexture":{"index":-1},"cTexture":3}})")) ==
        std::vector<std::string>{"lamp.obj", "lamp.mtl"});
}

TEST_CASE("a file that a line of MTL cannot name is not referred to", "[io]") {
    const TemporaryDirectory dir;
    const auto referring = [&](const std::string& name, const std::string& uri) {
        put(dir / name, red_png());
        put(dir / "t.gltf", triangle(textured, uri));
        return written(load(dir / "t.gltf"), "obj",
                       {.title = "lamp", .textures = io::Textures::reference, .directory = dir.path()});
    };
    for (const auto& [name, uri] : {std::pair("-s 2 red.png", "-s%202%20red.png"),
                                    {"red.png ", "red.png%20"},
                                    {"a\nnewmtl b.png", "a%0Anewmtl%20b.png"}}) {
        INFO(uri);
        const io::Written obj = referring(name, uri);
        CHECK(text_of(obj, "lamp.mtl").find("map_Kd") == std::string::npos);
        CHECK(warnings_of(obj).find("W-TEXTURES textures are not written to OBJ: of m: baseColorTexture (MTL "
                                    "cannot store the name") == 0);
    }
    const io::Written obj = referring("a #1 b.png", "a%20%231%20b.png");
    CHECK(text_of(obj, "lamp.mtl").find("map_Kd a #1 b.png\n") != std::string::npos);
    CHECK(warnings_of(obj) == "");
}

TEST_CASE("materials of one name and an image that is not there", "[io]") {
    const TemporaryDirectory dir;
    put_images(dir.path());
    Json json = Json::parse(triangle(textured));
    json["materials"].push_back(json["materials"][0]);
    json["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
    json["meshes"][0]["primitives"].push_back(json["meshes"][0]["primitives"][0]);
    json["meshes"][0]["primitives"][1]["material"] = 1;
    put(dir / "t.gltf", json.dump());
    const std::string mtl = text_of(written(load(dir / "t.gltf"), "obj", {.title = "lamp"}), "lamp.mtl");
    CHECK(mtl.find("newmtl m\n") != std::string::npos);
    CHECK(mtl.find("newmtl m_2\n") != std::string::npos);
    CHECK(mtl.find("map_Kd lamp.red.png\n") < mtl.find("map_Kd lamp..._in_it.png\n"));

    // If there are many, a warning lists a few.
    json["images"][0]["uri"] = "gone.png";
    for (int i = 1; i < 20; ++i) {
        json["materials"][i] = json["materials"][0];
        json["materials"][i]["name"] = fmt::format("m{}", i);
        json["meshes"][0]["primitives"][i] = json["meshes"][0]["primitives"][0];
        json["meshes"][0]["primitives"][i]["material"] = i;
    }
    put(dir / "t.gltf", json.dump());
    io::ReadLog log;
    CHECK(warnings_of(written(io::read_scene(io::Input::open(dir / "t.gltf"), {}, log), "obj"))
              .find("of m, m1, m2, m3, m4, m5, m6, m7 and 12 more: baseColorTexture") != std::string::npos);

    put(dir / "t.gltf", triangle(textured, "gone.png"));
    const io::Written gone = written(io::read_scene(io::Input::open(dir / "t.gltf"), {}, log), "obj");
    CHECK(warnings_of(gone) ==
          "W-TEXTURES textures are not written to OBJ: of m: baseColorTexture (its image is missing)\n");
    put(dir / "t.gltf", triangle(textured, "b.png"));
    put(dir / "b.png", red_png().substr(0, 40));
    CHECK(warnings_of(written(load(dir / "t.gltf"), "obj"))
              .find("W-IMAGE the image \"out.b.png\" is written unchanged") == 0);
}

} // namespace describe_test
