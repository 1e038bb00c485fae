#include "support/catch.hpp"

#include "io/codec.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

struct Loaded {
    Scene scene;
    io::ReadLog log;
};

Loaded load(const std::string& name, std::string_view text, bool lines = true) {
    Loaded loaded;
    io::ReadSettings settings;
    settings.lines = lines;
    const auto bytes = bytes_of(text);
    loaded.scene = io::read_scene(io::Input::of(name, {bytes.begin(), bytes.end()}), settings, loaded.log);
    return loaded;
}

/// Two lines of four points: a strip, a loop or a list, as the mode says, below a moved node.
std::string gltf_lines(int mode, const std::string& more = "") {
    return fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"name": "wire", "mesh": 0,
"translation": [10, 0, 0]}}], "materials": [{{"name": "red"}}],
"meshes": [{{"primitives": [{{"mode": {}, "material": 0, "attributes": {{"POSITION": 0}}{}}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}},
{{"bufferView": 1, "componentType": 5121, "count": 2, "type": "SCALAR"}}],
"bufferViews": [{{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 2}}],
"buffers": [{{"byteLength": 50, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAI="}}]}})",
        mode, more);
}

} // namespace

TEST_CASE("lines of an OBJ come by object, with their points and materials", "[io]") {
    const std::string text =
        "v 9 9 9\no a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nl 2 3/1 -1\no b\nusemtl blue\n"
        "v 5 0 0\nv 6 0 0\nv 5 1 0\nl -3 -2\nf 5 6 7\n";
    const Loaded loaded = load("a.obj", text);
    REQUIRE(loaded.log.lines.size() == 2);
    const Lines &a = loaded.log.lines[0], &b = loaded.log.lines[1];
    CHECK(a.name == "a");
    REQUIRE(a.segments.size() == 2);
    CHECK(a.points[a.segments[1].to] == Vec3{1, 1, 0});
    CHECK(a.segments[0].to == a.segments[1].from);
    CHECK(b.points[b.segments[0].from] == Vec3{5, 0, 0});
    CHECK(loaded.scene.materials.at(b.segments[0].material).name == "blue");
    CHECK(loaded.scene.materials.at(a.segments[0].material).name == "red");
    REQUIRE(loaded.scene.parts.size() == 1); // points of lines only are no vertices
    CHECK(loaded.scene.parts[0].mesh.vertex_count() == 3);
    CHECK(loaded.log.warnings.empty());
}

TEST_CASE("lines are skipped with a word when nobody asks for them", "[io]") {
    const Loaded loaded = load("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", false);
    CHECK(loaded.log.lines.empty());
    CHECK(loaded.scene.parts.at(0).mesh.vertex_count() == 2);
    REQUIRE(loaded.log.warnings.size() == 1);
    CHECK(loaded.log.warnings[0].id == "W-SKIPPED");
    CHECK(loaded.log.warnings[0].hint == "load: {path: ..., lines: 1%} makes tubes of the lines");
}

TEST_CASE("points of an OBJ are skipped beside faces only: the vertices of a cloud are all kept", "[io]") {
    const Loaded cloud = load("a.obj", "v 0 0 0\nv 1 0 0\np 1 2\n", false);
    CHECK(cloud.scene.parts.at(0).mesh.vertex_count() == 2);
    CHECK(cloud.log.warnings.empty());
    const Loaded mixed = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\np 1\n", false);
    REQUIRE(mixed.log.warnings.size() == 1);
    CHECK(mixed.log.warnings[0].message.find("'p' (1)") != std::string::npos);
}

TEST_CASE("a line of an OBJ that names no vertex is refused with its place", "[io]") {
    CHECK(failure([] { load("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n\nl 1 3\n"); }) ==
          "malformed [E-OBJ] a.obj:5: a line names a vertex that is not there: the file has 2");
    CHECK(failure([] { load("a.obj", "v 0 0 0\nv 1 0 0\nl 1 -3\n"); }) ==
          "malformed [E-OBJ] a.obj:3: a line names a vertex that is not there: the file has 2");
    CHECK(load("a.obj", "v 0 0 0\nv 1 0 0\nl 1\nl 1 2\n").log.lines.at(0).segments.size() == 1);
}

TEST_CASE("lines of an OBJ are the same however far the file is cut into pieces", "[io]") {
    std::string text;
    for (int i = 0; i < 60000; ++i)
        text += fmt::format("v {} {} 0.25\nv {} 1 0.5\nl -2 -1\n", i, i + 0.125, i);
    REQUIRE(text.size() > (std::size_t{2} << 20));
    const Lines lines = load("a.obj", text).log.lines.at(0);
    REQUIRE(lines.segments.size() == 60000);
    bool right = true;
    for (std::size_t i = 0; i < lines.segments.size(); ++i) {
        const auto& s = lines.segments[i];
        right &= lines.points[s.from] == Vec3{double(i), i + 0.125, 0.25};
        right &= lines.points[s.to] == Vec3{double(i), 1, 0.5};
    }
    CHECK(right);
}

TEST_CASE("line primitives of a glTF come where their node stands", "[io]") {
    for (const auto& [mode, count] : {std::pair{1, 2}, {2, 4}, {3, 3}}) {
        const Loaded loaded = load("a.gltf", gltf_lines(mode));
        REQUIRE(loaded.log.lines.size() == 1);
        const Lines& lines = loaded.log.lines[0];
        CHECK(lines.name == "wire");
        CHECK(lines.segments.size() == static_cast<std::size_t>(count));
        CHECK(lines.points.at(1) == Vec3{11, 0, 0});
        CHECK(lines.segments[0].material == 0);
        CHECK(loaded.log.warnings.empty());
    }
    const Lines indexed = load("a.gltf", gltf_lines(1, ", \"indices\": 1")).log.lines.at(0);
    REQUIRE(indexed.segments.size() == 1);
    CHECK((indexed.segments[0].from == 0 && indexed.segments[0].to == 2));
    CHECK(failure([] { load("a.gltf", gltf_lines(1), false); }) ==
          "malformed [E-EMPTY] a.gltf: 'a.gltf' has no faces: its 1 primitive are placed nowhere or hold "
          "lines only | load: {path: ..., lines: 1%} makes tubes of the lines");
}
