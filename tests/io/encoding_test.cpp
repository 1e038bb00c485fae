#include "support/catch.hpp"

#include "io/codec.hpp"
#include "io/encoding.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// ASCII as UTF-16, without a mark.
std::string wide(std::string_view text, bool big) {
    std::string out;
    for (const char c : text) {
        if (big) out += '\0';
        out += c;
        if (!big) out += '\0';
    }
    return out;
}

io::Input input_of(const std::string& name, const std::string& text) {
    const auto bytes = bytes_of(text);
    return io::Input::of(name, {bytes.begin(), bytes.end()});
}

std::string decoded(const std::string& text) {
    const io::Input input = io::in_utf8(input_of("a.obj", text));
    return std::string(io::as_text(input.bytes()));
}

const std::string little = "\xFF\xFE", big = "\xFE\xFF", mark = "\xEF\xBB\xBF";

} // namespace

TEST_CASE("UTF-16 and byte order marks become plain UTF-8", "[io]") {
    const std::string text = "v 0 0 0\nv 1 0 0\n";
    CHECK(decoded(text) == text);
    CHECK(decoded(mark + text) == text);
    CHECK(decoded(little + wide(text, false)) == text);
    CHECK(decoded(big + wide(text, true)) == text);
    CHECK(decoded(wide(text, false)) == text);
    CHECK(decoded(wide(text, true)) == text);
    // e acute, the euro sign, and a character beyond 16 bits.
    CHECK(decoded(little + std::string("\xe9\x00\xac\x20\x3d\xd8\x00\xde", 8)) ==
          "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80");
}

TEST_CASE("text that is no whole UTF-16 is refused with its place", "[io]") {
    const auto refused = [](const std::string& text) { return failure([&] { decoded(text); }); };
    CHECK(refused(little + "v") ==
          "malformed [E-ENCODING] 'a.obj' is UTF-16 and ends within a character | save it as UTF-8");
    const std::string half =
        "malformed [E-ENCODING] 'a.obj' is UTF-16 with half of a surrogate pair at byte ";
    CHECK(refused(little + wide("v", false) + "\x3d\xd8") == half + "4 | save it as UTF-8");
    CHECK(refused(little + std::string("\x00\xde\x00\xde", 4)) == half + "2 | save it as UTF-8");
    CHECK(refused(little + std::string("\x3d\xd8\x41\x00", 4)) == half + "2 | save it as UTF-8");
    CHECK(refused(little + std::string("\0\0v\0\0\0", 6)) ==
          "malformed [E-ENCODING] 'a.obj' is UTF-32, which facetmill cannot read | save it as UTF-8");
}

TEST_CASE("every text format is read in UTF-8 with a mark and in UTF-16", "[io]") {
    const std::pair<const char*, std::string> files[] = {
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"a.ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
         "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 "
         "0 1 2\n"},
        {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                  "0\nendloop\nendfacet\nendsolid a\n"},
        {"a.gltf",
         R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})"}};
    for (const auto& [name, text] : files) {
        for (const std::string& bytes :
             {text, mark + text, little + wide(text, false), big + wide(text, true), wide(text, false)}) {
            INFO(name << ", " << bytes.size() << " bytes");
            io::ReadLog log;
            const Scene scene = io::read_scene(input_of(name, bytes), {}, log);
            REQUIRE(scene.parts.size() == 1);
            CHECK(scene.parts[0].mesh.face_count() == 1);
            CHECK(scene.parts[0].mesh.positions ==
                  std::vector<Vec3>{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}});
            CHECK(log.warnings.empty());
        }
    }
}

TEST_CASE("a library of materials may be UTF-16", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
    put(dir / "a.mtl", little + wide("newmtl red\nKd 1 0 0\n", false));
    io::ReadLog log;
    const Scene scene = io::read_scene(io::Input::open(dir / "a.obj"), {}, log);
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].base_colour[1] == 0);
    CHECK(log.warnings.empty());
}
