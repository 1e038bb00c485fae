// The costs of edges four at a time, against those one by one.
#include "support/catch.hpp"

#include "geometry/crumple/crumple.hpp"
#include "geometry/simplify/price.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;
using namespace facetmill::simplification;

namespace {

Work prepared(const Mesh& mesh, bool endpoints) {
    Work s = build_work(mesh);
    classify(s, mesh, {});
    sum_quadrics(s);
    s.endpoints = endpoints;
    price_all(s);
    return s;
}

/// Edges that have a cost; each is checked.
std::size_t check_costs(const Work& s) {
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
        CHECK(check_costs(prepared(sphere, endpoints)) == 3 * sphere.face_count() / 2);
        CHECK(check_costs(prepared(sheet, endpoints)) > sheet.face_count());
    }
}
