// Compares the costs of edges computed four at a time with single costs.
#include "support/catch.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/simplify/cost.hpp"
#include "geometry/simplify/features.hpp"
#include "geometry/simplify/methods.hpp"
#include "mesh/shapes.hpp"
#include "mesh/topology.hpp"
#include "support/heard.hpp"

#include <array>
#include <cmath>
#include <map>

using namespace facetmill;
using namespace facetmill::simplification;

namespace {

State priced(const Mesh& mesh, bool endpoints) {
    State s = lay_out(mesh, UsedVertices(mesh));
    s.edges.cost.assign(s.tri.size(), never);
    classify(s, mesh, {});
    s.quadrics = {.near = vertex_quadrics(s), .fine = {}, .attributes = {}};
    s.rules.endpoints = endpoints;
    price_all(s);
    return s;
}

/// Edges that have a cost; each is checked.
std::size_t check_costs(const State& s) {
    std::size_t priced = 0;
    for (Index c = 0; c < s.tri.size(); ++c) {
        if (!(s.edges.cost[c] < never)) continue;
        const double one = cost_of(s, c, s.edges.flags[c]);
        // Single precision, and a different pull to the middle if the planes do not determine the position.
        CHECK(s.edges.cost[c] == Approx(one).epsilon(1e-2));
        ++priced;
    }
    return priced;
}

/// Two square sheets of n x n cells in the plane z = 0, joined along the border: closed and without volume.
/// slivers: faces without area lie between the two at the border.
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
        std::size_t open = 3; // the edge of this face that gets a sliver
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

/// A square plate of side 2 and thickness 0.05. Its upright edges are rounded with radius 1/8, in this many
/// steps each. Bottom and top are fans around a vertex of their outline.
Mesh rounded_plate(int steps) {
    constexpr double radius = 0.125;
    const std::array<Vec3, 4> centres{Vec3{1 - radius, 1 - radius, 0}, Vec3{radius - 1, 1 - radius, 0},
                                      Vec3{radius - 1, radius - 1, 0}, Vec3{1 - radius, radius - 1, 0}};
    std::vector<Vec3> outline;
    for (std::size_t k = 0; k < 4; ++k)
        for (int i = 0; i <= steps; ++i) {
            const double angle = (static_cast<double>(k) + static_cast<double>(i) / steps) * pi / 2;
            outline.push_back(centres[k] + Vec3{std::cos(angle), std::sin(angle), 0} * radius);
        }
    Mesh m;
    const auto n = static_cast<Index>(outline.size());
    m.positions = outline;
    for (const Vec3& p : outline) m.positions.push_back(p + Vec3{0, 0, 0.05});
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        add_face(m, std::array{i, j, n + j});
        add_face(m, std::array{i, n + j, n + i});
        if (i == 0 || j == 0) continue;
        add_face(m, std::array<Index, 3>{0, j, i});
        add_face(m, std::array{n, n + i, n + j});
    }
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

TEST_CASE("fillets beside large flat faces are not cheap", "[geometry]") {
    const Mesh plate = rounded_plate(16);
    const auto r = simplify(plate, {.ratio = 0.5});
    CHECK(r.stop == SimplifyResult::Stop::ratio);
    // Half of the edges of each fillet: its chords are off by radius * (1 - cos(360 / 64 degrees)) = 6e-4.
    CHECK(deviation(plate, r.mesh).maximum() < 8e-4);
}

TEST_CASE("fine quadrics are for surfaces with much that is flat", "[geometry]") {
    const auto is_fine = [](const Mesh& mesh) {
        State s = lay_out(mesh, UsedVertices(mesh));
        s.edges.cost.assign(s.tri.size(), never);
        classify(s, mesh, {});
        set_quadrics(s);
        return s.quadrics->fine.has_value();
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
    test::Heard heard;
    const ProgressScope share(&heard);
    Goal goal;
    goal.faces = s.rings.live_faces / 2;
    run_passes(s, goal);
    CHECK(s.rings.live_faces <= goal.faces);
    CHECK(heard.last() == 1);
    CHECK(heard.falls() == 0);
}
