// The textures that PLY files name in comments.
#include "base/hash.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

std::string ply(const std::string& comments, const std::string& faces, bool numbered) {
    return "ply\nformat ascii 1.0\n" + comments +
           "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
           "property list uchar int vertex_indices\nproperty list uchar float texcoord\n" +
           (numbered ? "property int texnumber\n" : "") + "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces;
}

} // namespace

TEST_CASE("a textured PLY is a textured GLB", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "red.png", red_png());
    put(dir / "a.ply",
        ply("comment TextureFile red.png\n", "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 1 1 0 1\n", false));
    io::ReadLog log;
    const Scene scene = io::read_scene(io::Input::open(dir / "a.ply"), {}, log);
    CHECK(log.warnings.empty());
    REQUIRE(log.files.size() == 1);
    CHECK(log.files[0].path == dir / "red.png");
    CHECK(log.files[0].sha256 == sha256(test::bytes_of(test::get(dir / "red.png"))));
    const Json all = Json::parse(json_of(written(scene, "glb").files.at(0).bytes));
    CHECK(all["images"].at(0)["mimeType"] == "image/png");
    CHECK(all["materials"].at(0)["pbrMetallicRoughness"]["baseColorTexture"]["index"] == 0);
    CHECK(all["meshes"][0]["primitives"].at(0)["material"] == 0);
}

TEST_CASE("faces of a PLY tell which texture is theirs", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "red.png", red_png());
    put(dir / "blue.png", blue_png());
    put(dir / "a.ply", ply("comment TextureFile red.png\ncomment TextureFile blue.png\n",
                           "3 0 1 2 6 0 0 1 0 1 1 1\n3 0 2 3 6 0 0 1 1 0 1 0\n", true));
    io::ReadLog log;
    const Scene scene = io::read_scene(io::Input::open(dir / "a.ply"), {}, log);
    CHECK(log.warnings.empty());
    const Json all = Json::parse(json_of(written(scene, "glb").files.at(0).bytes));
    REQUIRE(all["meshes"][0]["primitives"].size() == 2);
    CHECK(all["materials"].at(0)["name"] == "blue");
    CHECK(all["materials"].at(1)["name"] == "red");
    CHECK_FALSE(scene.parts[0].mesh.find("texnumber", Domain::face));
}

TEST_CASE("a PLY's texture that is missing or has no coordinates is said", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "a.ply",
        ply("comment TextureFile gone.png\n", "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 1 1 0 1\n", false));
    io::ReadLog log;
    Scene scene = io::read_scene(io::Input::open(dir / "a.ply"), {}, log);
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].id == "W-IMAGE");
    CHECK(scene.materials.empty());
    put(dir / "b.ply",
        "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 1\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n0 0 0\n");
    log.warnings.clear();
    io::read_scene(io::Input::open(dir / "b.ply"), {}, log);
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].message.find("no texture coordinates") != std::string::npos);
}

TEST_CASE("texture coordinates of a PLY that are too few for their face are named", "[io]") {
    io::ReadLog log;
    const Scene scene =
        read_bytes(to_bytes(ply("", "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 4 0 0 1 1\n", false)), "ply", &log);
    CHECK(scene.parts.at(0).mesh.find("TEXCOORD_0", Domain::wedge));
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].message ==
          "texture coordinates of 1 face are skipped, because they do not have two "
          "numbers for each corner");
    io::ReadLog none_given;
    read_bytes(to_bytes(ply("", "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n", false)), "ply", &none_given);
    CHECK(none_given.warnings.empty());
}
