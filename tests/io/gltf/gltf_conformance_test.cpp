// Checks written files with independent readers: the Khronos validator, and draco_decoder for compressed
// data.
#include "io/codec.hpp"
#include "io/outputs/outputs.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"
#include "support/temporary.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <iostream>

using namespace facetmill;
namespace fs = std::filesystem;

namespace {

/// Whether the tool is installed. If not, the test says so, and fails if the tool is required.
bool available(bool there, const char* what) {
    if (there) return true;
    std::cout << "skipped: " << what << "\n";
    CHECK_FALSE(std::getenv("FACETMILL_REQUIRE_VALIDATOR"));
    return false;
}

int run(const std::string& command) { return std::system(command.c_str()); }

std::string put(const fs::path& folder, const io::Written& written) {
    for (const auto& file : written.files) {
        fs::create_directories((folder / file.name).parent_path());
        io::write_now(folder / file.name, file.bytes);
    }
    return fmt::format(" '{}'", (folder / written.files[0].name).string());
}

/// Textures with transforms and channels of two images, and a face without texture points.
Scene textured_obj() {
    const test::TemporaryDirectory dir;
    test::put(dir / "a.obj",
              "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
              "usemtl m\nf 1/1/1 2/2/1 3/3/1\nf 1//1 3//1 4//1\n");
    test::put(dir / "a.mtl", "newmtl m\nKs 0.5 0.5 0.5\nKe 2 1 0\nmap_Kd -s 2 2 -o 0.5 0 -clamp on red.png\n"
                             "map_d -s 2 2 -o 0.5 0 -clamp on grey.png\nmap_Pr red.png\nmap_Pm grey.png\n"
                             "map_Bump grey.png\nmap_Ke blue.png\n");
    test::put(dir / "red.png", test::red_png());
    test::put(dir / "blue.png", test::blue_png());
    test::put(dir / "grey.png", test::png_of(0, "\x40"));
    io::ReadLog log;
    return io::read_scene(io::Input::open(dir / "a.obj"), {}, log);
}

std::vector<Scene> scenes() {
    std::vector<Scene> all;
    for (const Mesh& mesh :
         {shapes::tetrahedron(), shapes::uv_cube(), shapes::quad_cube(), shapes::torus(8, 6), shapes::fan3(),
          shapes::hourglass(), shapes::folded_quad(), shapes::open_cone(7), Mesh{}})
        all.push_back(test::scene_in_metres(mesh));
    for (const char* name : {"box-textured.glb", "morph-cube/AnimatedMorphCube.gltf", "box-meshopt.glb",
                             "box-draco.glb", "box-ext-mesh-manifold.glb"}) {
        io::ReadLog log;
        all.push_back(io::read_scene(io::Input::open(std::string(FACETMILL_SOURCE_DIR "/tests/data/") + name),
                                     {}, log));
        all.push_back(all.back());
        for (auto& part : all.back().parts) part.changed = true;
    }
    all.push_back(textured_obj());
    all.push_back(test::scene_in_metres(shapes::icosphere(2)));
    for (const int level : {1, 2}) {
        all.back().parts.push_back(test::scene_in_metres(shapes::icosphere(2 - level)).parts[0]);
        all.back().parts.back().name = all.back().parts[0].name + ".lod" + std::to_string(level);
    }
    return all;
}

} // namespace

TEST_CASE("the Khronos validator finds no error in what is written", "[io]") {
    const bool there = run("command -v node >/dev/null") == 0 &&
                       fs::exists(FACETMILL_VALIDATOR_DIR "/node_modules/gltf-validator");
    if (!available(
            there,
            "the Khronos validator is not installed (tests/conformance/setup.sh " FACETMILL_VALIDATOR_DIR
            ")"))
        return;
    const test::TemporaryDirectory folder;
    std::string files;
    int number = 0;
    for (const Scene& scene : scenes())
        for (const char* how : {"plain", "draco", "quantize", "meshopt"})
            for (const bool manifold : {false, true})
                for (const char* codec : {"glb", "gltf"}) {
                    io::WriteSettings settings;
                    settings.draco.on = how == std::string("draco");
                    settings.meshopt.on = how == std::string("meshopt");
                    settings.quantize.on = settings.meshopt.on || how == std::string("quantize");
                    settings.mesh_manifold = manifold;
                    settings.lods.on =
                        number % 2 == 0; // most scenes have no levels, which gives a harmless warning
                    settings.title = "f";
                    files += put(folder / std::to_string(number++), test::written(scene, codec, settings));
                }
    CHECK(run("node '" FACETMILL_SOURCE_DIR "/tests/conformance/validate.mjs' '" FACETMILL_VALIDATOR_DIR "'" +
              files) == 0);
}

TEST_CASE("draco_decoder reads what is compressed", "[io]") {
    if (!available(run("command -v draco_decoder >/dev/null") == 0,
                   "draco_decoder is not installed (package draco)"))
        return;
    io::WriteSettings settings;
    settings.draco.on = true;
    const test::TemporaryDirectory folder;
    for (const Mesh& mesh : {shapes::uv_cube(), shapes::torus(8, 6)}) {
        const Scene glb = test::again(test::scene_in_metres(mesh), settings);
        const Json json = Json::parse(glb.documents[0]->json);
        const Json& primitive = json["meshes"][0]["primitives"][0];
        const auto view =
            primitive["extensions"]["KHR_draco_mesh_compression"]["bufferView"].get<std::size_t>();
        const auto& bytes = glb.documents[0]->buffers[0];
        const std::size_t offset = json["bufferViews"][view].value("byteOffset", std::size_t{0}),
                          size = json["bufferViews"][view]["byteLength"];
        io::write_now(folder / "a.drc", io::Span(bytes).subspan(offset, size));
        REQUIRE(run(fmt::format("draco_decoder -i '{0}/a.drc' -o '{0}/a.obj' >/dev/null",
                                folder.path().string())) == 0);
        io::ReadLog log;
        const Scene obj = io::read_scene(io::Input::open(folder / "a.obj"), {}, log);
        CHECK(obj.face_count() == mesh.face_count());
        CHECK(obj.face_count() * 3 == json["accessors"][primitive["indices"].get<std::size_t>()]["count"]);
    }
}
