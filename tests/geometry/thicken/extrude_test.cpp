#include "support/catch.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/thicken/extrude.hpp"
#include "mesh/shapes.hpp"
#include "mesh/transform.hpp"

#include <algorithm>

using namespace facetmill;

namespace extrude_surface_test {

namespace {

/// A slope z = x over [0, 4] x [0, 3].
Mesh slope() {
    Mesh mesh = shapes::grid(4, 3);
    for (Vec3& p : mesh.positions) p.z = p.x;
    return mesh;
}

Mesh reversed(Mesh mesh) {
    for (Index f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin(f), mesh.corners.begin() + mesh.face_end(f));
    return mesh;
}

/// The volume of the result, which must be closed, oriented and manifold.
double volume_of_solid(const Mesh& mesh, const ExtrudeSettings& settings) {
    const ExtrudeResult r = extrude(mesh, settings);
    REQUIRE(r.refused == NoSolid::none);
    const Properties p = inspect(r.mesh);
    CHECK(p.closed);
    CHECK(p.oriented);
    CHECK(p.edge_manifold);
    CHECK(p.vertex_manifold);
    CHECK(p.degenerate_faces == 0);
    return p.volume.value_or(0) * settings.to_world.determinant();
}

} // namespace

TEST_CASE("a slope becomes a closed solid, whichever way it looks", "[geometry]") {
    for (const Mesh& mesh : {slope(), reversed(slope())}) {
        CHECK(volume_of_solid(mesh, {.level = -1}) == Approx(12 * 3));
        CHECK(volume_of_solid(mesh, {.level = 6}) == Approx(12 * 4));
        CHECK(volume_of_solid(mesh, {.length = -2}) == Approx(24));
        CHECK(volume_of_solid(mesh, {.length = 0.5}) == Approx(6));
    }
    const ExtrudeResult r = extrude(slope(), {.level = -1});
    CHECK(r.low == 0);
    CHECK(r.high == 4);
    CHECK(r.wall_faces == 28);
    CHECK(std::count_if(r.mesh.positions.begin(), r.mesh.positions.end(),
                        [](const Vec3& p) { return p.z == -1; }) == 20);
}

TEST_CASE("a boundary at the level gets no wall", "[geometry]") {
    CHECK(volume_of_solid(slope(), {.level = 0}) == Approx(24)); // a wedge
    CHECK(volume_of_solid(slope(), {.level = 4}) == Approx(24));
    Mesh pyramid = shapes::grid(2, 2);
    for (Vec3& p : pyramid.positions) p.z = p.x == 1 && p.y == 1 ? 3 : 0;
    const ExtrudeResult r = extrude(pyramid, {.level = 0});
    CHECK(r.wall_faces == 0);
    CHECK(volume_of_solid(pyramid, {.level = 0}) == Approx(inspect(r.mesh).volume.value_or(0)));
}

TEST_CASE("vertical faces are allowed, and vanish in a flat side", "[geometry]") {
    Mesh steps; // z = 0 for x < 1, then a cliff, then z = 2
    for (const auto& [x, z] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}, {3.0, 2.0}})
        for (const double y : {0.0, 1.0}) steps.positions.push_back({x, y, z});
    for (Index i = 0; i < 3; ++i)
        for (const Index c : {0U, 2U, 1U, 1U, 2U, 3U}) steps.corners.push_back(2 * i + c);
    const ExtrudeResult r = extrude(steps, {.level = -1});
    REQUIRE(r.refused == NoSolid::none);
    const Properties p = inspect(r.mesh);
    CHECK(p.closed);
    CHECK(p.oriented);
    CHECK(p.volume.value_or(0) == Approx(1 + 2 * 3));
}

TEST_CASE("extrude follows the axis and the transform of a part", "[geometry]") {
    Mesh y_up = slope();
    for (Vec3& p : y_up.positions) p = {p.x, p.z, -p.y};
    CHECK(volume_of_solid(y_up, {.axis = 1, .level = -1}) == Approx(36));
    Transform mirrored;
    mirrored.m[0][0] = -2;
    mirrored.m[2][3] = 10;
    for (const Mesh& mesh : {slope(), reversed(slope())})
        CHECK(volume_of_solid(mesh, {.level = 9, .to_world = mirrored}) == Approx(-2 * 36)); // mirrored
    Mesh x_up = slope();
    for (Vec3& p : x_up.positions) p = {p.z, p.x, p.y};
    CHECK(volume_of_solid(x_up, {.axis = 0, .level = -1}) == Approx(36));
}

TEST_CASE("extrude keeps texture coordinates, and gives the flat side its normal", "[geometry]") {
    Mesh mesh = shapes::uv_cube();
    mesh.corners.resize(6); // one side of the cube
    for (auto& a : mesh.attributes)
        if (a.domain == Domain::face) FAIL("the cube has face attributes");
    drop_unused(mesh);
    Vec3 normal = cross(mesh.point(1) - mesh.point(0), mesh.point(2) - mesh.point(0));
    const std::size_t axis = normal.x != 0 ? 0 : normal.y != 0 ? 1 : 2;
    const ExtrudeResult r = extrude(mesh, {.axis = axis, .level = -3});
    REQUIRE(r.refused == NoSolid::none);
    const Attribute* normals = r.mesh.find("NORMAL", Domain::wedge);
    REQUIRE(normals);
    REQUIRE(r.mesh.find("TEXCOORD_0", Domain::wedge));
    for (Index f = 0; f < r.mesh.face_count(); ++f) {
        const Index c = r.mesh.face_begin(f);
        const Vec3 of_face =
            normalised(cross(r.mesh.point(c + 1) - r.mesh.point(c), r.mesh.point(c + 2) - r.mesh.point(c)));
        const Index w = r.mesh.corners[c];
        const Vec3 given{normals->value(w, 0), normals->value(w, 1), normals->value(w, 2)};
        CHECK(dot(of_face, given) == Approx(1));
    }
}

TEST_CASE("extrude refuses surfaces without a straight solid", "[geometry]") {
    Mesh fold; // back over itself between x = 2 and x = 3
    for (const auto& [x, z] : {std::pair{0.0, 0.0}, {3.0, 0.0}, {2.0, 1.0}, {4.0, 1.0}})
        for (const double y : {0.0, 1.0}) fold.positions.push_back({x, y, z});
    for (Index i = 0; i < 3; ++i)
        for (const Index c : {0U, 2U, 1U, 1U, 2U, 3U}) fold.corners.push_back(2 * i + c);
    const ExtrudeResult r = extrude(fold, {.level = -1});
    CHECK(r.refused == NoSolid::overhangs);
    REQUIRE(r.at);
    CHECK(r.at->x > 2);
    CHECK(r.at->x < 3);
    CHECK(extrude(shapes::cube(), {.level = -1}).refused == NoSolid::closed);
    CHECK(extrude(slope(), {.level = 2}).refused == NoSolid::level_crosses);
    CHECK(extrude(shapes::grid(2, 2), {.level = 0}).refused == NoSolid::level_crosses);
    CHECK(extrude(shapes::grid(2, 2), {.axis = 0, .level = -1}).refused == NoSolid::edge_on);
    Mesh mixed = slope();
    std::swap(mixed.corners[0], mixed.corners[1]);
    CHECK(extrude(mixed, {.level = -1}).refused == NoSolid::mixed);
}

} // namespace extrude_surface_test
