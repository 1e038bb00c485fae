#include "support/catch.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/triangulate/triangulate.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/polygons.hpp"

using namespace facetmill;
using polygon::Kind;

namespace {

Mesh face(const std::vector<Vec3>& corners) {
    Mesh mesh;
    mesh.positions = corners;
    std::vector<Index> all;
    for (Index i = 0; i < corners.size(); ++i) all.push_back(i);
    add_face(mesh, all);
    return mesh;
}

/// Upright in space: x along (0, 1, 0), y along (0, 0, 1), not bent.
Mesh face(const std::vector<Vec2>& ring) {
    std::vector<Vec3> corners;
    for (const Vec2& p : ring) corners.push_back({2, p.x, p.y});
    return face(corners);
}

double area_sum(const Mesh& mesh) {
    Vec3 sum;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index c = mesh.face_begin(f);
        sum += cross(mesh.point(c + 1) - mesh.point(c), mesh.point(c + 2) - mesh.point(c)) * 0.5;
    }
    return sum.x;
}

/// Every triangle faces the way of the face.
bool all_forward(const Mesh& mesh) {
    for (Index c = 0; c < mesh.corners.size(); c += 3)
        if (!(cross(mesh.point(c + 1) - mesh.point(c), mesh.point(c + 2) - mesh.point(c)).x > 0))
            return false;
    return true;
}

} // namespace

TEST_CASE("quads that share two edges are cut so that their halves do not coincide", "[geometry]") {
    // A cushion: two quads back to back on the same four vertices, the shorter diagonal the same.
    Mesh cushion;
    cushion.positions = {{0, 0, 0}, {2, 0, 0.1}, {2.2, 1, 0}, {0, 1, 0.1}};
    add_face(cushion, std::vector<Index>{0, 1, 2, 3});
    add_face(cushion, std::vector<Index>{3, 2, 1, 0});
    for (const Mesh& cut : {triangulated(cushion), triangulate(cushion).mesh}) {
        CHECK(cut.face_count() == 4);
        const Properties p = inspect(cut);
        CHECK(p.closed);
        CHECK(p.edge_manifold);
        CHECK(p.duplicate_faces == 0);
    }
}

TEST_CASE("every kind of face becomes its corners less two triangles", "[geometry]") {
    for (const auto& ring : {test::square(0, 0, 2), test::l_shape(), test::regular(9, 1), test::keyhole()}) {
        const auto result = triangulate(face(ring));
        CHECK(broken_invariants(result.mesh).empty());
        CHECK(result.mesh.face_count() == ring.size() - 2);
        CHECK(area_sum(result.mesh) == Approx(polygon::signed_area(ring)));
        CHECK(all_forward(result.mesh));
        CHECK(result.cut == 1);
        CHECK(result.fans == 0);
    }
}

TEST_CASE("a face that intersects itself is cut as a fan", "[geometry]") {
    const auto result = triangulate(face(test::pentagram()));
    CHECK(result.fans == 1);
    CHECK(result.mesh.face_count() == 3);
    CHECK(area_sum(result.mesh) == Approx(polygon::signed_area(test::pentagram())));
}

TEST_CASE("coincident corners keep their own vertices, so what is around them stays closed", "[geometry]") {
    // A slab with a square hole: top and bottom are keyholes of ten corners, connected by walls.
    const auto ring = test::keyhole();
    Mesh slab;
    const auto n = static_cast<Index>(ring.size());
    for (const double z : {0.0, 1.0})
        for (const Vec2& p : ring) slab.positions.push_back({p.x, p.y, z});
    std::vector<Index> top, bottom;
    for (Index i = 0; i < n; ++i) {
        top.push_back(n + i);
        bottom.push_back(n - 1 - i);
    }
    add_face(slab, top);
    add_face(slab, bottom);
    for (Index i = 0; i < n; ++i) add_face(slab, std::vector<Index>{i, (i + 1) % n, n + (i + 1) % n, n + i});
    REQUIRE(inspect(slab).closed);
    const auto result = triangulate(slab);
    const auto after = inspect(result.mesh);
    CHECK(after.closed);
    CHECK(after.edge_manifold);
    CHECK(*after.volume == Approx(12));
}

TEST_CASE("faces that are not planar are cut as seen along their normal's axis", "[geometry]") {
    const auto result = triangulate(
        face(std::vector<Vec3>{{0, 0, 0}, {2, 0, 1}, {2, 1, 0}, {1, 1, 1}, {1, 2, 0}, {0, 2, 1}}));
    CHECK(result.kinds.non_planar == 1);
    CHECK(result.kinds.deviation > 0.1);
    CHECK(result.kinds.count(Kind::concave) == 1);
    CHECK(result.mesh.face_count() == 4);
    for (Index c = 0; c < result.mesh.corners.size(); c += 3)
        CHECK(cross(result.mesh.point(c + 1) - result.mesh.point(c),
                    result.mesh.point(c + 2) - result.mesh.point(c))
                  .z > 0);
}

TEST_CASE("the census of faces", "[geometry]") {
    Mesh mesh = shapes::quad_cube();
    append(mesh, shapes::tetrahedron());
    for (const auto& ring : {test::l_shape(), test::regular(6, 1), test::keyhole(), test::pentagram(),
                             std::vector<Vec2>{{0, 0}, {1, 1}, {2, 2}}})
        append(mesh, face(ring));
    const FaceKinds kinds = face_kinds(mesh);
    CHECK(kinds.of_kind == std::array<std::size_t, polygon::kinds>{4, 6, 1, 1, 1, 1, 1});
    CHECK(kinds.non_planar == 0);
}

TEST_CASE("the census of faces whose parts cancel in area", "[geometry]") {
    for (const double z : {0.0, 2.5}) {
        const auto bow = face(std::vector<Vec3>{{0, 0, 0}, {2, 2, z}, {2, 0, z}, {0, 2, 0}});
        const FaceKinds kinds = face_kinds(bow);
        CHECK(kinds.count(Kind::self_intersecting) == 1);
        CHECK(kinds.non_planar == 0);
        CHECK(kinds.deviation < 1e-12);
    }
    const FaceKinds line = face_kinds(face(std::vector<Vec2>{{0, 0}, {1, 1}, {3, 3}, {2, 2}}));
    CHECK(line.count(Kind::degenerate) == 1);
    CHECK(line.non_planar == 0);
}

TEST_CASE("closed stays closed, triangles stay as they are", "[geometry]") {
    const auto cube = triangulate(shapes::quad_cube());
    CHECK(cube.mesh.all_triangles());
    CHECK(inspect(cube.mesh).closed);
    CHECK(*inspect(cube.mesh).volume == Approx(1));
    const Mesh ball = shapes::icosphere(2);
    CHECK(triangulate(ball).mesh.corners == ball.corners);
    CHECK(triangulate(ball).cut == 0);
}

TEST_CASE("triangles pair to quads, the squarest first", "[geometry]") {
    const auto cube = pair_triangles(shapes::cube());
    CHECK(broken_invariants(cube.mesh).empty());
    CHECK(cube.quads == 6);
    CHECK(cube.triangles == 0);
    CHECK(inspect(cube.mesh).closed);
    CHECK(*inspect(cube.mesh).volume == Approx(1));
    CHECK(face_kinds(cube.mesh).count(Kind::quad) == 6);
    const auto uv = pair_triangles(shapes::uv_cube()); // seams are not crossed
    CHECK(uv.quads == 6);
    CHECK(uv.mesh.wedge_count() == 24);
    CHECK(pair_triangles(shapes::tetrahedron()).quads == 0); // bent too strongly
    CHECK(pair_triangles(shapes::fan3()).quads == 0);
}
