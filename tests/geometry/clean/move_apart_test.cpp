#include "support/catch.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "base/math/numbers.hpp"
#include "geometry/clean/clean.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/invariants.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <cmath>

using namespace facetmill;

namespace {

CleanSettings apart() {
    CleanSettings s;
    s.single = s.apart = true;
    return s;
}

bool has_equal_places(const Mesh& mesh) { return !clean_steps::are_distinct(lowest_at_place(mesh)); }

/// The mesh as a reader of a triangle file makes it: float32 positions, and merged vertices.
Mesh as_read_back(Mesh mesh) {
    for (Vec3& p : mesh.positions) p = as_float32(p);
    const std::vector<Index> lowest = lowest_at_place(mesh);
    for (Index& c : mesh.corners) c = lowest[c];
    return mesh;
}

bool is_sound(const Mesh& mesh) {
    const Properties p = inspect(mesh, {.self_intersections = true});
    return p.closed && p.edge_manifold && p.vertex_manifold && p.oriented && p.degenerate_faces == 0 &&
           p.duplicate_faces == 0 && p.self_intersections == 0;
}

Mesh together(Mesh a, const Mesh& b) {
    append(a, b);
    return a;
}

/// The largest move of a vertex. Both meshes must have the same vertices.
double farthest_move(const Mesh& before, const Mesh& after) {
    double most = 0;
    for (std::size_t v = 0; v < before.positions.size(); ++v)
        most = std::max(most, length(after.positions[v] - before.positions[v]));
    return most;
}

} // namespace

TEST_CASE("clean moves apart what was separated, so that joining equal positions joins none of it",
          "[geometry]") {
    const Mesh mesh = GENERATE(
        shapes::hourglass(), test::moved(shapes::hourglass(), {1000, -3, 0.25}),
        together(shapes::cube(), test::moved(shapes::cube(), {1, 1, 1})),            // a vertex
        together(shapes::cube(), test::moved(shapes::cube(), {1, 1, 0})),            // an edge
        together(shapes::cube(), test::moved(shapes::cube(), {1, 1, 0.5})),          // parts of edges
        together(shapes::quad_cube(), test::moved(shapes::quad_cube(), {-1, 0, 1})), // an edge of squares
        together(together(shapes::cube(), test::moved(shapes::cube(), {1, 1, 0})),
                 together(test::moved(shapes::cube(), {1, 0, 1}), test::moved(shapes::cube(), {0, 1, 1}))));
    CleanSettings s = apart();
    s.apart = false;
    const Mesh before = clean(mesh, s).mesh;
    const bool touches = has_equal_places(before);
    REQUIRE(is_sound(as_read_back(before)) == !touches);
    const CleanResult r = clean(mesh, apart());
    CHECK(broken_invariants(r.mesh).empty());
    CHECK(r.not_done.empty());
    CHECK((r.counts.moved_apart > 0) == touches);
    CHECK(is_sound(r.mesh));
    CHECK(is_sound(as_read_back(r.mesh)));
    CHECK(!has_equal_places(r.mesh));
    REQUIRE(r.mesh.corners == before.corners);
    CHECK(r.counts.farthest_apart == farthest_move(before, r.mesh));
    CHECK(clean(r.mesh, apart()).counts.total() == 0);
}

TEST_CASE("vertices are moved apart by two steps where that is enough", "[geometry]") {
    const Mesh mesh = test::moved(shapes::hourglass(), {1000, 0, 0});
    const CleanResult r = clean(mesh, apart());
    CHECK(r.counts.moved_apart == 1);
    const double step = std::ldexp(1.0, -14); // of float32 from 512 to 1024, and from 1024 twice that
    CHECK(r.counts.farthest_apart >= 2 * step);
    CHECK(r.counts.farthest_apart <= 2 * 2 * step * std::sqrt(3.0));
}

TEST_CASE("vertices that no step takes apart stay where they are and are told", "[geometry]") {
    // Steps are 1 here, and walls are two steps away on every side.
    Mesh walls = shapes::cube();
    for (Vec3& p : walls.positions) p = p * 4 - Vec3{2, 2, 2};
    const double far = 8388608 + 10;
    const Mesh mesh = test::moved(together(shapes::hourglass(), walls), {far, far, far});
    CleanSettings s = apart();
    s.apart = false;
    const Mesh before = clean(mesh, s).mesh;
    REQUIRE(has_equal_places(before));
    const CleanResult r = clean(mesh, apart());
    CHECK(r.counts.moved_apart == 0);
    CHECK(r.mesh.positions == before.positions);
    REQUIRE(r.not_done.size() == 1);
    CHECK(r.not_done[0].step == "apart");
}

TEST_CASE("without the steps that join and separate vertices none is moved apart", "[geometry]") {
    for (const bool weld : {true, false}) {
        CleanSettings s = apart();
        (weld ? s.non_manifold : s.single) = false;
        if (!weld) s.weld = Nearness::off;
        CHECK(clean(test::torn_apart(shapes::hourglass()), s).counts.moved_apart == 0);
    }
}
