// The costs of edges four at a time, against those one by one.
#include "support/catch.hpp"

#include "geometry/crumple/crumple.hpp"
#include "geometry/simplify/cost.hpp"
#include "geometry/simplify/features.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;
using namespace facetmill::simplification;

namespace {

State priced(const Mesh& mesh, bool endpoints) {
    State s = lay_out(mesh, UsedVertices(mesh));
    classify(s, mesh, {});
    s.quadrics = vertex_quadrics(s);
    s.rules.endpoints = endpoints;
    price_all(s);
    return s;
}

/// Edges that have a cost; each is checked.
std::size_t check_costs(const State& s) {
    std::size_t priced = 0;
    for (Index c = 0; c < s.tri.size(); ++c) {
        if (!(s.cost[c] < never)) continue;
        const double one = cost_of(s, c, s.flags[c]);
        // Single precision, and another pull to the middle where the planes leave the place free.
        CHECK(s.cost[c] == Approx(one).epsilon(1e-2));
        ++priced;
    }
    return priced;
}

} // namespace

TEST_CASE("costs four at a time are those one by one", "[geometry]") {
    const Mesh sphere = crumple(shapes::icosphere(3), {.amplitude = 1e-2}).mesh;
    const Mesh sheet = crumple(shapes::grid(17, 13), {.amplitude = 1e-1}).mesh;
    for (const bool endpoints : {false, true}) {
        CHECK(check_costs(priced(sphere, endpoints)) == 3 * sphere.face_count() / 2);
        CHECK(check_costs(priced(sheet, endpoints)) > sheet.face_count());
    }
}
