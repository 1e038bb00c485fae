// Laws of the shaping stages, over many surfaces: closed ones of several genera, open ones, broken ones.
#include "geometry/crumple/crumple.hpp"
#include "geometry/relax/relax.hpp"
#include "geometry/simplify/simplify.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using test::count;

namespace {

std::vector<Mesh> surfaces() {
    std::vector<Mesh> all{shapes::icosphere(3), shapes::torus(24, 12), shapes::uv_cube(),
                          shapes::quad_cube(),  shapes::grid(9, 7),    shapes::open_cone(40),
                          shapes::moebius(30),  shapes::bowtie(),      shapes::fan3(),
                          shapes::hourglass(),  shapes::folded_quad(), shapes::crossing()};
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        all.push_back(crumple(shapes::icosphere(3), {.amplitude = 0.03, .seed = seed}).mesh);
        all.push_back(crumple(shapes::torus(30, 14), {.amplitude = 0.02, .seed = seed}).mesh);
        all.push_back(crumple(shapes::grid(12, 10), {.amplitude = 0.3, .seed = seed}).mesh);
    }
    return all;
}

/// Counts that depend on the connectivity alone.
std::array<std::int64_t, 5> topology(const Mesh& m) {
    const auto c = count(m);
    return {c.euler, std::int64_t(c.crowded), std::int64_t(c.unbalanced > 0), std::int64_t(c.pinched),
            std::int64_t(c.open > 0)};
}

} // namespace

TEST_CASE("law: relaxing and crumpling keep the topology", "[property]") {
    for (const Mesh& m : surfaces()) {
        const Mesh relaxed = relax(m, {.iterations = 3}).mesh, crumpled = crumple(m, {.amplitude = 0.1}).mesh;
        CHECK(relaxed.corners == m.corners);
        CHECK(crumpled.corners == m.corners);
        CHECK(broken_invariants(relaxed).empty());
        CHECK(broken_invariants(crumpled).empty());
    }
}

TEST_CASE("law: crumpling by nothing is nothing", "[property]") {
    for (const Mesh& m : surfaces()) CHECK(crumple(m, {.amplitude = 0}).mesh.positions == m.positions);
}

TEST_CASE("law: relaxation stays within the bounds, and no lambda leaves them", "[property]") {
    for (const Mesh& m : surfaces())
        for (const double lambda : {0.25, 1.0}) {
            Box box = m.bounds();
            const Vec3 slack = box.extent() * 1e-12;
            box.add(box.min - slack);
            box.add(box.max + slack);
            for (const Vec3& p :
                 relax(m, {.iterations = 4, .lambda = lambda, .boundary = RelaxSettings::Boundary::free})
                     .mesh.positions)
                for (std::size_t i = 0; i < 3; ++i) CHECK((p[i] >= box.min[i] && p[i] <= box.max[i]));
        }
}

TEST_CASE("law: simplification keeps Euler's number, closedness and manifoldness", "[property]") {
    using Method = SimplifySettings::Method;
    for (const Mesh& m : surfaces())
        for (const Method method : {Method::quadric, Method::shortest_edge})
            for (const double ratio : {0.5, 0.1, 0.001}) {
                const auto r = simplify(m, {.method = method, .ratio = ratio});
                CHECK(broken_invariants(r.mesh).empty());
                CHECK(topology(r.mesh) == topology(m));
                CHECK(r.mesh.face_count() <= 2 * m.face_count());
                CHECK(count(r.mesh).duplicates <= count(m).duplicates);
                CHECK(count(r.mesh).flat <= count(m).flat);
                if (r.stop == SimplifyResult::Stop::ratio)
                    CHECK(double(r.faces_after) <= std::ceil(double(r.faces_before) * ratio));
            }
}

TEST_CASE("law: simplifying what was simplified to the same target does nothing", "[property]") {
    for (const Mesh& m : surfaces()) {
        const auto once = simplify(m, {.ratio = 0.3});
        if (once.stop != SimplifyResult::Stop::ratio) continue;
        const auto again = simplify(once.mesh, {.faces = once.faces_after});
        CHECK(again.stop == SimplifyResult::Stop::nothing);
        CHECK(test::same(again.mesh, once.mesh));
    }
}
