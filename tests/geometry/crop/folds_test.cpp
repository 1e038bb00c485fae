#include "geometry/crop/folds.hpp"

#include "geometry/inspect/inspect.hpp"
#include "support/catch.hpp"

using namespace facetmill;

namespace {

/// A tetrahedron, and these triangles of a fourth vertex beside an edge of it.
Mesh tetrahedron_and(const std::vector<Index>& more) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 1e-14, -1e-14}};
    mesh.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    mesh.corners.insert(mesh.corners.end(), more.begin(), more.end());
    return mesh;
}

} // namespace

TEST_CASE("a wall that lies on a kept triangle goes with it where an edge has more than two faces",
          "[geometry]") {
    Mesh mesh = tetrahedron_and({0, 1, 4, 4, 1, 0}); // the last is a wall
    CHECK_FALSE(inspect(mesh).edge_manifold);
    CHECK(remove_folds(mesh, 5) == 1);
    CHECK(mesh.corners == std::vector<Index>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2});
    CHECK(inspect(mesh).closed);
    CHECK(inspect(mesh).edge_manifold);
}

TEST_CASE("what lies on walls otherwise stays", "[geometry]") {
    Mesh alike = tetrahedron_and({0, 1, 4, 0, 1, 4}); // the same way round
    CHECK(remove_folds(alike, 5) == 0);
    CHECK(alike.face_count() == 6);
    Mesh kept = tetrahedron_and({0, 1, 4, 4, 1, 0}); // no wall is among them
    CHECK(remove_folds(kept, 6) == 0);
    Mesh apart; // two triangles back to back, whose edges have no other faces
    apart.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    apart.corners = {0, 1, 2, 2, 1, 0};
    CHECK(remove_folds(apart, 1) == 0);
    CHECK(apart.face_count() == 2);
}
