// The costs of edges four at a time, against those one by one.
#include "support/catch.hpp"

#include "base/progress.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/simplify/cost.hpp"
#include "geometry/simplify/features.hpp"
#include "geometry/simplify/methods.hpp"
#include "mesh/shapes.hpp"
#include "mesh/topology.hpp"

#include <map>

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

/// A square of n x n cells in the plane z = 0, one sheet on the other, joined along the border: closed, and
/// without a volume. slivers: at the border, faces without area lie between the two.
Mesh double_sheet(int n, bool slivers) {
    Mesh m = shapes::grid(n, n);
    const Index side = static_cast<Index>(n) + 1, front = static_cast<Index>(m.vertex_count());
    const auto on_border = [&](Index v) {
        return v % side == 0 || v % side == side - 1 || v / side == 0 || v / side == side - 1;
    };
    for (Index v = 0; v < front; ++v) m.positions.push_back(Vec3(m.positions[v]));
    const std::vector<Index> corners = m.corners;
    m.corners.clear();
    std::map<std::pair<Index, Index>, int> uses;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const Index u = corners[c], v = corners[c % 3 == 2 ? c - 2 : c + 1];
        ++uses[std::minmax(u, v)];
    }
    for (std::size_t f = 0; f < corners.size(); f += 3) {
        std::vector<Index> back;
        for (std::size_t k = 3; k-- > 0;)
            back.push_back(on_border(corners[f + k]) ? corners[f + k] : corners[f + k] + front);
        m.corners.insert(m.corners.end(), back.begin(), back.end());
        std::size_t open = 3; // the edge of this face that is to get a sliver
        for (std::size_t k = 0; k < 3 && slivers; ++k)
            if (uses[std::minmax(corners[f + k], corners[f + (k + 1) % 3])] == 1) open = k;
        if (open == 3) {
            m.corners.insert(m.corners.end(), corners.begin() + static_cast<std::ptrdiff_t>(f),
                             corners.begin() + static_cast<std::ptrdiff_t>(f + 3));
            continue;
        }
        const Index u = corners[f + open], v = corners[f + (open + 1) % 3], w = corners[f + (open + 2) % 3];
        const auto middle = static_cast<Index>(m.positions.size());
        m.positions.push_back((m.positions[u] + m.positions[v]) * 0.5);
        for (const Index x : {u, middle, w, middle, v, w, u, v, middle}) m.corners.push_back(x);
    }
    drop_unused(m);
    return m;
}

} // namespace

TEST_CASE("the edge of a sheet without thickness stays where it is", "[geometry]") {
    for (const bool slivers : {false, true})
        for (const double ratio : {0.5, 0.1, 0.05}) {
            const Mesh sheet = double_sheet(12, slivers);
            const SimplifyResult r = simplify(sheet, {.ratio = ratio});
            CAPTURE(slivers, ratio, r.faces_after);
            CHECK(r.faces_after < sheet.face_count());
            CHECK(deviation(sheet, r.mesh).maximum() < 1e-4);
        }
}

TEST_CASE("what is flat goes before what is hardly curved, however long its edges are", "[geometry]") {
    Mesh m = shapes::grid(40, 40);
    for (Vec3& p : m.positions)
        if (p.x > 20) p = {20 + 0.3 * (p.x - 20), p.y, 5e-5 * (p.x - 20) * (p.x - 20)};
    const SimplifyResult r = simplify(m, {.ratio = 0.6});
    CHECK(r.stop == SimplifyResult::Stop::ratio);
    // As long as lengths counted among such errors it was 1.3e-4.
    CHECK(deviation(m, r.mesh).maximum() < 4e-5);
}

TEST_CASE("fine quadrics are for surfaces with much that is flat", "[geometry]") {
    const auto is_fine = [](const Mesh& mesh) {
        State s = lay_out(mesh, UsedVertices(mesh));
        classify(s, mesh, {});
        set_quadrics(s);
        return s.fine.has_value();
    };
    CHECK(is_fine(shapes::grid(20, 20)));
    CHECK_FALSE(is_fine(crumple(shapes::grid(20, 20), {.amplitude = 1e-1}).mesh));
    CHECK_FALSE(is_fine(shapes::icosphere(4)));
}

TEST_CASE("costs four at a time are those one by one", "[geometry]") {
    const Mesh sphere = crumple(shapes::icosphere(3), {.amplitude = 1e-2}).mesh;
    const Mesh sheet = crumple(shapes::grid(17, 13), {.amplitude = 1e-1}).mesh;
    for (const bool endpoints : {false, true}) {
        CHECK(check_costs(priced(sphere, endpoints)) == 3 * sphere.face_count() / 2);
        CHECK(check_costs(priced(sheet, endpoints)) > sheet.face_count());
    }
}

TEST_CASE("passes that meet their goal tell that all is done", "[geometry][simplify]") {
    State s = priced(shapes::icosphere(3), false);
    std::atomic<double> heard{-1};
    const Share share(&heard);
    Goal goal;
    goal.faces = s.live_faces / 2;
    run_passes(s, goal);
    CHECK(s.live_faces <= goal.faces);
    CHECK(heard == 1);
}
