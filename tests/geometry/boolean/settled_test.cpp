// Compares the work that skips faces around rings with the work on all edges and faces.
#include "support/catch.hpp"
#include "support/clean_laws.hpp"
#include "support/corpus.hpp"
#include "support/meshes.hpp"

#include "geometry/boolean/boolean_pass.hpp"
#include "geometry/boolean/settled.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/face.hpp"

using namespace facetmill;
using namespace facetmill::test;
using namespace facetmill::clean_steps;

namespace {

/// The same as is_tidy, but tests the whole mesh.
bool is_tidy_all_over(const Mesh& mesh) {
    const auto place = lowest_at_place(mesh);
    for (Index v = 0; v < place.size(); ++v)
        if (place[v] != v) return false;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (is_degenerate(mesh, f)) return false;
    const EdgeTable edges = build_edges(mesh);
    for (Index e = 0; e < edges.size(); ++e) {
        const auto at = edges.corners_of(e);
        if (at.size() != 2 || mesh.vertex(at[0]) == mesh.vertex(at[1])) return false;
    }
    return duplicate_faces(mesh).empty() && disjoint_fans(mesh, edges).copies.empty();
}

struct Seen {
    std::size_t rings = 0, tidy = 0, not_tidy = 0;
};

/// Checks that solids and their unions are the same with and without rings.
void check_rings(Mesh mesh, Seen& seen) {
    const auto [found, rings] = crossings_and_rings(mesh, lowest_at_place(mesh), clean_steps::max_pairs, {});
    if (rings.empty() || found.count > 20'000) return;
    ++seen.rings;
    const Solids without = find_solids(mesh, found), with = find_solids(mesh, found, rings);
    REQUIRE(with.components.count == without.components.count);
    CHECK(with.components.of_face == without.components.of_face);
    CHECK(with.closed == without.closed);
    CHECK(with.why_not == without.why_not);
    CHECK(with.edges.size() <= without.edges.size());
    CHECK(overlaps_at_edges(mesh, with.rings, with.edges) == overlaps_at_edges(mesh));
    Mesh other = mesh;
    const United one = unite(mesh, without, found, {}), two = unite(other, with, found, {});
    CHECK(one.settled.empty());
    CHECK(one.refused.size() == two.refused.size());
    CHECK(one.covered_faces == two.covered_faces);
    CHECK(same_mesh(one.mesh, two.mesh));
    if (!two.refused.empty()) return;
    const bool closed = std::count(with.closed.begin(), with.closed.end(), 0) == 0;
    if (!closed) return; // Trial requires it for what is_tidy requires
    const bool quick = is_tidy(two.mesh, two.settled, two.uncut_faces), all = is_tidy_all_over(two.mesh);
    CHECK(quick == all);
    ++(quick ? seen.tidy : seen.not_tidy);
}

Mesh both(Mesh a, const Mesh& b) {
    append(a, b);
    weld_exact(a);
    return a;
}

} // namespace

TEST_CASE("solids and unions are the same with rings known and unknown", "[geometry][combine][property]") {
    Seen seen;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        INFO("seed " << seed);
        const Mesh ball = noisy_icosphere(3, 0.1, seed), ring = noisy_torus(24, 12, 0.05, seed);
        const Vec3 by = random_point(0.8, seed, 5);
        check_rings(both(ball, moved(ring, by)), seen);
        check_rings(both(ring, moved(ring, by)), seen);
        check_rings(both(snapped(ball, 0.125), moved(snapped(ball, 0.125), {0.25, 0.125, 0})), seen);
        check_rings(both(shapes::cube(), moved(shapes::cube(), {0.5, 0.25 * double(seed % 5), 0})), seen);
        check_rings(with_noise(shapes::torus(24, 12), 0.3, seed), seen); // through itself
        check_rings(random_triangles(60, 0.3, seed), seen);              // open
        check_rings(both(ball, moved(ball, {0.5, 0, 0})), seen);
    }
    CHECK(seen.rings > 20);
    CHECK(seen.tidy > 8);
    CHECK(seen.not_tidy > 1);
}

TEST_CASE("solids and unions of the corpus are the same with rings known and unknown",
          "[geometry][combine][property]") {
    const auto folder = corpus();
    if (!folder) return;
    Seen seen;
    check_corpus(*folder, [&](const Mesh& mesh, std::uint64_t) {
        if (mesh.face_count() == 0 || mesh.face_count() > 40'000) return;
        Mesh bare;
        bare.positions = mesh.positions;
        for (const Index c : triangulated(mesh).corners) bare.corners.push_back(mesh.vertex_of_wedge(c));
        weld_exact(bare);
        const Vec3 size = bare.bounds().extent();
        check_rings(bare, seen);
        check_rings(both(bare, moved(bare, {size.x * 0.13, size.y * 0.07, size.z * 0.03})), seen);
    });
    CHECK(seen.rings > 100);
    CHECK(seen.tidy > 10);
}

TEST_CASE("what is not tidy is seen where vertices are not settled", "[geometry][combine]") {
    const Mesh ball = shapes::icosphere(3);
    const auto tidy = [&](const Mesh& mesh, const std::vector<Index>& unsettled) {
        std::vector<std::uint8_t> settled(mesh.vertex_count(), 1);
        for (const Index v : unsettled) settled[v] = 0;
        CHECK(is_tidy(mesh, settled, ball.face_count()) == is_tidy_all_over(mesh));
        return is_tidy(mesh, settled, ball.face_count());
    };
    const Index a = ball.corners[0], b = ball.corners[1], c = ball.corners[2];
    CHECK(tidy(ball, {}));
    CHECK(tidy(ball, {a, b, c}));
    CHECK_FALSE(is_tidy(ball, {}, ball.face_count())); // nothing is known
    Mesh twice = ball;
    add_face(twice, std::array{a, b, c});
    CHECK_FALSE(tidy(twice, {a, b, c}));
    Mesh turned = ball;
    std::swap(turned.corners[0], turned.corners[1]);
    CHECK_FALSE(tidy(turned, {a, b, c}));
    Mesh open = ball;
    open.corners.erase(open.corners.begin(), open.corners.begin() + 3);
    CHECK_FALSE(tidy(open, {a, b, c}));
    Mesh touching = ball; // two fans at a
    Index far = a;
    for (Index v = 0; v < ball.vertex_count(); ++v)
        if (length(ball.positions[v] - ball.positions[a]) > length(ball.positions[far] - ball.positions[a]))
            far = v;
    for (Index& v : touching.corners)
        if (v == far) v = a;
    CHECK_FALSE(tidy(touching, {a, far}));
    Mesh at_one_place = ball;
    at_one_place.positions[far] = at_one_place.positions[a];
    CHECK_FALSE(tidy(at_one_place, {a, far}));
    Mesh walled = ball; // a separate sheet of two faces
    const auto v = static_cast<Index>(ball.vertex_count());
    for (const Vec3& p : {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}}) walled.positions.push_back(p);
    add_face(walled, std::array{v, v + 1, v + 2});
    add_face(walled, std::array{v, v + 2, v + 1});
    CHECK_FALSE(tidy(walled, {v, v + 1, v + 2}));
    Mesh flat = shapes::cube(); // closed, but with a face of no area along an edge
    const Index d = flat.corners[0], e = flat.corners[1], f = flat.corners[2];
    const auto middle = static_cast<Index>(flat.vertex_count());
    flat.positions.push_back(mix(flat.positions[d], flat.positions[e], 0.5));
    flat.corners[1] = middle;
    add_face(flat, std::array{middle, e, f});
    add_face(flat, std::array{d, e, middle});
    const std::vector<std::uint8_t> unsettled(flat.vertex_count(), 0);
    const auto faces = static_cast<Index>(flat.face_count());
    CHECK(is_tidy(flat, unsettled, faces)); // it is not looked at
    CHECK_FALSE(is_tidy(flat, unsettled, faces - 1));
}
