#include "support/catch.hpp"

#include "geometry/clean/clean.hpp"
#include "geometry/orient/orient.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;

namespace {

/// A cube of that size about a point, its front outside or inside.
Mesh cube(double size, const Vec3& middle, bool inward) {
    Mesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p = middle + (p - Vec3{0.5, 0.5, 0.5}) * size;
    if (inward) flip_faces(mesh, std::vector<std::uint8_t>(mesh.face_count(), 1));
    return mesh;
}

/// The piece of each of the mesh's cubes.
std::vector<Index> of_cubes(const Mesh& mesh) {
    const Components pieces = solid_components(mesh);
    std::vector<Index> of;
    for (std::size_t f = 0; f < mesh.face_count(); f += 12) of.push_back(pieces.of_face[f]);
    return of;
}

} // namespace

TEST_CASE("a cavity belongs to the innermost solid around it", "[geometry]") {
    Mesh mesh = cube(1, {0, 0, 0}, true); // the cavity of the inner solid comes first
    append(mesh, cube(9, {0, 0, 0}, false));
    append(mesh, cube(7, {0, 0, 0}, true));
    append(mesh, cube(3, {0, 0, 0}, false));
    append(mesh, cube(1, {4, 0, 0}, true)); // inside the outer solid's wall
    append(mesh, cube(2, {20, 0, 0}, false));
    CHECK(of_cubes(mesh) == std::vector<Index>{0, 1, 1, 0, 1, 2});
    CHECK(solid_components(mesh).count == 3);
}

TEST_CASE("what lies in no solid, faces outward or is open is a component of its own", "[geometry]") {
    Mesh mesh = cube(9, {0, 0, 0}, false);
    append(mesh, cube(1, {0, 0, 0}, false));
    append(mesh, cube(1, {20, 0, 0}, true));
    CHECK(of_cubes(mesh) == std::vector<Index>{0, 1, 2});
    mesh = cube(9, {0, 0, 0}, false);
    append(mesh, cube(1, {0, 0, 0}, true));
    CHECK(of_cubes(mesh) == std::vector<Index>{0, 0});
    mesh.corners.resize(mesh.corners.size() - 3); // the cavity is open
    CHECK(of_cubes(mesh) == std::vector<Index>{0, 1});
}
