#include "mesh/lines.hpp"

#include "mesh/equal_meshes.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"

using namespace facetmill;

namespace {

/// Two lines that meet at the same position, each with its own vertex.
Mesh two_lines() {
    Mesh mesh;
    mesh.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    mesh.lines = {1, 2, 3, 4};
    mesh.attributes = {{"heat", Domain::wedge, Role::generic, 1, false, std::vector<float>{9, 1, 2, 3, 4}}};
    return mesh;
}

} // namespace

TEST_CASE("vertices of lines are used, and stay together with them", "[mesh]") {
    Mesh mesh = two_lines();
    drop_unused(mesh);
    CHECK(broken_invariants(mesh).empty());
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.lines == std::vector<Index>{0, 1, 2, 3});
    CHECK(mesh.find("heat", Domain::wedge)->value(2, 0) == 3);
    CHECK(weld_exact(mesh) == 1);
    CHECK(broken_invariants(mesh).empty());
    CHECK(mesh.vertex_of_wedge(mesh.lines[1]) == mesh.vertex_of_wedge(mesh.lines[2]));
    CHECK(mesh.find("heat", Domain::wedge)->value(mesh.lines[2], 0) == 3);
    mesh.attributes.clear();
    mesh.wedge_vertex.clear();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    CHECK(weld_exact(mesh) == 1);
    CHECK(mesh.lines == std::vector<Index>{0, 1, 1, 2});
}

TEST_CASE("of marked vertices those go that neither faces nor lines use", "[mesh]") {
    Mesh mesh = two_lines();
    const std::vector<std::uint8_t> none_marked(5), all(5, 1);
    drop_unused(mesh, none_marked);
    CHECK(mesh.vertex_count() == 5);
    drop_unused(mesh, all);
    CHECK(mesh.vertex_count() == 4);
}

TEST_CASE("lines that are appended keep their ends and their primitives", "[mesh]") {
    Mesh a = two_lines(), b = two_lines();
    a.primitives = {{0, {}, {}}};
    b.primitives = {{1, {}, {}}, {0, {}, {}}};
    b.line_primitive = {0, 1};
    append(a, b);
    CHECK(broken_invariants(a).empty());
    CHECK(a.lines == std::vector<Index>{1, 2, 3, 4, 6, 7, 8, 9});
    REQUIRE(a.primitives.size() == 2);
    CHECK(a.line_primitive == std::vector<Index>{0, 0, 1, 0});
}

TEST_CASE("faces and lines of one mesh are parted", "[mesh]") {
    Mesh mesh = shapes::tetrahedron();
    const std::size_t of_faces = mesh.vertex_count();
    mesh.positions.push_back({5, 5, 5});
    mesh.positions.push_back({6, 6, 6});
    mesh.lines = {1, static_cast<Index>(of_faces)};
    CHECK(broken_invariants(mesh).size() == 1);
    const Mesh lines = split_lines(mesh);
    CHECK(broken_invariants(mesh).empty());
    CHECK(broken_invariants(lines).empty());
    CHECK(mesh.face_count() == 4);
    CHECK(mesh.line_count() == 0);
    CHECK(mesh.vertex_count() == of_faces + 1); // with the one that nothing uses
    CHECK(mesh.positions.back() == Vec3{6, 6, 6});
    CHECK(lines.vertex_count() == 2);
    CHECK(lines.positions[lines.lines[1]] == Vec3{5, 5, 5});
}

TEST_CASE("invariants of lines are told", "[mesh]") {
    Mesh mesh = two_lines();
    CHECK(broken_invariants(mesh).empty());
    mesh.lines.push_back(5);
    mesh.line_primitive = {0, 0, 1};
    CHECK(broken_invariants(mesh) ==
          std::vector<std::string>{"5 ends of lines are not a multiple of two",
                                   "lines that refer to no wedge: 1, first 4", "3 primitives of lines, not 2",
                                   "primitives of lines out of range: 1, first 2"});
}

TEST_CASE("meshes that differ in their lines are not equal", "[mesh]") {
    Scene scene;
    scene.parts.resize(3);
    for (Part& part : scene.parts) part.mesh = two_lines();
    scene.parts[1].mesh.lines = {1, 2, 2, 4};
    CHECK(DistinctParts(scene).first == std::vector<std::size_t>{0, 1, 0});
}

TEST_CASE("lines of a part stand in the world, with their materials", "[mesh]") {
    Part part;
    part.name = "a";
    part.mesh = two_lines();
    part.mesh.primitives = {{none, {}, {}}, {7, {}, {}}};
    part.mesh.line_primitive = {0, 1};
    part.transform.m[0][3] = 10;
    const Lines lines = lines_of(part);
    CHECK(lines.name == "a");
    REQUIRE(lines.segments.size() == 2);
    CHECK(lines.points[lines.segments[1].to] == Vec3{11, 1, 0});
    CHECK(lines.segments[0].material == none);
    CHECK(lines.segments[1].material == 7);
}
