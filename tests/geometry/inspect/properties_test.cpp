#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/inspect/evidence.hpp"
#include "geometry/inspect/inspect.hpp"

#include <set>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// closed, edge_manifold, vertex_manifold, oriented as one text of y and n.
std::string truths(const Properties& p) {
    std::string text;
    for (const bool b : {p.closed, p.edge_manifold, p.vertex_manifold, p.oriented}) text += b ? 'y' : 'n';
    return text;
}

Mesh mesh_of(std::vector<Vec3> positions, const std::vector<std::vector<Index>>& faces) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    for (const auto& f : faces) add_face(mesh, f);
    return mesh;
}

} // namespace

TEST_CASE("open surfaces have loops and no volume", "[geometry]") {
    const Properties grid = inspect(shapes::grid(4, 3));
    CHECK(truths(grid) == "nyyy");
    CHECK(grid.boundary_edges == 14);
    CHECK(grid.boundary_loops == 1);
    CHECK(grid.euler == 1);
    CHECK_FALSE(grid.volume);
    CHECK_FALSE(grid.genus);
    CHECK(inspect(shapes::open_cone(9)).boundary_loops == 1);
    CHECK(inspect(shapes::moebius(9)).boundary_loops == 1);
    Mesh pierced = shapes::torus(16, 9);
    pierced.corners.erase(pierced.corners.begin() + 3, pierced.corners.begin() + 6);
    pierced.corners.erase(pierced.corners.begin() + 150, pierced.corners.begin() + 153);
    CHECK(inspect(pierced).boundary_loops == 2);
}

TEST_CASE("triangles that touch in a vertex have two loops and no single fan", "[geometry]") {
    const Properties p = inspect(shapes::bowtie());
    CHECK(truths(p) == "nyny");
    CHECK(p.boundary_loops == 2);
    CHECK(p.components == 1);
}

TEST_CASE("an hourglass is closed though not manifold at its waist", "[geometry]") {
    const Properties p = inspect(shapes::hourglass());
    CHECK(truths(p) == "yyny");
    CHECK(p.euler == 3);
    CHECK(p.volume);
    CHECK_FALSE(p.genus);
}

TEST_CASE("three faces at an edge", "[geometry]") {
    const Properties p = inspect(shapes::fan3());
    CHECK(truths(p) == "nnyn"); // all three have the same direction, but edges still connect them
    CHECK(p.boundary_edges == 6);
}

TEST_CASE("two cubes that share an edge are closed and agree, though not manifold", "[geometry]") {
    Mesh mesh = shapes::cube(), other = shapes::cube();
    for (auto& p : other.positions) p += Vec3{1, 1, 0};
    append(mesh, other);
    weld_exact(mesh);
    const Properties p = inspect(mesh);
    CHECK(truths(p) == "ynyy"); // at the ends of the edge, edges link all faces
    CHECK(p.volume == 2);
    CHECK(p.components == 1);
}

TEST_CASE("two faces at every edge are not closed when one is flipped", "[geometry]") {
    Mesh mesh = shapes::cube();
    std::swap(mesh.corners[1], mesh.corners[2]);
    const Properties p = inspect(mesh);
    CHECK(truths(p) == "nyyn");
    CHECK(p.boundary_edges == 0);
    CHECK_FALSE(p.volume);
    CHECK(truths(inspect(shapes::moebius(9))) == "nyyn");
}

TEST_CASE("a volume is negative when the faces look inwards", "[geometry]") {
    Mesh mesh = shapes::cube();
    for (std::size_t c = 0; c < 36; c += 3) std::swap(mesh.corners[c], mesh.corners[c + 1]);
    CHECK(inspect(mesh).volume == -1);
}

TEST_CASE("degenerate means exactly no area", "[geometry]") {
    CHECK(
        inspect(mesh_of({{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}}, {{0, 1, 2}})).degenerate_faces ==
        1);
    CHECK(
        inspect(mesh_of({{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.4, 0.4, std::nextafter(0.4, 1)}}, {{0, 1, 2}}))
            .degenerate_faces == 0);
    CHECK(inspect(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 1}})).degenerate_faces == 1);
    CHECK(inspect(mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {{0, 1, 2}})).degenerate_faces == 1);
    CHECK(inspect(mesh_of({{0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}}, {{0, 1, 2}})).degenerate_faces == 0);
    CHECK(inspect(mesh_of({{0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}}, {{0, 1, 2}})).degenerate_faces == 0);
    CHECK(inspect(mesh_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, {{0, 1, 2, 3}})).degenerate_faces ==
          1);
    CHECK(inspect(mesh_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 0}}, {{0, 1, 2, 3}})).degenerate_faces ==
          0);
}

TEST_CASE("duplicate faces have the same vertices in any order", "[geometry]") {
    Mesh mesh = shapes::tetrahedron();
    for (const auto& f : std::vector<std::vector<Index>>{{2, 0, 1}, {1, 0, 2}, {3, 1, 0}}) add_face(mesh, f);
    CHECK(inspect(mesh).duplicate_faces == 3);
    CHECK(duplicate_faces(mesh) == std::vector<Index>{4, 5, 6});
    const std::vector<Vec3> four{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    CHECK(inspect(mesh_of(four, {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 1, 2}})).duplicate_faces == 1);
    CHECK(inspect(mesh_of(four, {{0, 0, 1}, {0, 1, 1}, {0, 1, 2}})).duplicate_faces == 1);
}

TEST_CASE("an empty mesh and positions that are not numbers do no harm", "[geometry]") {
    const Properties empty = inspect(Mesh{});
    CHECK(truths(empty) == "yyyy");
    CHECK(empty.area == 0);
    CHECK(empty.bounds.empty());
    Mesh broken = shapes::cube();
    broken.positions[0] = {NAN, HUGE_VAL, -HUGE_VAL};
    CHECK(inspect(broken, {.self_intersections = true}).euler == 2);
}

TEST_CASE("a part is inspected in world space, mirrored ones too", "[geometry]") {
    Scene scene;
    scene.parts.push_back({.name = "a", .mesh = shapes::cube()});
    scene.parts.push_back({.name = "b", .mesh = shapes::cube()});
    scene.parts[1].transform.m[0][0] = -2;
    scene.parts[1].transform.m[0][3] = 10;
    const Properties p = inspect(scene, {.self_intersections = true});
    CHECK(p.volume == 3);
    CHECK(p.area == 16);
    CHECK(p.genus == 0);
    CHECK(p.euler == 4);
    CHECK(p.components == 2);
    CHECK(p.self_intersections == 0);
    CHECK(p.bounds.max == Vec3{10, 1, 1});
    scene.parts.push_back({.name = "c", .mesh = shapes::grid(1, 1)});
    CHECK_FALSE(inspect(scene).volume);
    CHECK_FALSE(inspect(scene).closed);
}

TEST_CASE("the table of properties", "[geometry]") {
    std::vector<std::string_view> names;
    for (const auto& p : property_table()) {
        names.push_back(p.name);
        CHECK_FALSE(p.help.empty());
        CHECK(property_named(p.name) == &p);
    }
    const std::set<std::string_view> different(names.begin(), names.end());
    CHECK(different.size() == names.size());
    const Properties cube = inspect(shapes::cube());
    CHECK(property_named("faces")->get(cube) == 12);
    CHECK(property_named("closed")->get(cube) == 1);
    CHECK_FALSE(property_named("self_intersections")->get(cube));
    CHECK(property_named("self_intersections")->costly);
    CHECK_FALSE(property_named("clsoed"));
}

TEST_CASE("behind every face of a ball is a wall, also where the way to it ends at an edge", "[geometry]") {
    const Property& wall = *property_named("wall_thickness");
    std::size_t without = 0;
    for (const int levels : {1, 2, 3})
        for (const Vec3& scale : {Vec3{1, 2, 1}, Vec3{0.3, 1, 0.7}, Vec3{1.1, 0.9, 2.7}, Vec3{3, 1, 2}})
            for (const Vec3& at : {Vec3{}, Vec3{0, 6, 0}}) {
                Mesh ball = shapes::icosphere(levels);
                for (Vec3& p : ball.positions)
                    p = Vec3{p.x * scale.x + at.x, p.y * scale.y + at.y, p.z * scale.z + at.z};
                for (const double x : face_values(ball, wall)) without += !std::isfinite(x);
            }
    CHECK(without == 0);
}
