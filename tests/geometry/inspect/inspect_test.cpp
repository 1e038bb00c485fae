#include "support/catch.hpp"

#include "geometry/inspect/evidence.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;

TEST_CASE("a cube is closed, of genus 0, with its area and volume", "[geometry]") {
    for (const Mesh& mesh : {shapes::cube(), shapes::quad_cube(), shapes::uv_cube()}) {
        const Properties p = inspect(mesh);
        CHECK(p.vertices == 8);
        CHECK(p.euler == 2);
        CHECK(p.genus == 0);
        CHECK(p.components == 1);
        CHECK((p.closed && p.edge_manifold && p.vertex_manifold && p.oriented));
        CHECK(p.boundary_edges == 0);
        CHECK(p.area == Approx(6));
        CHECK(p.volume.value() == Approx(1));
        CHECK(p.bounds.max == Vec3{1, 1, 1});
    }
    CHECK(inspect(shapes::uv_cube()).wedges == 24);
    CHECK(inspect(shapes::quad_cube()).triangles == 0);
}

TEST_CASE("a torus has genus 1", "[geometry]") {
    const Properties p = inspect(shapes::torus(24, 12));
    CHECK(p.euler == 0);
    CHECK(p.genus == 1);
    CHECK(p.closed);
}

TEST_CASE("an open grid has one boundary loop and no volume", "[geometry]") {
    const Properties p = inspect(shapes::grid(3, 2));
    CHECK_FALSE(p.closed);
    CHECK(p.boundary_loops == 1);
    CHECK(p.boundary_edges == 10);
    CHECK(p.euler == 1);
    CHECK(p.area == Approx(6));
    CHECK_FALSE(p.volume.has_value());
    CHECK_FALSE(p.genus.has_value());
    CHECK(p.edge_manifold);
}

TEST_CASE("two triangles at a vertex are two fans and two boundary loops", "[geometry]") {
    const Properties p = inspect(shapes::bowtie());
    CHECK_FALSE(p.vertex_manifold);
    CHECK(p.edge_manifold);
    CHECK(p.boundary_loops == 2);
    CHECK(p.components == 1);
    CHECK(locations_against(shapes::bowtie(), *property_named("vertex_manifold")).size() == 1);
}

TEST_CASE("three faces at an edge are not edge-manifold, and the edge is shown", "[geometry]") {
    const Mesh mesh = shapes::fan3();
    CHECK_FALSE(inspect(mesh).edge_manifold);
    CHECK(locations_against(mesh, *property_named("edge_manifold")).size() == 1);
}

TEST_CASE("tetrahedra that share a vertex are closed but have no genus", "[geometry]") {
    const Properties p = inspect(shapes::hourglass());
    CHECK(p.closed);
    CHECK_FALSE(p.vertex_manifold);
    CHECK_FALSE(p.genus.has_value());
    CHECK(p.euler == 3);
}

TEST_CASE("a Moebius strip is not oriented and has one boundary loop at most", "[geometry]") {
    const Properties p = inspect(shapes::moebius(12));
    CHECK_FALSE(p.oriented);
    CHECK_FALSE(p.closed);
    CHECK(p.euler == 0);
    CHECK(locations_against(shapes::moebius(12), *property_named("oriented")).size() == 1);
}

TEST_CASE("degenerate faces are those of exactly zero area", "[geometry]") {
    Mesh mesh = shapes::cube();
    mesh.positions.push_back({0, 0, 2});
    const Index line[] = {0, 8, 8};
    add_face(mesh, line);
    CHECK(inspect(mesh).degenerate_faces == 1);
    Mesh thin;
    thin.positions = {{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {1, 1e-300, 0}};
    const Index on_line[] = {0, 1, 2}, off_line[] = {0, 1, 3};
    add_face(thin, off_line);
    CHECK(inspect(thin).degenerate_faces == 0);
    thin.positions[2] = thin.positions[1] * 2; // exactly twice: exactly on the line
    add_face(thin, on_line);
    CHECK(inspect(thin).degenerate_faces == 1);
    CHECK(locations_against(thin, *property_named("degenerate_faces")).at(0).face == 1);
}

TEST_CASE("duplicate faces have the same vertices, whatever their order", "[geometry]") {
    Mesh mesh = shapes::cube();
    const Index a = mesh.corners[0], b = mesh.corners[1], c = mesh.corners[2];
    const Index again[] = {b, c, a}, reversed[] = {c, b, a};
    add_face(mesh, again);
    add_face(mesh, reversed);
    CHECK(inspect(mesh).duplicate_faces == 2);
    CHECK(locations_against(mesh, *property_named("duplicate_faces")).at(0).face == 12);
}

TEST_CASE("isolated vertices do not count in the Euler number", "[geometry]") {
    Mesh mesh = shapes::tetrahedron();
    mesh.positions.push_back({5, 5, 5});
    const Properties p = inspect(mesh);
    CHECK(p.isolated_vertices == 1);
    CHECK(p.euler == 2);
    CHECK(p.genus == 0);
}

TEST_CASE("an empty mesh has nothing and encloses nothing", "[geometry]") {
    const Properties p = inspect(Mesh{});
    CHECK(p.faces == 0);
    CHECK(p.euler == 0);
    CHECK(p.area == 0);
    CHECK(p.bounds.empty());
}

TEST_CASE("a scene is the sum of its parts in the world", "[geometry]") {
    Scene scene;
    scene.parts.push_back({.name = "one", .mesh = shapes::cube()});
    Part big{.name = "two", .mesh = shapes::cube()};
    for (int i = 0; i < 3; ++i) big.transform.m[i][i] = 2;
    scene.parts.push_back(std::move(big));
    const Properties p = inspect(scene);
    CHECK(p.faces == 24);
    CHECK(p.components == 2);
    CHECK(p.euler == 4);
    CHECK(p.genus == 0);
    CHECK(p.volume.value() == Approx(9));
    CHECK(p.area == Approx(30));
}

TEST_CASE("of parts with equal meshes each has what it would have alone", "[geometry]") {
    Mesh crossing = shapes::cube(), other = shapes::cube();
    for (Vec3& p : other.positions) p += Vec3{0.5, 0.25, 0.125};
    append(crossing, other);
    Scene scene;
    for (int i = 0; i < 4; ++i) scene.parts.emplace_back().mesh = crossing;
    scene.parts[0].transform.m[0][0] = 2;
    scene.parts[1].transform.m[1][1] = -3; // mirrored
    const InspectSettings settings{.self_intersections = true};
    double volume = 0, area = 0;
    std::int64_t crossings = 0;
    for (const Part& part : scene.parts) {
        const Properties own = inspect(part, settings);
        crossings += own.self_intersections.value();
        volume += own.volume.value();
        area += own.area;
    }
    Properties all = inspect(scene, settings);
    CHECK(crossings > 0);
    CHECK(all.self_intersections == crossings);
    CHECK(all.volume == volume);
    CHECK(all.area == area);
    CHECK(all.components == 8);
    CHECK(all.genus == 0);
    scene.parts[2].mesh.corners.resize(scene.parts[2].mesh.corners.size() - 3);
    all = inspect(scene, settings);
    CHECK(all.boundary_edges == 3);
    CHECK(!all.closed);
    CHECK(!all.volume);
}
