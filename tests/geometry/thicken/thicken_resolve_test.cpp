#include "support/catch.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/thicken/thicken.hpp"
#include "mesh/invariants.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// A ball with dents and spikes, whose copy at the thickness folds over.
Mesh rough_ball() { return test::noisy_icosphere(2, 0.3, 1); }

ThickenResult resolved(const Mesh& mesh, double thickness, ThickenSide side, const Transform& to_world = {}) {
    const ThickenSettings plain{.thickness = thickness, .side = side, .to_world = to_world};
    const ThickenResult folded = thicken(mesh, plain);
    CHECK(folded.self_intersections.value_or(0) > 0);
    CHECK_FALSE(folded.resolved);
    ThickenSettings settings = plain;
    settings.resolve = true;
    ThickenResult r = thicken(mesh, settings);
    CHECK(r.resolved);
    CHECK(r.turned == 0);
    CHECK(r.self_intersections == 0);
    CHECK(broken_invariants(r.mesh).empty());
    const Properties p = inspect(r.mesh);
    CHECK(p.closed);
    CHECK(p.edge_manifold);
    CHECK(p.oriented);
    CHECK(find_self_intersections(r.mesh, {.separate_touching = true}).count == 0);
    return r;
}

} // namespace

TEST_CASE("thicken makes a hollow solid again where its walls fold", "[geometry]") {
    const Mesh ball = rough_ball();
    const double whole = test::volume(ball);
    const ThickenResult inward = resolved(ball, 0.2, ThickenSide::inward);
    CHECK(test::volume(inward.mesh) < 0.8 * whole); // it is hollow
    CHECK(test::volume(inward.mesh) > 0.2 * whole);
    CHECK(inspect(inward.mesh).components == 2); // no splinters
    CHECK(inward.wall->thinnest > 0.02);
    const ThickenResult outward = resolved(ball, 0.8, ThickenSide::outward);
    CHECK(test::volume(outward.mesh) > 0.2 * whole);
    CHECK(inspect(outward.mesh).components == 2);
    CHECK(outward.mesh.bounds().max.x > ball.bounds().max.x);
    CHECK(resolved(ball, 0.5, ThickenSide::centred).wall->thinnest > 0.02);
}

TEST_CASE("thicken resolves walls of open surfaces, and in the world's lengths", "[geometry]") {
    Mesh open = rough_ball();
    open.corners.resize(open.corners.size() - 3 * 20);
    drop_unused(open);
    CHECK(resolved(open, 0.2, ThickenSide::inward).wall_faces > 0);
    Transform tenfold;
    for (int i = 0; i < 3; ++i) tenfold.m[i][i] = 10;
    const Mesh ball = rough_ball();
    CHECK(resolved(ball, 2, ThickenSide::inward, tenfold).wall->thinnest ==
          Approx(10 * resolved(ball, 0.2, ThickenSide::inward).wall->thinnest));
}

TEST_CASE("thicken leaves what does not fold as it is, also when it is to resolve", "[geometry]") {
    const Mesh cube = shapes::cube();
    const ThickenResult plain = thicken(cube, {.thickness = 0.1}),
                        same = thicken(cube, {.thickness = 0.1, .resolve = true});
    CHECK_FALSE(same.resolved);
    CHECK(same.mesh.positions == plain.mesh.positions);
    CHECK(same.mesh.corners == plain.mesh.corners);
}
