#include "geometry/relax/relax.hpp"

#include "base/error.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using Boundary = RelaxSettings::Boundary;
using Neighbours = RelaxSettings::Neighbours;

namespace {

Index vertex_at(const Mesh& m, const Vec3& p) {
    return static_cast<Index>(std::find(m.positions.begin(), m.positions.end(), p) - m.positions.begin());
}

/// A 2 x 2 sheet of quads whose middle is raised by 8.
Mesh raised_quads() {
    Mesh m;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            m.positions.push_back({double(x), double(y), x == 1 && y == 1 ? 8.0 : 0.0});
    for (Index y = 0; y < 2; ++y)
        for (Index x = 0; x < 2; ++x) {
            const Index a = 3 * y + x;
            add_face(m, std::array<Index, 4>{a, a + 1, a + 4, a + 3});
        }
    return m;
}

} // namespace

TEST_CASE("a step of relaxation puts a vertex at its neighbours' mean", "[geometry]") {
    Mesh m = shapes::octahedron();
    m.positions[0] += Vec3{0.25, 0.5, 0.125};
    const auto r = relax(m);
    Index opposite = none;
    for (Index v = 1; v < 6; ++v)
        if (length(m.positions[v] + shapes::octahedron().positions[0]) < 1e-12) opposite = v;
    REQUIRE(opposite != none);
    // The four others are the neighbours of both, so both move to their mean, the centre.
    CHECK(length(r.mesh.positions[0]) < 1e-15);
    CHECK(length(r.mesh.positions[opposite]) < 1e-15);
    CHECK(r.moved == 6);
    CHECK(r.largest_move == Approx(length(m.positions[0])));
}

TEST_CASE("lambda goes part of the way", "[geometry]") {
    const auto r = relax(raised_quads(), {.lambda = 0.25});
    CHECK(r.mesh.positions[4] == Vec3{1, 1, 6});
}

TEST_CASE("neighbours of a quad's corner: through faces its diagonal counts, along edges it does not",
          "[geometry]") {
    Mesh m = raised_quads();
    m.positions[0].z = 8; // a far corner of the middle vertex
    CHECK(relax(m, {.neighbours = Neighbours::faces}).mesh.positions[4].z == 1);
    CHECK(relax(m, {.neighbours = Neighbours::edges}).mesh.positions[4].z == 0);
}

TEST_CASE("a fixed boundary stays, a sliding one stays on its line, a free one shrinks", "[geometry]") {
    const Mesh m = shapes::grid(4, 4);
    const auto fixed = relax(m, {.iterations = 3, .boundary = Boundary::fixed});
    CHECK(fixed.held == 16);
    CHECK(fixed.mesh.bounds().max == m.bounds().max);
    const Index side = vertex_at(m, {2, 0, 0}), corner = vertex_at(m, {0, 0, 0});
    CHECK(fixed.mesh.positions[side] == m.positions[side]);
    const auto slid = relax(m, {.iterations = 1, .boundary = Boundary::slide});
    CHECK(slid.mesh.positions[side] == m.positions[side]);
    CHECK(slid.mesh.positions[corner] == Vec3{0.5, 0.5, 0});
    CHECK(slid.held == 0);
    const auto free = relax(m, {.iterations = 1, .boundary = Boundary::free});
    CHECK(free.mesh.positions[side].y > 0);
}

TEST_CASE("no iteration leaves the mesh as it is", "[geometry]") {
    const Mesh m = raised_quads();
    const auto r = relax(m, {.iterations = 0});
    CHECK(test::same(r.mesh, m));
    CHECK(r.moved == 0);
}

TEST_CASE("relaxation takes degenerate, non-manifold and isolated input", "[geometry]") {
    Mesh m = shapes::fan3();
    m.positions.push_back({7, 7, 7});
    add_face(m, std::array<Index, 3>{0, 0, 1});
    const auto r = relax(m, {.iterations = 5, .boundary = Boundary::free});
    CHECK(broken_invariants(r.mesh).empty());
    CHECK(r.mesh.positions.back() == Vec3{7, 7, 7});
    for (const Mesh& shape : {shapes::bowtie(), shapes::hourglass(), shapes::moebius(8), Mesh{}})
        CHECK(broken_invariants(relax(shape, {.iterations = 2, .boundary = Boundary::slide}).mesh).empty());
}

TEST_CASE("relaxation recomputes normals and keeps the rest", "[geometry]") {
    const auto r = relax(shapes::uv_cube());
    REQUIRE(r.changes.size() == 2);
    for (const auto& change : r.changes)
        CHECK(change.kind == (change.attribute == "NORMAL" ? AttributeChange::Kind::recomputed
                                                           : AttributeChange::Kind::kept));
    CHECK(broken_invariants(r.mesh).empty());
}

TEST_CASE("relaxation gives the same bytes for any number of threads", "[geometry]") {
    CHECK(test::same_for_any_threads([] { return relax(shapes::torus(200, 100), {.iterations = 4}).mesh; }));
}

TEST_CASE("relaxation refuses settings out of range", "[geometry]") {
    CHECK(test::failure([] { relax(shapes::cube(), {.iterations = -1}); }) ==
          "usage [E-RANGE] relax: iterations is at least 0, not -1");
    CHECK(test::failure([] { relax(shapes::cube(), {.lambda = 1.5}); }) ==
          "usage [E-RANGE] relax: lambda is 0 < x <= 1, not 1.5");
}
