#include "geometry/align/align.hpp"

#include "base/math/portable_math.hpp"
#include "mesh/shapes.hpp"
#include "mesh/transform.hpp"
#include "support/catch.hpp"

using namespace facetmill;

namespace {

/// A box of unequal sides with a mark at one corner, so that only one pose fits.
Mesh marked_box() {
    Mesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p = {p.x * 3, p.y * 2, p.z};
    Mesh mark = shapes::tetrahedron();
    for (Vec3& p : mark.positions) p = p * 0.3 + Vec3{3, 2, 1};
    append(mesh, mark);
    return mesh;
}

Mesh moved(Mesh mesh, double angle) {
    const Vec3 axis = normalised(Vec3{1, 2, 3});
    for (Vec3& p : mesh.positions) p = rotated(p, axis, angle) + Vec3{10, -4, 7};
    return mesh;
}

} // namespace

TEST_CASE("align: a moved copy comes back exactly", "[align]") {
    for (const double angle : {0.3, 1.5, 3.0}) {
        CAPTURE(angle);
        const Mesh target = marked_box(), copy = moved(target, angle);
        const AlignResult r = align(surface_of(copy), surface_of(target), {});
        CHECK(r.settled);
        CHECK(r.after < 1e-6);
        for (std::size_t v = 0; v < copy.positions.size(); ++v)
            CHECK(length(r.move.point(copy.positions[v]) - target.positions[v]) < 1e-5);
        CHECK(r.move.determinant() == Approx(1));
        CHECK(r.starts == 25);
    }
}

TEST_CASE("align: a part of a surface fits with fewer samples", "[align]") {
    const Mesh target = marked_box();
    Mesh more = moved(target, 0.1);
    Mesh extra = shapes::icosphere(1);
    for (Vec3& p : extra.positions) p = p * 0.5 + Vec3{14, -4, 9};
    append(more, extra);
    AlignSettings s;
    s.keep = 0.7;
    const AlignResult r = align(surface_of(more), surface_of(target), s);
    CHECK(r.after < 1e-3);
}

TEST_CASE("align: symmetric, flat and empty surfaces do not fail", "[align]") {
    const Mesh sphere = shapes::icosphere(3);
    CHECK(align(surface_of(moved(sphere, 1)), surface_of(sphere), {}).after < 0.01);
    const Mesh grid = shapes::grid(4, 3);
    CHECK(align(surface_of(moved(grid, 1)), surface_of(grid), {}).after < 1e-6);
    CHECK(align(Surface{}, surface_of(sphere), {}).move.identity());
    CHECK(align(surface_of(sphere), Surface{}, {}).starts == 0);
    Mesh point = shapes::cube();
    for (Vec3& p : point.positions) p = {1, 1, 1};
    CHECK(align(surface_of(point), surface_of(sphere), {}).after < 1e-6);
}

TEST_CASE("align: the result does not depend on the number of threads", "[align]") {
    const Mesh target = marked_box(), copy = moved(target, 2);
    set_threads(1);
    const AlignResult one = align(surface_of(copy), surface_of(target), {});
    set_threads(4);
    const AlignResult four = align(surface_of(copy), surface_of(target), {});
    set_threads(0);
    CHECK(one.move == four.move);
}
