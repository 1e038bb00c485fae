#include "geometry/hidden/hidden.hpp"

#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"

#include <algorithm>

using namespace facetmill;

namespace {

std::size_t count_hidden(const Mesh& mesh, double gap) {
    const Surface surface = surface_of(mesh);
    const FaceTree tree(surface, FaceTree::Use::rays);
    const HiddenFaces r = hidden_faces(surface, tree, mesh.face_count(), {.gap = gap});
    return static_cast<std::size_t>(std::count(r.flags.begin(), r.flags.end(), 1));
}

/// A sphere around a small cube.
Mesh sphere_around_cube() {
    Mesh mesh = shapes::icosphere(3);
    Mesh cube = shapes::cube();
    for (Vec3& p : cube.positions) p = p * 0.2;
    append(mesh, cube);
    return mesh;
}

} // namespace

TEST_CASE("hidden: what is inside a closed surface, and nothing else", "[hidden]") {
    CHECK(count_hidden(sphere_around_cube(), 0.1) == 12);
    CHECK(count_hidden(shapes::torus(24, 12), 0.1) == 0);
    CHECK(count_hidden(shapes::cube(), 0.1) == 0);
}

TEST_CASE("hidden: a wide opening shows the inside", "[hidden]") {
    Mesh mesh = sphere_around_cube();
    Mesh open;
    open.positions = mesh.positions;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto w = mesh.face_wedges(f);
        const bool cap = mesh.positions[w[0]].z > 0.8 && f < 1280;
        if (!cap) open.corners.insert(open.corners.end(), w.begin(), w.end());
    }
    CHECK(count_hidden(open, 0.1) < 12);
}

TEST_CASE("hidden: coincident faces do not hide each other", "[hidden]") {
    Mesh twice = shapes::cube();
    append(twice, shapes::cube());
    CHECK(count_hidden(twice, 0.1) == 0);
}

TEST_CASE("hidden: an absurd gap is refused with the number of rays", "[hidden]") {
    CHECK(test::failure_id([] { static_cast<void>(count_hidden(shapes::cube(), 1e-9)); }) == "E-LIMIT");
    CHECK(outer_ray_count(shapes::cube().bounds(), 0.01) > 800000);
}
