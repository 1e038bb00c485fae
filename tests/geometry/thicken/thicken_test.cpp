#include "support/catch.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/thicken/thicken.hpp"
#include "mesh/invariants.hpp"
#include "mesh/topology.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

ThickenResult thickened(const Mesh& mesh, double thickness, ThickenSide side) {
    ThickenResult r = thicken(mesh, {.thickness = thickness, .side = side});
    CHECK(broken_invariants(r.mesh).empty());
    const Properties p = inspect(r.mesh);
    CHECK(p.closed);
    CHECK(p.edge_manifold);
    CHECK(p.oriented);
    return r;
}

Mesh open_box() {
    Mesh mesh = shapes::quad_cube();
    mesh.face_offsets.pop_back();
    mesh.corners.resize(20);
    return mesh;
}

} // namespace

TEST_CASE("thicken makes solids of sheets that meet at an edge, and walls apart where they meet at a point",
          "[geometry]") {
    CHECK(thickened(shapes::fan3(), 0.1, ThickenSide::centred).unbalanced == 0);
    Mesh bow = shapes::bowtie(); // of two sheets that slope
    bow.positions[1].z = bow.positions[4].z = 0.5;
    for (const ThickenSide side : {ThickenSide::inward, ThickenSide::outward})
        CHECK(thickened(bow, 0.1, side).wall_faces == 12);
}

TEST_CASE("thicken does not look through what is thicker than it is large", "[geometry]") {
    const Mesh cone = shapes::open_cone(8); // an open surface has no inside to fill
    const double size = length(cone.bounds().max - cone.bounds().min);
    CHECK(thicken(cone, {.thickness = 0.9 * size}).self_intersections.has_value());
    CHECK_FALSE(thicken(cone, {.thickness = 1.1 * size}).self_intersections);
    const Transform half{{{0.5, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 0.5, 0}}};
    CHECK_FALSE(thicken(cone, {.thickness = 0.9 * size, .to_world = half}).self_intersections);
}

TEST_CASE("thicken makes a plate of a sheet", "[geometry]") {
    for (const ThickenSide side : {ThickenSide::inward, ThickenSide::outward, ThickenSide::centred}) {
        const auto r = thickened(shapes::grid(3, 2), 0.5, side);
        CHECK(test::volume(r.mesh) == Approx(3));
        CHECK(r.mesh.face_count() == 12 + 12 + 20);
        CHECK(r.wall_faces == 20);
        CHECK(r.wall->thinnest == Approx(0.5));
        CHECK(r.self_intersections == 0);
        const double low = side == ThickenSide::inward ? -0.5 : side == ThickenSide::centred ? -0.25 : 0;
        CHECK(r.mesh.bounds().min.z == Approx(low));
        CHECK(r.mesh.bounds().max.z == Approx(low + 0.5));
    }
}

TEST_CASE("thicken keeps the thickness of walls at corners", "[geometry]") {
    auto r = thickened(shapes::cube(), 0.1, ThickenSide::inward);
    CHECK(test::volume(r.mesh) == Approx(1 - 0.8 * 0.8 * 0.8));
    CHECK(inspect(r.mesh).components == 2);
    r = thickened(shapes::cube(), 0.1, ThickenSide::outward);
    CHECK(test::volume(r.mesh) == Approx(1.2 * 1.2 * 1.2 - 1));
    r = thickened(open_box(), 0.1, ThickenSide::inward);
    CHECK(inspect(r.mesh).components == 1);
    CHECK(r.wall->thinnest == Approx(0.1));
    CHECK(r.self_intersections == 0);
}

TEST_CASE("thicken means the world's lengths where a node stretches", "[geometry]") {
    for (const double way : {1.0, -1.0}) {
        Transform t;
        t.m[0][0] = 3 * way;
        t.m[1][1] = 2;
        t.m[2][3] = 5;
        const auto r = thicken(shapes::cube(), {.thickness = 0.25, .to_world = t});
        const double local = 6 - 2.5 * 1.5 * 0.5; // in the world
        CHECK(test::volume(r.mesh) * 6 == Approx(local));
        CHECK(r.wall->thinnest == Approx(0.25));
        const auto round = wires(shapes::cube(), {.thickness = 0.1, .sides = 6, .to_world = t});
        double length = 0;
        const Mesh cube = shapes::cube();
        const auto edges = build_edges(cube);
        for (const auto& e : edges.edges)
            length += facetmill::length(t.vector(cube.positions[e.high] - cube.positions[e.low]));
        const double hexagon = 1.5 * std::sqrt(3.0) * 0.05 * 0.05;
        CHECK(test::volume(round.mesh) * 6 == Approx(length * hexagon));
    }
}

TEST_CASE("thicken tells where the solid is open", "[geometry]") {
    CHECK(thicken(shapes::grid(2, 2), {.thickness = 0.1}).unbalanced == 0);
    CHECK(thicken(shapes::moebius(9), {.thickness = 0.1}).unbalanced ==
          4); // where it was twisted: front, back and both borders
}

TEST_CASE("two-sided the second time changes nothing", "[geometry]") {
    for (const Mesh& mesh : {shapes::grid(3, 3), shapes::quad_cube(), with_uv_seams(shapes::cube())}) {
        const Mesh once = two_sided(mesh).mesh;
        const Mesh twice = two_sided(once).mesh;
        CHECK(twice.corners == once.corners);
        CHECK(twice.positions == once.positions);
        Mesh more = once; // a different face, the only face that gets a back
        more.positions.insert(more.positions.end(), {{9, 0, 0}, {9, 1, 0}, {9, 0, 1}});
        const auto first = static_cast<Index>(once.vertex_count());
        if (more.has_seams() || more.wedge_count() != more.vertex_count()) continue;
        add_face(more, std::array{first, first + 1, first + 2});
        CHECK(two_sided(more).mesh.face_count() == once.face_count() + 2);
    }
}

TEST_CASE("thicken counts the intersections of a wall that is too thick", "[geometry]") {
    CHECK(thicken(noisy_icosphere(2, 0.3, 1), {.thickness = 0.5}).self_intersections > 0);
    CHECK(thicken(shapes::torus(16, 8, 1, 0.3), {.thickness = 0.1}).self_intersections == 0);
}

TEST_CASE("thicken holds sharp corners back", "[geometry]") {
    Mesh needle = shapes::open_cone(5);
    for (Vec3& p : needle.positions) p.z *= 50;
    const auto r = thickened(needle, 0.01, ThickenSide::outward);
    CHECK(r.limited == 1);
    for (std::size_t v = 0; v < needle.vertex_count(); ++v)
        CHECK(length(r.mesh.positions[v] - needle.positions[v]) <= 0.03 + 1e-12);
}

TEST_CASE("thicken keeps attributes on both sides and turns normals on the back", "[geometry]") {
    Mesh mesh = shapes::uv_cube();
    mesh.corners.resize(mesh.corners.size() - 6);
    drop_unused(mesh);
    const auto r = thickened(mesh, 0.1, ThickenSide::inward);
    const Attribute& n = *r.mesh.find("NORMAL", Domain::wedge);
    const Attribute& uv = *r.mesh.find("TEXCOORD_0", Domain::wedge);
    for (std::size_t w = 0; w < mesh.wedge_count(); ++w)
        for (int c = 0; c < 3; ++c) {
            CHECK(n.value(mesh.wedge_count() + w, c) == -n.value(w, c));
            if (c < 2) CHECK(uv.value(mesh.wedge_count() + w, c) == uv.value(w, c));
        }
    for (Index f = static_cast<Index>(2 * mesh.face_count()); f < r.mesh.face_count();
         ++f) { // walls look out
        const Vec3 u = r.mesh.point(3 * f + 1) - r.mesh.point(3 * f),
                   v = r.mesh.point(3 * f + 2) - r.mesh.point(3 * f);
        const Index w = r.mesh.corners[3 * f];
        CHECK(dot(normalised(cross(u, v)), {n.value(w, 0), n.value(w, 1), n.value(w, 2)}) == Approx(1));
    }
}

TEST_CASE("wires makes a closed cylinder of every edge", "[geometry]") {
    const auto r = wires(shapes::quad_cube(), {.thickness = 0.1, .sides = 6});
    CHECK(broken_invariants(r.mesh).empty());
    CHECK(r.edges == 12);
    const Properties p = inspect(r.mesh);
    CHECK((p.closed && p.edge_manifold && p.oriented));
    CHECK(p.components == 12);
    const double hexagon = 1.5 * std::sqrt(3.0) * 0.05 * 0.05;
    CHECK(test::volume(r.mesh) == Approx(12 * hexagon));
    CHECK(wires(shapes::grid(2, 2), {.thickness = 0.1, .sides = 3, .open_only = true}).edges == 8);
}

TEST_CASE("wires of no edges is a sound mesh without faces", "[geometry]") {
    WiresSettings settings;
    settings.open_only = true;
    const Mesh none = wires(shapes::cube(), settings).mesh;
    CHECK(none.face_count() == 0);
    CHECK(broken_invariants(none).empty());
}

TEST_CASE("two-sided doubles faces in reversed order", "[geometry]") {
    for (const Mesh& mesh : {shapes::grid(3, 3), shapes::open_cone(8), with_uv_seams(shapes::grid(3, 2))}) {
        const auto r = two_sided(mesh);
        CHECK(broken_invariants(r.mesh).empty());
        CHECK(r.mesh.face_count() == 2 * mesh.face_count());
        const Properties p = inspect(r.mesh);
        CHECK(p.closed);
        CHECK(p.area == Approx(2 * test::area(mesh)));
        CHECK(std::abs(*p.volume) < 1e-12);
    }
    const Properties cone = inspect(two_sided(shapes::open_cone(8)).mesh);
    CHECK((cone.edge_manifold && cone.vertex_manifold && cone.oriented));
}
