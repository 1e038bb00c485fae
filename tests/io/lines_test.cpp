#include "support/catch.hpp"

#include "io/codec.hpp"
#include "mesh/invariants.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>
#include <set>

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

/// Two lines of four points below a moved node: a strip, a loop or a list, by the mode.
std::string gltf_lines(int mode, const std::string& more = "") {
    return fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"name": "wire", "mesh": 0,
"translation": [10, 0, 0]}}], "materials": [{{"name": "red"}}],
"meshes": [{{"primitives": [{{"mode": {}, "material": 0, "attributes": {{"POSITION": 0}}{}}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
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
    REQUIRE(loaded.scene.parts.size() == 1);               // points of lines only are no vertices
    CHECK(loaded.scene.parts[0].mesh.vertex_count() == 4); // with the first, which nothing uses
    REQUIRE(loaded.log.warnings.size() == 1);
    CHECK(loaded.log.warnings[0].message.find("texture points of l") != std::string::npos);
}

TEST_CASE("lines of an OBJ are parts, by object, with the colours of their vertices and their materials",
          "[io]") {
    const Loaded loaded =
        load("a.obj",
             "v 9 9 9\no a\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nusemtl red\nl 2 3/1 -1\n"
             "usemtl blue\nl 3 2\no b\nv 5 0 0\nv 6 0 0\nv 5 1 0\nl -3 -2\nf 5 6 7\nusemtl\nl 5 7\n",
             false);
    CHECK(loaded.log.lines.empty());
    REQUIRE(loaded.log.warnings.size() == 1);
    CHECK(loaded.log.warnings[0].id == "W-SKIPPED");
    CHECK(loaded.log.warnings[0].message.find("texture points of l") != std::string::npos);
    REQUIRE(loaded.scene.parts.size() == 3);
    CHECK(broken_invariants(loaded.scene).empty());
    CHECK(loaded.scene.parts[0].name == "b");
    CHECK(loaded.scene.parts[0].mesh.vertex_count() ==
          4); // with the one that nothing uses, without ends of lines
    const Part &a = loaded.scene.parts[1], &b = loaded.scene.parts[2];
    CHECK(a.name == "a");
    CHECK(a.mesh.positions == std::vector<Vec3>{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}});
    CHECK(a.mesh.lines == std::vector<Index>{0, 1, 1, 2, 1, 0});
    CHECK(a.mesh.line_primitive == std::vector<Index>{0, 0, 1});
    CHECK(loaded.scene.materials.at(a.mesh.primitives.at(1).material).name == "blue");
    const Attribute* colours = a.mesh.find("COLOR_0", Domain::wedge);
    REQUIRE(colours);
    CHECK(colours->value(1, 1) == 1);
    CHECK(b.name == "b_lines");
    CHECK(b.mesh.lines == std::vector<Index>{0, 1, 0, 2});
    REQUIRE(b.mesh.primitives.size() == 2);
    CHECK(b.mesh.primitives[1].material == none);
}

TEST_CASE("several groups of OBJ lines are named as lost, one is not", "[io]") {
    const std::string points = "v 0 0 0\nv 1 0 0\n";
    const Loaded several = load("a.obj", points + "g left\nl 1 2\ng right\nl 2 1\n", false);
    REQUIRE(several.log.warnings.size() == 1);
    CHECK(several.log.warnings[0].id == "W-SKIPPED");
    CHECK(several.log.warnings[0].message.find("'groups of l' (2)") != std::string::npos);
    CHECK(load("a.obj", points + "g left\nl 1 2\nl 2 1\ng empty\n", false).log.warnings.empty());
    CHECK(load("a.obj", points + "o a\ng a\nl 1 2\no b\ng b\nl 2 1\n", false).log.warnings.empty());
    const Loaded one = load("a.obj", points + "l 1 2\ng right\nl 2 1\n", false);
    REQUIRE(one.log.warnings.size() == 1);
    CHECK(one.log.warnings[0].message.find("'groups of l' (1)") != std::string::npos);
}

TEST_CASE("edges of a PLY are lines, apart from the faces", "[io]") {
    const std::string
        head = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float "
               "z\nproperty float heat\n",
        rows = "0 0 0 1\n1 0 0 2\n0 1 0 3\n5 5 5 4\n6 6 6 5\n",
        edges = "element edge 2\nproperty int vertex1\nproperty int vertex2\n",
        faces = "element face 1\nproperty list uchar int vertex_indices\n";
    const Loaded alone = load("a.ply", head + edges + "end_header\n" + rows + "3 1\n1 0\n", false);
    REQUIRE(alone.scene.parts.size() == 2);
    CHECK(broken_invariants(alone.scene).empty());
    const Mesh& points = alone.scene.parts[0].mesh; // vertices that no line uses
    CHECK(points.positions == std::vector<Vec3>{Vec3{0, 1, 0}, Vec3{6, 6, 6}});
    CHECK(points.find("heat", Domain::wedge)->value(1, 0) == 5);
    CHECK(alone.scene.parts[1].name == "lines");
    CHECK(alone.scene.parts[1].mesh.lines == std::vector<Index>{2, 1, 1, 0});
    const std::string more = "element edge 4\nproperty int vertex1\nproperty int vertex2\n";
    const Loaded all = load("a.ply", head + more + "end_header\n" + rows + "3 1\n1 0\n2 4\n0 2\n", false);
    REQUIRE(all.scene.parts.size() == 1);
    CHECK(all.scene.parts[0].mesh.vertex_count() == 5);
    CHECK(all.scene.parts[0].mesh.lines == std::vector<Index>{3, 1, 1, 0, 2, 4, 0, 2});
    const Loaded both =
        load("a.ply", head + faces + edges + "end_header\n" + rows + "3 0 1 2\n3 1\n1 0\n", false);
    CHECK(both.log.warnings.empty());
    REQUIRE(both.scene.parts.size() == 2);
    CHECK(broken_invariants(both.scene).empty());
    CHECK(both.scene.parts[0].mesh.vertex_count() == 4); // with the one that nothing uses
    CHECK(both.scene.parts[1].name == "lines");
    const Mesh& lines = both.scene.parts[1].mesh;
    CHECK(lines.positions == std::vector<Vec3>{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{5, 5, 5}});
    CHECK(lines.lines == std::vector<Index>{2, 1, 1, 0});
    CHECK(lines.find("heat", Domain::wedge)->value(2, 0) == 4);
    CHECK(load("a.ply", head + faces + edges + "end_header\n" + rows + "3 0 1 2\n3 1\n1 0\n")
              .log.lines.at(0)
              .segments.size() == 2);

    const auto refused = [&](const std::string& more) {
        return failure([&] { load("a.ply", head + edges + "end_header\n" + rows + more, false); });
    };
    CHECK(refused("3 1\n1 5\n") ==
          "malformed [E-PLY] a.ply:8: edge 1 of 2 refers to vertex 5, but the file has 5");
    CHECK(refused("-1 1\n1 0\n") ==
          "malformed [E-PLY] a.ply:8: edge 0 of 2 refers to vertex -1, but the file has 5");
    CHECK(failure([&] {
              load("a.ply",
                   head +
                       "element edge 4000000000\nproperty int vertex1\nproperty int vertex2\nend_header\n" +
                       rows,
                   false);
          }).find("element 'edge' should have 4000000000 items") != std::string::npos);
}

TEST_CASE("a line of an OBJ that names no vertex is refused with its place", "[io]") {
    CHECK(failure([] { load("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n\nl 1 3\n"); }) ==
          "malformed [E-OBJ] a.obj:5: a line refers to a vertex that does not exist: the file has 2");
    CHECK(failure([] { load("a.obj", "v 0 0 0\nv 1 0 0\nl 1 -3\n"); }) ==
          "malformed [E-OBJ] a.obj:3: a line refers to a vertex that does not exist: the file has 2");
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
}

TEST_CASE("lines beside triangles of a glTF leave the document when they become tubes", "[io]") {
    std::string text = gltf_lines(3);
    const std::string lines = R"({"mode": 3,)";
    REQUIRE(text.find(lines) != std::string::npos);
    text.insert(text.find(lines), R"({"mode": 6, "attributes": {"POSITION": 0}},)");
    const Loaded loaded = load("a.gltf", text);
    REQUIRE(loaded.log.lines.size() == 1);
    CHECK(loaded.log.lines[0].name == "wire_lines");
    CHECK(loaded.log.lines[0].segments.size() == 3);
    REQUIRE(loaded.scene.parts.size() == 1);
    const auto bytes = test::written(loaded.scene, "glb").files.at(0).bytes;
    const Scene again = test::read_bytes(bytes, "glb");
    REQUIRE(again.parts.size() == 1);
    CHECK(again.parts[0].mesh.line_count() == 0);
}

TEST_CASE("a glTF mesh of lines is a part of its document", "[io]") {
    for (const auto& [mode, ends] : {std::pair{1, std::vector<Index>{0, 1, 2, 3}},
                                     {2, {0, 1, 1, 2, 2, 3, 3, 0}},
                                     {3, {0, 1, 1, 2, 2, 3}}}) {
        const Loaded loaded = load("a.gltf", gltf_lines(mode), false);
        REQUIRE(loaded.scene.parts.size() == 1);
        CHECK(broken_invariants(loaded.scene).empty());
        const Part& part = loaded.scene.parts[0];
        CHECK(part.name == "wire");
        CHECK((part.document == 0 && part.node == 0 && part.source_mesh == 0));
        CHECK(part.mesh.lines == ends);
        CHECK(part.transform.point(part.mesh.positions.at(1)) == Vec3{11, 0, 0});
        CHECK(part.mesh.primitives.at(0).material == 0);
        CHECK(loaded.log.warnings.empty());
    }
    CHECK(load("a.gltf", gltf_lines(1, ", \"indices\": 1"), false).scene.parts.at(0).mesh.lines ==
          std::vector<Index>{0, 2});
    std::string odd = gltf_lines(1);
    odd.replace(odd.find("\"count\": 4"), 10, "\"count\": 3");
    const Loaded left = load("a.gltf", odd, false);
    CHECK(left.scene.parts.at(0).mesh.line_count() == 1);
    std::multiset<std::string> ids; // the rule about pairs of points, and what reading leaves out
    for (const auto& warning : left.log.warnings) ids.insert(warning.id);
    CHECK(ids == std::multiset<std::string>{"W-GLTF", "W-INCOMPLETE"});
    std::string beyond = gltf_lines(1, ", \"indices\": 1");
    beyond.replace(beyond.find("AAAAAI="), 7, "AAAAAk=");
    CHECK(failure([&] { load("a.gltf", beyond, false); }).find("E-INDEX") != std::string::npos);
    std::string huge = gltf_lines(1);
    const std::string stored = "\"bufferView\": 0, \"componentType\": 5126, \"count\": 4";
    huge.replace(huge.find(stored), stored.size(), "\"componentType\": 5126, \"count\": 4000000000");
    CHECK(failure([&] { load("a.gltf", huge, false); }).starts_with("limit [E-LIMIT]"));
}
