// Simplification that may change the topology: topology: allow, and the method cluster.

#include "geometry/simplify/simplify.hpp"

#include "geometry/crumple/crumple.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/split/split.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using Method = SimplifySettings::Method;
using Topology = SimplifySettings::Topology;
using Stop = SimplifyResult::Stop;
using test::count;
using test::sound;

namespace {

/// A sphere of radius 1 with crumbs around it: a tetrahedron, a small sphere and a lone triangle.
Mesh with_crumbs() {
    Mesh m = shapes::icosphere(3);
    Mesh crumb = shapes::icosphere(1), last = shapes::tetrahedron(), lone;
    for (auto& p : crumb.positions) p = p * 0.01 + Vec3{2, 0, 0};
    for (auto& p : last.positions) p = p * 0.01 + Vec3{0, 2, 0};
    lone.positions = {{0, 0, 2}, {0.01, 0, 2}, {0, 0.01, 2}};
    lone.corners = {0, 1, 2};
    append(m, crumb);
    append(m, last);
    append(m, lone);
    return m;
}

/// A sphere without the faces at a vertex.
Mesh with_hole() {
    Mesh m = shapes::icosphere(3), open = m;
    open.corners.clear();
    for (Index f = 0; f < m.face_count(); ++f)
        if (m.vertex(3 * f) != 100 && m.vertex(3 * f + 1) != 100 && m.vertex(3 * f + 2) != 100)
            for (Index c = 3 * f; c < 3 * f + 3; ++c) open.corners.push_back(m.corners[c]);
    drop_unused(open);
    return open;
}

} // namespace

TEST_CASE("topology: allow lets crumbs vanish, keep does not", "[geometry]") {
    const Mesh m = with_crumbs();
    for (const Method method : {Method::quadric, Method::quadric_endpoints, Method::shortest_edge}) {
        CHECK(inspect(simplify(m, {.method = method, .faces = 300}).mesh).components == 4);
        const auto r = simplify(m, {.method = method, .topology = Topology::allow, .faces = 300});
        CHECK(r.stop == Stop::faces);
        CHECK(r.mesh.face_count() == r.faces_after);
        CHECK(r.mesh.vertex_count() == r.vertices_after);
        CHECK(broken_invariants(r.mesh).empty());
        CHECK(sound(r.mesh, 2)); // only the sphere remains
        CHECK(r.mesh.bounds().max.x < 1.1);
    }
}

TEST_CASE("topology: allow goes down to nothing, and counts what it does", "[geometry]") {
    const auto r = simplify(shapes::icosphere(2), {.topology = Topology::allow, .faces = 1});
    CHECK(r.faces_after == r.mesh.face_count());
    CHECK(r.vertices_after == r.mesh.vertex_count());
    CHECK(r.faces_after < 4);
    CHECK(broken_invariants(r.mesh).empty());
}

TEST_CASE("topology: allow goes down to a number of faces and not far below it", "[geometry]") {
    // Equal cubes: each ends as a tetrahedron, whose last collapse removes four faces. At most the last
    // collapse goes beyond the target.
    Mesh m;
    for (int i = 0; i < 3000; ++i) {
        Mesh cube = shapes::cube();
        for (auto& p : cube.positions) p = p + Vec3{3.0 * (i % 60), 3.0 * (i / 60), 0};
        append(m, cube);
    }
    for (const Method method : {Method::quadric, Method::quadric_endpoints, Method::shortest_edge})
        for (const std::size_t faces : {20000, 6000, 1000}) {
            const auto r = simplify(m, {.method = method, .topology = Topology::allow, .faces = faces});
            CHECK(r.stop == Stop::faces);
            CHECK(r.faces_after <= faces);
            CHECK(r.faces_after + 4 > faces);
            CHECK(count(r.mesh).unbalanced == 0);
        }
}

TEST_CASE("topology: allow closes holes", "[geometry]") {
    const Mesh m = with_hole();
    REQUIRE(count(m).open > 0);
    const auto kept = simplify(m, {.method = Method::shortest_edge, .faces = 60});
    CHECK(count(kept.mesh).open > 0);
    const auto r = simplify(m, {.method = Method::shortest_edge, .topology = Topology::allow, .faces = 60});
    CHECK(sound(r.mesh, 2));
    CHECK(r.faces_after == r.mesh.face_count());
}

TEST_CASE("topology: allow pinches handles off and stays closed", "[geometry]") {
    const Mesh m = crumple(shapes::torus(60, 12), {.amplitude = 0.002}).mesh;
    const auto r = simplify(m, {.topology = Topology::allow, .faces = 12});
    CHECK(r.faces_after < simplify(m, {.faces = 12}).faces_after + 1);
    CHECK(count(r.mesh).unbalanced == 0);
    CHECK(count(r.mesh).duplicates == 0);
    CHECK(r.faces_after == r.mesh.face_count());
    CHECK(r.vertices_after == r.mesh.vertex_count());
}

TEST_CASE("topology: allow keeps what is locked, and every point with max_error", "[geometry]") {
    const Mesh m = with_crumbs();
    const std::vector<Plane> body{{{0, 1, 0}, {0, 1.5, 0}}};
    const auto locked = simplify(m, {.topology = Topology::allow, .lock = {.body = body}, .faces = 300});
    CHECK(inspect(locked.mesh).components == 2); // the sphere, and the locked tetrahedron
    const auto within = simplify(m, {.topology = Topology::allow, .max_error = 0.05});
    CHECK(within.stop == Stop::max_error);
    CHECK(deviation(m, within.mesh).maximum() <= 0.05);
    CHECK(within.mesh.face_count() == within.faces_after);
    const auto threads = [&] { return simplify(m, {.topology = Topology::allow, .faces = 200}).mesh; };
    CHECK(test::same_for_any_threads(threads));
}

TEST_CASE("cluster meets its targets by the size of the cells", "[geometry]") {
    const Mesh m = crumple(shapes::icosphere(5), {.amplitude = 0.001}).mesh; // 20480 faces
    for (const double ratio : {0.5, 0.1, 0.01}) {
        const auto r = simplify(m, {.method = Method::cluster, .ratio = ratio});
        CHECK(r.stop == Stop::ratio);
        CHECK(r.faces_after <= std::ceil(ratio * 20480));
        CHECK(static_cast<double>(r.faces_after) > 0.8 * ratio * 20480);
        CHECK(r.faces_after == r.mesh.face_count());
        CHECK(r.vertices_after == r.mesh.vertex_count());
        CHECK(*r.cell > 0);
        CHECK(count(r.mesh).unbalanced == 0);
        CHECK(broken_invariants(r.mesh).empty());
        // A vertex and the one it became share a cell.
        CHECK(deviation(m, r.mesh).maximum() < 1.8 * *r.cell);
    }
    const auto few = simplify(m, {.method = Method::cluster, .vertices = 500});
    CHECK(few.stop == Stop::vertices);
    CHECK(few.vertices_after <= 500u);
    CHECK(few.vertices_after > 400u);
}

TEST_CASE("cluster meets the planes of a cell where they meet", "[geometry]") {
    // The result has the corners of the box, although no cell's mean is at a corner.
    const Mesh m = split(shapes::cube(), {.passes = 4}).mesh;
    const auto coarse = simplify(m, {.method = Method::cluster, .ratio = 0.1});
    const Box box = coarse.mesh.bounds(), whole = m.bounds();
    CHECK(length(box.max - whole.max) < 1e-2);
    CHECK(length(box.min - whole.min) < 1e-2);
    CHECK(coarse.faces_after < 0.1 * m.face_count() + 1);
}

TEST_CASE("cluster stays within max_error and leaves something", "[geometry]") {
    const Mesh m = crumple(shapes::icosphere(4), {.amplitude = 0.002}).mesh;
    for (const double bound : {0.01, 0.05, 0.2}) {
        const auto r = simplify(m, {.method = Method::cluster, .max_error = bound});
        CHECK(r.stop == Stop::max_error);
        CHECK(*r.measured == deviation(m, r.mesh).maximum());
        CHECK(*r.measured <= bound);
        CHECK(*r.measured > 0.2 * bound);
        CHECK(r.faces_after < m.face_count());
    }
    const auto none = simplify(m, {.method = Method::cluster, .max_error = 1e-9});
    CHECK(none.faces_after == m.face_count());
    const auto least = simplify(shapes::tetrahedron(), {.method = Method::cluster, .faces = 1});
    CHECK(least.faces_after > 0);
    CHECK(least.stop == Stop::stuck);
}

TEST_CASE("cluster keeps thin sheets as double faces, islands of a texture apart, and its bytes",
          "[geometry]") {
    Mesh thin =
        split(shapes::cube(), {.passes = 4}).mesh; // a slab much thinner than a cell, off the grid's middle
    for (auto& p : thin.positions) p.z *= 1e-4;
    Mesh ball = shapes::icosphere(3);
    for (auto& p : ball.positions) p += Vec3{0, 0, 3.3};
    append(thin, ball);
    const auto r = simplify(thin, {.method = Method::cluster, .ratio = 0.1});
    Index of_slab = 0;
    for (Index f = 0; f < r.mesh.face_count(); ++f) of_slab += std::abs(r.mesh.point(3 * f).z) < 0.01;
    CHECK(of_slab > 20);
    CHECK(count(r.mesh).unbalanced == 0);
    CHECK(count(r.mesh).duplicates > 10); // front and back
    Mesh m = crumple(shapes::icosphere(5), {.amplitude = 0.001}).mesh;
    test::add_coordinates(m);
    const auto smooth = simplify(m, {.method = Method::cluster, .ratio = 0.1});
    const Attribute* at = smooth.mesh.find("coordinates", Domain::wedge);
    REQUIRE(at);
    double worst = 0;
    for (Index w = 0; w < smooth.mesh.wedge_count(); ++w)
        for (std::size_t k = 0; k < 3; ++k)
            worst = std::max(worst, std::abs(at->value(w, static_cast<int>(k)) -
                                             smooth.mesh.positions[smooth.mesh.vertex_of_wedge(w)][k]));
    CHECK(worst < 0.01); // values belong to the position, not to the cell's first vertex
    CHECK(test::same_for_any_threads(
        [&] { return simplify(m, {.method = Method::cluster, .ratio = 0.1}).mesh; }));
}

TEST_CASE("cluster and levels refuse what they cannot do", "[geometry]") {
    const auto refusal = [](const SimplifySettings& s) {
        return test::failure([&] { simplify(shapes::cube(), s); });
    };
    CHECK(refusal({.method = Method::cluster, .lock = {.boundary = true}, .faces = 5})
              .find("cannot lock vertices") != std::string::npos);
    CHECK(refusal({.method = Method::constrained, .topology = Topology::allow, .faces = 5}) ==
          "usage [E-CONFLICT] simplify: the method constrained always keeps the topology | use the method "
          "quadric");
    CHECK(refusal({.weights = {.uv = -1}, .faces = 5}).find("weights must be at least 0") !=
          std::string::npos);
    SimplifySettings levels;
    levels.method = Method::cluster;
    levels.levels = {0.5};
    CHECK(test::failure([&] { simplify_levels(shapes::cube(), levels); }) ==
          "usage [E-CONFLICT] simplify: lods needs a chain of collapses, which the method cluster does not "
          "have | use another method, or one simplify stage for each level");
}
