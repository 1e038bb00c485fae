#include "geometry/crumple/crumple.hpp"

#include "base/error.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using Boundary = CrumpleSettings::Boundary;
using Direction = CrumpleSettings::Direction;

TEST_CASE("Gaussian amounts have mean 0, deviation 1, and a cut that heaps nothing up", "[geometry]") {
    double sum = 0, squares = 0, most = 0;
    constexpr int n = 200000;
    for (std::uint64_t key = 0; key < n; ++key) {
        const double g = gaussian(key, 3);
        sum += g;
        squares += g * g;
        most = std::max(most, std::abs(g));
    }
    // The deviation of a normal distribution cut at 3 is 0.98658; four standard errors are allowed.
    CHECK(std::abs(sum / n) < 4 / std::sqrt(double(n)));
    CHECK(std::abs(std::sqrt(squares / n) - 0.98658) < 4 * 0.7 / std::sqrt(double(n)));
    CHECK(most < 3);
    CHECK(most > 2.99);
    for (std::uint64_t key = 0; key < 1000; ++key) CHECK(std::abs(gaussian(key, 0.1)) < 0.1);
    std::vector<std::uint64_t> keys(1000);
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = 77 * i;
    std::vector<double> all(keys.size());
    for (const double truncate : {0.1, 1.0, 3.0, HUGE_VAL}) {
        gaussians(keys, truncate, all);
        for (std::size_t i = 0; i < keys.size(); ++i) CHECK(all[i] == gaussian(keys[i], truncate));
    }
}

TEST_CASE("the noise belongs to the place: -0 is 0, and float32 decides", "[geometry]") {
    CHECK(noise_key(1, {0.0, 1, 2}) == noise_key(1, {-0.0, 1, 2}));
    CHECK(noise_key(1, {0, 1, 2}) == noise_key(1, {0, 1 + 1e-12, 2}));
    CHECK(noise_key(1, {0, 1, 2}) != noise_key(2, {0, 1, 2}));
    CHECK(noise_key(1, {0, 1, 2}) != noise_key(1, {1, 0, 2}));
}

TEST_CASE("far places are of 40 bits: what float32 cannot tell apart is, what rounding moved is not",
          "[geometry]") {
    using enum PositionRounding;
    const double northing = 5e6;
    CHECK(noise_key(1, {0, northing, 2}) == noise_key(1, {0, northing + 0.01, 2}));
    CHECK(noise_key(1, {0, northing, 2}, far) != noise_key(1, {0, northing + 0.01, 2}, far));
    CHECK(noise_key(1, {-0.0, northing, 2}, far) == noise_key(1, {0, std::nextafter(northing, 6e6), 2}, far));
    CHECK(noise_key(1, {0, northing, 2}, far) != noise_key(1, {0, -northing, 2}, far));
    CHECK(noise_key(1, {0, 0x1p23 - 0x1p-30, 0}, far) == noise_key(1, {0, 0x1p23, 0}, far));
    const CorrelatedNoise noise{.frequency = 10, .places = far};
    CHECK(noise.at(1, {0.55, northing, 0.55}) != noise.at(1, {0.55, northing + 0.01, 0.55}));
}

TEST_CASE("crumpling moves vertices by at most the truncated amplitude and keeps the topology",
          "[geometry]") {
    const Mesh m = shapes::icosphere(3);
    const auto r = crumple(m, {.amplitude = 0.01, .truncate = 2});
    CHECK(broken_invariants(r.mesh).empty());
    CHECK(r.mesh.corners == m.corners);
    CHECK(r.moved == m.vertex_count());
    CHECK(r.largest_move <= 0.02 * std::sqrt(3.0));
    CHECK(r.root_mean_square ==
          Approx(0.01 * std::sqrt(3.0) * 0.88).epsilon(0.05)); // 0.8796: deviation cut at 2
}

TEST_CASE("crumpling along the normal moves a flat sheet up and down only", "[geometry]") {
    const Mesh m = shapes::grid(5, 5);
    const auto r = crumple(m, {.amplitude = 0.1, .direction = Direction::normal});
    for (std::size_t v = 0; v < m.vertex_count(); ++v) {
        CHECK(r.mesh.positions[v].x == m.positions[v].x);
        CHECK(r.mesh.positions[v].y == m.positions[v].y);
        CHECK(r.mesh.positions[v].z != 0);
    }
}

TEST_CASE("a fixed boundary is not crumpled", "[geometry]") {
    const auto r = crumple(shapes::grid(3, 3), {.amplitude = 0.1, .boundary = Boundary::fixed});
    CHECK(r.held == 12);
    CHECK(r.moved == 4);
}

TEST_CASE("vertices at one place move together, welded or not, whatever their order", "[geometry]") {
    const Mesh whole = shapes::icosphere(2);
    Mesh loose; // every face separate, in reverse order
    for (Index f = static_cast<Index>(whole.face_count()); f-- > 0;)
        for (Index c = 3 * f; c < 3 * f + 3; ++c) {
            loose.corners.push_back(static_cast<Index>(loose.positions.size()));
            loose.positions.push_back(whole.point(c));
        }
    const CrumpleSettings s{.amplitude = 0.02, .seed = 5};
    const Mesh a = crumple(whole, s).mesh, b = crumple(loose, s).mesh;
    Index c = 0;
    for (Index f = static_cast<Index>(whole.face_count()); f-- > 0;)
        for (Index k = 3 * f; k < 3 * f + 3; ++k) CHECK(b.point(c++) == a.point(k));
}

TEST_CASE("along the normal, unwelded faces stay together too", "[geometry]") {
    const Mesh whole = shapes::cube();
    Mesh loose;
    for (Index c = 0; c < whole.corner_count(); ++c) {
        loose.corners.push_back(c);
        loose.positions.push_back(whole.point(c));
    }
    const CrumpleSettings s{.amplitude = 0.02, .direction = Direction::normal};
    const Mesh b = crumple(loose, s).mesh;
    for (Index c = 0; c < 36; ++c)
        for (Index d = 0; d < 36; ++d)
            if (whole.vertex(c) == whole.vertex(d)) CHECK(b.positions[c] == b.positions[d]);
}

TEST_CASE("a mask and a fixed boundary tear no unwelded copies apart", "[geometry]") {
    const Mesh whole = shapes::grid(6, 6);
    Mesh loose; // every face separate
    for (Index c = 0; c < whole.corner_count(); ++c) {
        loose.corners.push_back(c);
        loose.positions.push_back(whole.point(c));
    }
    CrumpleSettings s{.amplitude = 0.1, .boundary = Boundary::fixed};
    const auto same = [&](const Mesh& a, const Mesh& b) {
        for (Index c = 0; c < whole.corner_count(); ++c) CHECK(a.point(c) == b.point(c));
    };
    const CrumpleResult a = crumple(whole, s), b = crumple(loose, s);
    same(a.mesh, b.mesh); // the boundary of the surface counts, not the boundary of every face
    CHECK(a.moved == 25);
    s.boundary = Boundary::free;
    s.mask.assign(loose.vertex_count(), 1);
    s.mask[0] = 0.25;
    s.mask[9] = 0; // one copy of each place
    const Mesh masked = crumple(loose, s).mesh;
    CHECK(masked.positions[9] == loose.positions[9]);
    for (Index c = 0; c < loose.vertex_count(); ++c)
        for (Index d = 0; d < c; ++d)
            if (loose.positions[c] == loose.positions[d]) CHECK(masked.positions[c] == masked.positions[d]);
}

TEST_CASE("sheets that meet are held together", "[geometry]") {
    Mesh a = shapes::grid(2, 2), b = shapes::grid(2, 2);
    for (auto& p : b.positions) p.x += 2; // side by side
    CrumpleSettings s{.amplitude = 0.1};
    std::vector<CrumpleSheet> sheets{{&b, crumple_moves(b, s)}};
    s.mask.assign(a.vertex_count(), 0);
    sheets.push_back({&a, crumple_moves(a, s)});
    hold_joint_vertices(sheets);
    std::size_t met = 0;
    for (std::size_t v = 0; v < b.vertex_count(); ++v) {
        const bool shared = b.positions[v].x == 2;
        met += shared;
        CHECK((sheets[0].moves.moves[v] == Vec3{}) == shared);
    }
    CHECK(met == 3);
}

TEST_CASE("moves beyond float32 are refused", "[geometry]") {
    CHECK(
        test::failure([] { crumple(shapes::cube(), {.amplitude = 1e39}); }) ==
        "stage [E-RANGE] crumple: the amplitude 1e+39 moves vertices beyond 3.4e+38, the largest number that "
        "files hold | use a smaller amplitude");
}

TEST_CASE("the displacement is made in world space", "[geometry]") {
    Transform large;
    large.m[0][0] = large.m[1][1] = large.m[2][2] = 4;
    Mesh scaled = shapes::octahedron();
    apply(scaled, large);
    const auto world = crumple(scaled, {.amplitude = 0.1});
    const auto local = crumple(shapes::octahedron(), {.amplitude = 0.1, .to_world = large});
    for (std::size_t v = 0; v < 6; ++v)
        CHECK(length(large.point(local.mesh.positions[v]) - world.mesh.positions[v]) < 1e-15);
    CHECK(local.largest_move == world.largest_move);
}

TEST_CASE("crumpling gives the same bytes for any number of threads, and others for another seed",
          "[geometry]") {
    const auto make = [](std::uint64_t seed) {
        return crumple(shapes::torus(150, 80),
                       {.amplitude = 0.01, .direction = Direction::normal, .seed = seed})
            .mesh;
    };
    CHECK(test::same_for_any_threads([&] { return make(1); }));
    CHECK_FALSE(test::same(make(1), make(2)));
}

TEST_CASE("crumpling refuses what it cannot do", "[geometry]") {
    Transform flat;
    flat.m[2][2] = 0;
    CHECK(test::failure([&] { crumple(shapes::cube(), {.amplitude = 1, .to_world = flat}); }) ==
          "stage [E-TRANSFORM] crumple: the part's transform flattens it, so it has no inverse | apply or "
          "repair the transform first");
    CHECK(test::failure([] { crumple(shapes::cube(), {.amplitude = -1}); }) ==
          "usage [E-RANGE] crumple: amplitude must be at least 0, not -1");
}
