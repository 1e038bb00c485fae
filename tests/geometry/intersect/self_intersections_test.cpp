#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/intersect/plain_stars.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "oracle/cgal_oracle.hpp"
#include "parallel/parallel.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

using Pairs = std::vector<std::pair<Index, Index>>;
constexpr SelfIntersectionSettings everything{.limit = SIZE_MAX};

/// Vertices snapped to a coarse grid: many coplanar, touching and equal positions, some triangles without
/// area.
} // namespace

TEST_CASE("sound shapes have no self-intersections", "[geometry]") {
    using namespace shapes;
    for (const Mesh& mesh : {cube(), quad_cube(), uv_cube(), icosphere(3), torus(20, 12), bowtie(), fan3(),
                             hourglass(), moebius(12), open_cone(9), Mesh{}})
        CHECK(find_self_intersections(mesh).count == 0);
}

TEST_CASE("triangles that cross, and a quad folded flat", "[geometry]") {
    const auto crossing = find_self_intersections(shapes::crossing());
    CHECK(crossing.count == 1);
    CHECK(crossing.pairs == Pairs{{0, 1}});
    CHECK(find_self_intersections(shapes::folded_quad()).pairs == Pairs{{0, 1}});
}

TEST_CASE("faces that share one vertex and run through each other", "[geometry]") {
    Mesh mesh = shapes::bowtie(); // the second triangle is rotated into the first and lifted at its far edge
    mesh.positions[3] = {-2, 0.1, -1};
    mesh.positions[4] = {-0.1, 0.1, 1};
    CHECK(find_self_intersections(mesh).pairs == Pairs{{0, 1}});
}

TEST_CASE("a face over the same vertices again meets it everywhere", "[geometry]") {
    Mesh mesh = shapes::tetrahedron();
    const Index again[] = {1, 0, 2};
    add_face(mesh, again);
    CHECK(find_self_intersections(mesh).pairs == Pairs{{0, 4}});
}

TEST_CASE("touching at equal positions of different vertices counts", "[geometry]") {
    const auto soup = torn_apart(shapes::tetrahedron());
    CHECK(find_self_intersections(soup).count == 6);
}

TEST_CASE("faces without area and infinite ones take no part", "[geometry]") {
    Mesh mesh = shapes::crossing();
    mesh.positions[2] = {1, 0, 0};
    CHECK(find_self_intersections(mesh).count == 0);
    mesh.positions[2] = {NAN, 0, 0};
    CHECK(find_self_intersections(mesh).count == 0);
}

TEST_CASE("polygons are counted once, and not against themselves", "[geometry]") {
    Mesh mesh = shapes::quad_cube();
    Mesh other = shapes::quad_cube();
    for (auto& p : other.positions) p += Vec3{0.5, 0.25, 0.125};
    append(mesh, other);
    const auto found = find_self_intersections(mesh, everything);
    CHECK(found.count == 6); // three faces of each cube near the common corners, pairwise across the axes
    for (const auto& [a, b] : found.pairs) CHECK((a < 6 && b >= 6));
}

TEST_CASE("the limit bounds the list and not the count", "[geometry]") {
    const Mesh mesh = random_triangles(200, 0.3, 5);
    const auto all = find_self_intersections(mesh, everything);
    const auto few = find_self_intersections(mesh, {.limit = 7});
    CHECK(all.pairs.size() == all.count);
    CHECK(few.count == all.count);
    CHECK(few.pairs == Pairs(all.pairs.begin(), all.pairs.begin() + 7));
}

TEST_CASE("the faces of all pairs but the exempt ones are flagged", "[geometry]") {
    const Mesh mesh = snapped(shapes::torus(24, 16), 0.37);
    const Pairs all = find_self_intersections(mesh, everything).pairs;
    REQUIRE(all.size() > 20);
    std::vector<std::uint8_t> among(mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); f += 3) among[f] = 1;
    for (const std::size_t spared : {std::size_t{0}, std::size_t{1}, all.size() / 2, all.size()}) {
        const std::span<const std::pair<Index, Index>> exempt(all.data(), spared);
        std::vector<std::uint8_t> wanted(mesh.face_count()), wanted_among(mesh.face_count());
        for (std::size_t i = spared; i < all.size(); ++i) {
            const auto [f, g] = all[i];
            wanted[f] = wanted[g] = 1;
            if (among[f] || among[g]) wanted_among[f] = wanted_among[g] = 1;
        }
        SelfIntersectionSearch search(mesh);
        for (int i = 0; i < 5; ++i) {
            CHECK(search.faces({}, exempt).faces == wanted);
            CHECK(search.faces(among, exempt).faces == wanted_among);
        }
    }
}

TEST_CASE("a search that goes along with a mesh finds what a new one finds", "[geometry]") {
    const Mesh quads = shapes::grid(12, 12);
    for (const Mesh& start : {noisy_torus(24, 16, 0.05, 3), quads}) {
        Mesh mesh = start;
        SelfIntersectionSearch search(mesh);
        for (std::uint64_t step = 1; step <= 6; ++step) {
            const Mesh noisy = test::with_noise(start, 0.1 * static_cast<double>(step), step);
            std::vector<std::uint8_t> moved(mesh.face_count(), step == 3), placed(mesh.vertex_count());
            for (std::size_t v = step == 3 ? 0 : step; v < placed.size(); v += step == 3 ? 1 : 7) {
                mesh.positions[v] = noisy.positions[v] * (step == 3 ? 100.0 : 1.0);
                placed[v] = 1;
            }
            for (Index f = 0; f < mesh.face_count(); ++f)
                for (const Index v : mesh.face_wedges(f)) moved[f] |= placed[v];
            search.move_to(mesh, step == 3 ? std::vector<std::uint8_t>{} : moved);
            SelfIntersectionSettings settings = everything;
            CHECK(search.pairs(settings).pairs == find_self_intersections(mesh, settings).pairs);
            settings.among = moved;
            const auto among = find_self_intersections(mesh, settings);
            CHECK(search.pairs(settings).pairs == among.pairs);
            std::vector<std::uint8_t> faces(mesh.face_count());
            for (const auto& [f, g] : among.pairs) faces[f] = faces[g] = 1;
            const MeetingFaces found = search.faces(moved, {});
            CHECK(found.faces == faces);
            REQUIRE(found.box_pairs > 10);
            const MeetingFaces stopped = search.faces(moved, {}, found.box_pairs - 1);
            CHECK(stopped.too_many);
            CHECK(stopped.faces.empty());
            CHECK(stopped.box_pairs == found.box_pairs);
            CHECK_FALSE(search.faces(moved, {}, found.box_pairs).too_many);
        }
    }
}

TEST_CASE("the first of very many pairs are listed", "[geometry]") {
    Mesh heap; // of triangles around one point, each through all others
    for (int i = 0; i < 120; ++i)
        for (const Vec3& p : {Vec3{1, 0, 0.001 * i}, Vec3{-1, 1, -0.002 * i}, Vec3{-1, -1, 0.0005 * i * i}}) {
            heap.corners.push_back(static_cast<Index>(heap.positions.size()));
            heap.positions.push_back(p);
        }
    const auto all = find_self_intersections(heap, everything);
    REQUIRE(all.pairs.size() > 5000);
    const auto some = find_self_intersections(heap, {.limit = 100});
    CHECK(some.count == all.count);
    CHECK(some.pairs == Pairs(all.pairs.begin(), all.pairs.begin() + 100));
}

namespace {

/// Triangles around a vertex that go round it so often in so many steps; rising, from a ring or open.
Mesh fan_around(int laps, int steps, bool closed, double rise) {
    Mesh mesh;
    mesh.positions.push_back({0, 0, 1});
    for (int i = 0; i < steps; ++i) {
        const double a = 0.1 + 2 * M_PI * laps * i / steps;
        mesh.positions.push_back({std::cos(a), std::sin(a), rise * i});
    }
    for (int i = 0; i + 1 < steps + closed; ++i) {
        const Index corners[] = {0, static_cast<Index>(1 + i), static_cast<Index>(1 + (i + 1) % steps)};
        add_face(mesh, corners);
    }
    return mesh;
}

} // namespace

TEST_CASE("around plain vertices nothing needs to be looked at", "[geometry]") {
    const auto is_plain = [](const Mesh& mesh) { return plain_stars(surface_of(mesh))[0] != Star::unknown; };
    for (const bool turned : {false, true})
        for (const bool closed : {false, true}) {
            const auto fan = [&](int laps, int steps, double rise) {
                Mesh mesh = fan_around(laps, steps, closed, rise);
                for (Index f = 0; turned && f < mesh.face_count(); ++f)
                    std::swap(mesh.corners[3 * f], mesh.corners[3 * f + 1]);
                return mesh;
            };
            CHECK(plain_stars(surface_of(fan(1, 7, 0)))[0] == (closed ? Star::ring : Star::plain));
            CHECK(is_plain(fan(1, 24, 0.01)));
            CHECK_FALSE(is_plain(fan(1, 26, 0.01))); // of so many triangles nothing is said
            CHECK_FALSE(is_plain(fan(2, 15, 0.01)));
            CHECK_FALSE(is_plain(fan(3, 17, -0.02)));
        }
    const auto sphere = shapes::icosphere(3);
    const auto plain = plain_stars(surface_of(sphere));
    CHECK(std::count(plain.begin(), plain.end(), Star::ring) ==
          static_cast<std::ptrdiff_t>(sphere.vertex_count()));
    const Mesh folded = shapes::folded_quad();
    for (const Index v : folded.face_wedges(0))
        for (const Index w : folded.face_wedges(1))
            if (v == w) CHECK(plain_stars(surface_of(folded))[v] == Star::unknown);
}

TEST_CASE("fans that go round their vertex twice run into themselves", "[geometry]") {
    for (const int laps : {1, 2, 3})
        for (const bool closed : {false, true})
            for (const double rise : {0.0, 0.03, -0.02}) {
                const Mesh mesh = fan_around(laps, 17, closed, rise);
                CHECK(find_self_intersections(mesh, everything).pairs == oracle::self_intersections(mesh));
            }
}

TEST_CASE("self-intersections agree with CGAL's", "[geometry]") {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        for (const Mesh& mesh :
             {random_triangles(300, 0.15, seed), snapped(random_triangles(300, 0.3, seed), 0.125),
              test::with_noise(shapes::icosphere(3), 0.1, seed),
              snapped(test::with_noise(shapes::icosphere(3), 0.1, seed), 0.0625),
              noisy_torus(30, 20, 0.08, seed)}) {
            const auto found = find_self_intersections(mesh, everything);
            CHECK(found.pairs == oracle::self_intersections(mesh));
        }
    }
}
