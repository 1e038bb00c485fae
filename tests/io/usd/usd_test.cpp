#include "support/catch.hpp"

#include "io/threemf/zip.hpp"
#include "mesh/shapes.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

namespace usd_test {

using namespace facetmill;
using namespace facetmill::test;

namespace {

std::uint64_t number_at(const io::Bytes& bytes, std::size_t at, int size) {
    return io::little_endian(bytes, at, size);
}

std::string text_of(const io::Bytes& bytes) { return std::string(io::as_text(bytes)); }

std::string layer_of(const io::Bytes& usdz) {
    return text_of(io::threemf::Archive(usdz, "x.usdz").file("/out.usda").value());
}

Scene in_metres(Mesh mesh) {
    Scene scene = scene_of(std::move(mesh), Unit::m);
    scene.up = UpAxis::y;
    scene.parts[0].name = "part";
    return scene;
}

} // namespace

TEST_CASE("an aligned zip stores its files at multiples of 64 bytes", "[io][usd]") {
    std::vector<io::threemf::ArchiveFile> files;
    for (std::size_t size = 0; size < 130; ++size)
        files.push_back(
            {std::string(1 + size % 67, 'n') + std::to_string(size), io::Bytes(size, std::byte{7})});
    const io::Bytes zip = io::threemf::make_archive(files, 64);
    std::size_t at = 0;
    for (const auto& file : files) {
        CHECK(number_at(zip, at, 4) == 0x04034b50);
        CHECK(number_at(zip, at + 8, 2) == 0); // stored
        const std::size_t name = number_at(zip, at + 26, 2), extra = number_at(zip, at + 28, 2);
        const std::size_t data = at + 30 + name + extra;
        CHECK(data % 64 == 0);
        if (extra > 0) CHECK(number_at(zip, at + 30 + name + 2, 2) == extra - 4);
        CHECK(number_at(zip, at + 18, 4) == file.bytes.size());
        at = data + file.bytes.size();
    }
    CHECK(number_at(zip, at, 4) == 0x02014b50);
    io::threemf::Archive back(zip, "a.zip");
    for (const auto& file : files) CHECK(back.file("/" + file.path) == file.bytes);
}

TEST_CASE("a USDZ is a package of one text layer in metres with y up", "[io][usd]") {
    const Scene scene = in_metres(shapes::cube());
    const io::Bytes usdz = written(scene, "usdz").files.at(0).bytes;
    CHECK(usdz == written(scene, "usdz").files.at(0).bytes);
    CHECK(io::threemf::Archive(usdz, "x.usdz").paths() == std::vector<std::string>{"out.usda"});
    const std::string layer = layer_of(usdz);
    for (const char* text :
         {"#usda 1.0\n", "defaultPrim = \"out\"", "metersPerUnit = 1\n", "upAxis = \"Y\"\n",
          "def Xform \"out\"", "def Xform \"part\"", "subdivisionScheme = \"none\""})
        CHECK(layer.find(text) != layer.npos);
    const Scene back = read_bytes(usdz, "usdz");
    REQUIRE(back.parts.size() == 1);
    CHECK(back.parts[0].name == "part");
    CHECK(back.parts[0].mesh.positions.size() == 8);
    CHECK(back.face_count() == 12);
}

TEST_CASE("parts with the same mesh share it in USDZ, where they are", "[io][usd]") {
    const Scene scene = read_text(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"mesh": 0, "name": "2. \"other\"", "translation": [0.1, 0, 0], "scale": [1, -2, 1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 0]}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri":
            "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    const io::Bytes usdz = written(scene, "usdz").files.at(0).bytes;
    const std::string layer = layer_of(usdz);
    const std::size_t first = layer.find("point3f[] points");
    CHECK(first != layer.npos);
    CHECK(layer.find("point3f[] points", first + 1) == layer.npos);
    CHECK(layer.find(R"(string name = "2. \"other\"")") != layer.npos);
    const Scene back = read_bytes(usdz, "usdz");
    REQUIRE(back.parts.size() == 2);
    CHECK(back.bounds().min == scene.bounds().min);
    CHECK(back.bounds().max == scene.bounds().max);
}

TEST_CASE("USDZ keeps a textured material", "[io][usd]") {
    io::ReadLog log;
    const Scene scene =
        io::read_scene(io::Input::open(FACETMILL_SOURCE_DIR "/tests/data/box-textured.glb"), {}, log);
    const auto file = written(scene, "usdz");
    const std::string layer = layer_of(file.files.at(0).bytes);
    for (const char* text :
         {"uniform token info:id = \"UsdPreviewSurface\"", "asset inputs:file = @textures/",
          "token inputs:sourceColorSpace = \"sRGB\"", "primvars:st = [", "rel material:binding"})
        CHECK(layer.find(text) != layer.npos);
    CHECK(io::threemf::Archive(file.files.at(0).bytes, "x").paths().size() == 2);
}

TEST_CASE("USDZ files that other programs wrote or that are damaged are refused", "[io][usd]") {
    const auto refused = [](std::string_view layer) {
        const io::Bytes zip = io::threemf::make_archive({{"a.usda", to_bytes(layer)}}, 64);
        return failure([&] { static_cast<void>(read_bytes(zip, "usdz")); });
    };
    for (const char* layer :
         {"PXR-USDC", "#usda 1.0\n}", "#usda 1.0\ndef Xform \"a\"\n{\n", "#usda 1.0\n(",
          "#usda 1.0\ndef Xform \"a\" (\n", "#usda 1.0\ndef Xform \"a\\", "#usda 1.0\ndef Mesh",
          "#usda 1.0\nint a = 3\n",
          "#usda 1.0\ndef Xform \"a\"\n{\ndef Mesh \"m\"\n{\npoint3f[] points = [(0, 0, 0)]\n"
          "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 0, 1]\n}\n}\n"})
        CHECK(refused(layer).find("E-USDZ") != std::string::npos);
}

} // namespace usd_test
