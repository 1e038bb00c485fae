#include "support/catch.hpp"

#include "io/codec.hpp"
#include "mesh/invariants.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

std::string reading(const std::string& name, std::string_view text) {
    const auto bytes = bytes_of(text);
    return failure([&] {
        io::ReadLog log;
        io::read_scene(io::Input::of(name, {bytes.begin(), bytes.end()}), {}, log);
    });
}

const std::string ply_head =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

} // namespace

TEST_CASE("a broken PLY is refused with its place", "[io]") {
    const std::pair<std::string, std::string> cases[] = {
        {"ply\nformat ascii 2x\n",
         "malformed [E-PLY] a.ply:3: the header does not end: there is no 'end_header'"},
        {"ply\nformat text 1.0\n", "malformed [E-PLY] a.ply:2: expected ascii, binary_little_endian or "
                                   "binary_big_endian, found 'text'"},
        {"ply\nformat ascii 1.0\nelement vertex many\n",
         "malformed [E-PLY] a.ply:3: expected a count, found 'many'"},
        {"ply\nformat ascii 1.0\nelement vertex -3\n",
         "malformed [E-PLY] a.ply:3: expected a count, found -3"},
        {"ply\nproperty float x\n", "malformed [E-PLY] a.ply:2: a property without an element"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n",
         "malformed [E-PLY] a.ply:4: expected a type (char, uchar, short, ushort, int, uint, float, double), "
         "found 'real'"},
        {"ply\nformat ascii 1.0\nend_header\n", "malformed [E-PLY] a.ply: there is no element 'vertex'"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
         "malformed [E-PLY] a.ply:3: element 'vertex' lacks one of the properties x, y and z"},
        {"ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nend_header\n1\n",
         "malformed [E-PLY] a.ply:3: element 'vertex' should have 99999999999 items, but the remaining 2 "
         "bytes hold at most 1"},
        {ply_head + "0 0 0\n1 0 0\n0 1 zero\n3 0 1 2\n",
         "malformed [E-PLY] a.ply:12: expected z, found 'zero'"},
        {ply_head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
         "malformed [E-PLY] a.ply:7: face 0 of 1 refers to vertex 3, but the file has 3"},
        {ply_head + "0 0 0\n1 0 0\n0 1 0\n",
         "malformed [E-PLY] a.ply:13: expected the length of a list, found the end of the file"},
        {ply_head + "0 0 0\n1 0 0\n0 1 0\n300 0 1 2\n",
         "malformed [E-PLY] a.ply:13: a list of 300 values, which the rest of the file cannot hold"},
        {ply_head + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
         "malformed [E-NAN] vertex 1 of part 'a' in 'a.ply' is (1, nan, 0), expected finite numbers | "
         "load: {not_finite: drop} leaves out such vertices and the faces at them"},
    };
    for (const auto& [text, message] : cases) CHECK(reading("a.ply", text) == message);
    std::string binary =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::size_t head = binary.size();
    binary += std::string(36, '\0') + "\3" + std::string(12, '\0');
    CHECK(reading("a.ply", binary) == "nothing");
    CHECK(reading("a.ply", binary.substr(0, head + 40)) ==
          fmt::format("malformed [E-PLY] a.ply: the file ends in element 'face', 0 of 1, at byte {}",
                      head + 40));
    CHECK(reading("a.ply", binary.substr(0, head + 20)) ==
          "malformed [E-PLY] a.ply:3: element 'vertex' should have 3 items, but the remaining 20 bytes hold "
          "at most 1");
}

TEST_CASE("a broken STL is refused with its place", "[io]") {
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    const std::pair<std::string, std::string> cases[] = {
        {"solid a\n" + facet,
         "malformed [E-STL] a.stl:8: expected 'facet' or 'endsolid', found the end of the file"},
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n",
         "malformed [E-STL] a.stl:4: expected z, found 'x'"},
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n",
         "malformed [E-NAN] a.stl:4: expected z as a finite number, found inf | load: {not_finite: drop} "
         "leaves out such vertices and the faces at them"},
        {"solid a\n" + facet + "endsolid\nsolod b\n",
         "malformed [E-STL] a.stl:10: expected 'solid', found 'solod'"},
        {"solid a\nendsolid a\n", "malformed [E-EMPTY] 'a.stl' has no mesh and no vertex | export it again "
                                  "with its meshes: programs may leave out hidden or unselected objects"},
        {"what is this", "malformed [E-STL] a.stl: 12 bytes are neither STL text nor binary, which has 84 "
                         "before the first triangle"},
        {std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(60, '\0'),
         "malformed [E-STL] a.stl: the file should have 2 triangles, but ends in triangle 1, at byte 144"},
    };
    for (const auto& [text, message] : cases) CHECK(reading("a.stl", text) == message);
}

TEST_CASE("a broken OBJ is refused with its place", "[io]") {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::pair<std::string, std::string> cases[] = {
        {"v 0 0\n", "malformed [E-OBJ] a.obj:1: expected three coordinates, found 2"},
        {"v 0 0 up\n", "malformed [E-OBJ] a.obj:1: expected a coordinate, found 'up'"},
        {"\n\nv 0 1e999 0\n",
         "malformed [E-NAN] a.obj:3: expected a coordinate as a finite number, found inf | load: "
         "{not_finite: drop} leaves out such vertices and the faces at them"},
        {triangle + "f 0 1 2\n", "malformed [E-OBJ] a.obj:4: indices count from 1, found 0"},
        {triangle + "f 1 2 x\n",
         "malformed [E-OBJ] a.obj:4: expected a corner (v, v/vt, v//vn or v/vt/vn), found 'x'"},
        {triangle + "f 1 2 3/1/1/1\n",
         "malformed [E-OBJ] a.obj:4: expected a corner (v, v/vt, v//vn or v/vt/vn), found '3/1/1/1'"},
        {triangle + "f 1 2 3\n# more\nf 1 2 4\n",
         "malformed [E-OBJ] a.obj:6: a face refers to a vertex that does not exist: the file has 3"},
        {triangle + "f -1 -2 -4\n",
         "malformed [E-OBJ] a.obj:4: a face refers to a vertex that does not exist: the file has 3"},
        {triangle + "f 1 2 99999999999999999999\n", "malformed [E-OBJ] a.obj:4: expected a corner (v, v/vt, "
                                                    "v//vn or v/vt/vn), found '99999999999999999999'"},
        {"# nothing\n", "malformed [E-EMPTY] 'a.obj' has no mesh and no vertex | export it again with its "
                        "meshes: programs may leave out hidden or unselected objects"},
        {"", "malformed [E-EMPTY] 'a.obj' is empty: it has no bytes | export or download the file again"},
    };
    for (const auto& [text, message] : cases) CHECK(reading("a.obj", text) == message);
}

TEST_CASE("a broken OFF is refused with its place", "[io]") {
    const std::pair<std::string, std::string> cases[] = {
        {"OFF\n3 one 0\n", "malformed [E-OFF] a.off:2: expected the number of faces, found 'one'"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n",
         "malformed [E-OFF] a.off:6: expected the number of corners, found the end of the file"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
         "malformed [E-OFF] a.off:6: a face refers to vertex 3, but the file has 3"},
        {"OFF\n353535235358 6 0\n0 0 0\n",
         "limit [E-SIZE] a.off: 353535235358 vertices and 6 faces are more than facetmill supports"},
        {"OFF\n1000 6 0\n0 0 0\n", "malformed [E-OFF] a.off:2: the header gives 1000 vertices and 6 faces, "
                                   "but the remaining 9 bytes cannot hold them"},
        {"4OFF\n1 0 0\n0 0 0 0\n", "malformed [E-OFF] a.off:1: facetmill cannot read '4OFF': it supports "
                                   "only points with three coordinates | expected OFF "
                                   "with any of the prefixes ST, C and N, in this order"},
    };
    for (const auto& [text, message] : cases) CHECK(reading("a.off", text) == message);
}

TEST_CASE("content decides over the name, and the name where content does not tell", "[io]") {
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const auto bytes = bytes_of(off);
    io::ReadLog log;
    const Scene scene = io::read_scene(io::Input::of("a.stl", {bytes.begin(), bytes.end()}), {}, log);
    CHECK(scene.face_count() == 1);
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].message == "'a.stl' is read as off, because its content has this format");
    CHECK(reading("standard input", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n") == "nothing");
    CHECK(reading("notes.txt", "hello")
              .starts_with("usage [E-FORMAT] the format of 'notes.txt' is not recognised | give "
                           "'format', one of: "));
}
