#include "support/catch.hpp"

#include "geometry/probe/probe.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
#include "support/meshes.hpp"

#include <limits>
#include <set>

using namespace facetmill;

namespace {

FaceTree tree_of(const Mesh& mesh) { return FaceTree(surface_of(mesh)); }

std::vector<double> parameters(const std::vector<Hit>& hits) {
    std::vector<double> t;
    for (const auto& h : hits) t.push_back(h.t);
    return t;
}

int sum_of_ways(const std::vector<Hit>& hits) {
    int sum = 0;
    for (const auto& h : hits) sum += h.way;
    return sum;
}

} // namespace

TEST_CASE("a line passes a triangle through its inside, the way its front faces", "[geometry]") {
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
    CHECK(passes({0.2, 0.2, -1}, {0.2, 0.2, 1}, a, b, c) == 1);
    CHECK(passes({0.2, 0.2, 1}, {0.2, 0.2, -1}, a, b, c) == -1);
    CHECK(passes({0.2, 0.2, 1}, {0.3, 0.2, 2}, a, b, c) == -passes({0.3, 0.2, 2}, {0.2, 0.2, 1}, a, b, c));
    CHECK(passes({0.8, 0.8, -1}, {0.8, 0.8, 1}, a, b, c) == 0);
    CHECK(passes({-1, 0.2, 0}, {1, 0.2, 0}, a, b, c) == 0); // in its plane
    CHECK(passes({-1, 0.2, 1}, {1, 0.2, 1}, a, b, c) == 0); // parallel
    CHECK(passes({0, 0, 1}, {0, 0, 1}, a, b, c) == 0);      // no line
}

TEST_CASE("a line through an edge or a corner counts a sheet once", "[geometry]") {
    const Mesh sheet = shapes::grid(4, 4); // all inner edges and vertices
    const FaceTree tree = tree_of(sheet);
    for (const Vec3& at : {Vec3{1, 1.5, 0}, Vec3{1.5, 2, 0}, Vec3{2, 2, 0}, Vec3{1.5, 1.5, 0}, Vec3{3, 1, 0}})
        for (const Vec3& d :
             {Vec3{0, 0, 1}, Vec3{0.5, 0, 1}, Vec3{0.25, -0.5, 1}, Vec3{-1, -1, 2}, Vec3{0, 1, 0.125}}) {
            const auto hits = all_hits(tree, {at - d, at + d});
            CHECK(hits.size() == 1);
            CHECK(hits.at(0).way == 1);
            CHECK(hits.at(0).t == 0.5);
            CHECK(all_hits(tree, {at + d, at - d}).size() == 1);
        }
}

TEST_CASE("a diagonal through a cube meets it twice, wherever it enters", "[geometry]") {
    for (const Mesh& cube : {shapes::cube(), shapes::quad_cube()}) {
        const FaceTree tree = tree_of(cube);
        CHECK(parameters(all_hits(tree, {{-1, -1, -1}, {2, 2, 2}})) == std::vector<double>{1.0 / 3, 2.0 / 3});
        CHECK(parameters(all_hits(tree, {{-1, 0.5, 0.5}, {3, 0.5, 0.5}})) == std::vector<double>{0.25, 0.5});
        const auto first = first_hit(tree, {{-1, 0.5, 0.5}, {3, 0.5, 0.5}});
        CHECK(first->t == 0.25);
        CHECK(first->point == Vec3{0, 0.5, 0.5});
        CHECK(first->way == -1);
    }
}

TEST_CASE("segments end, rays do not; an end on the surface meets it", "[geometry]") {
    const FaceTree tree = tree_of(shapes::cube());
    CHECK(all_hits(tree, {{-2, 0.5, 0.25}, {-1, 0.5, 0.25}}).empty());
    CHECK(all_hits(tree, {{-2, 0.5, 0.25}, {-1, 0.5, 0.25}, true}).size() == 2);
    CHECK(all_hits(tree, {{-1, 0.5, 0.25}, {-2, 0.5, 0.25}, true}).empty()); // behind its start
    CHECK(parameters(all_hits(tree, {{-2, 0.5, 0.25}, {0, 0.5, 0.25}})) == std::vector<double>{1});
    CHECK(parameters(all_hits(tree, {{0.5, 0.5, 0.25}, {0.5, 0.5, 1.25}})) == std::vector<double>{0.75});
    CHECK(parameters(all_hits(tree, {{1, 0.5, 0.25}, {5, 0.5, 0.25}})) == std::vector<double>{0});
}

TEST_CASE("the tree meets what trying every triangle meets", "[geometry]") {
    const Mesh mesh = test::noisy_icosphere(3, 0.2, 5);
    const FaceTree tree = tree_of(mesh);
    for (std::uint64_t k = 0; k < 300; ++k) {
        const bool ray = k % 2;
        const Line line{test::random_point(k % 3 ? 1.5 : 200, 6, 2 * k),
                        test::random_point(1.5, 6, 2 * k + 1), ray};
        std::size_t expected = 0;
        for (const auto& t : tree.triangles) {
            const int way = passes(line.from, line.to, t.a, t.b, t.c);
            const Vec3 n = cross(t.b - t.a, t.c - t.a);
            const double at = dot(n, t.a - line.from) / dot(n, line.to - line.from);
            expected += way != 0 && at >= 0 && (ray || at <= 1);
        }
        const auto hits = all_hits(tree, line);
        CHECK(hits.size() == expected);
        const auto first = first_hit(tree, line);
        CHECK(first.has_value() == !hits.empty());
        if (first) CHECK((first->t == hits[0].t && first->face == hits[0].face));
    }
}

TEST_CASE("lists of hits are those of single lines, whatever the number of threads", "[geometry]") {
    const FaceTree tree = tree_of(shapes::torus(40, 20));
    std::vector<Line> lines;
    for (std::uint64_t k = 0; k < 2000; ++k)
        lines.push_back({test::random_point(2, 6, 2 * k), test::random_point(2, 6, 2 * k + 1)});
    // Degenerate lines among the others, and a run of them at the end.
    const double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 40; ++i) lines[37 * i].to = i % 2 ? lines[37 * i].from : Vec3{infinity, 0, 0};
    lines.resize(lines.size() + 600, {{9, 9, 9}, {9, 9, 9}});
    const HitLists all = hits_of(tree, lines, true);
    set_threads(1);
    const HitLists first = hits_of(tree, lines, false);
    set_threads(0);
    REQUIRE(all.offsets.size() == lines.size() + 1);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto expected = all_hits(tree, lines[i]);
        REQUIRE(all.of(i).size() == expected.size());
        REQUIRE(first.of(i).size() == std::min<std::size_t>(1, expected.size()));
        for (std::size_t h = 0; h < expected.size(); ++h) REQUIRE(all.of(i)[h].face == expected[h].face);
        if (!expected.empty()) REQUIRE(first.of(i)[0].t == expected[0].t);
    }
}

TEST_CASE("the winding number is 1 inside, 0 outside, and adds up", "[geometry]") {
    const Mesh ball = test::noisy_icosphere(3, 0.1, 7);
    const FaceTree tree = tree_of(ball);
    for (std::uint64_t k = 0; k < 300; ++k) {
        const Vec3 p = test::random_point(1.3, 6, k);
        const double r = length(p);
        if (r < 0.89) CHECK(winding(tree, p) == 1);
        if (r > 1.11) CHECK(winding(tree, p) == 0);
        // A ray in any other direction gives the same result.
        CHECK(winding(tree, p) ==
              sum_of_ways(all_hits(tree, {p, p + test::random_point(1, 6, 1000 + k), true})));
    }
    Mesh twice = ball;
    append(twice, ball);
    CHECK(winding(tree_of(twice), {0, 0, 0}) == 2);
    for (std::size_t c = 0; c < twice.corners.size(); c += 3)
        std::swap(twice.corners[c], twice.corners[c + 1]);
    CHECK(winding(tree_of(twice), {0, 0, 0}) == -2);
}

TEST_CASE("many points, each asked from the one before, get what each gets alone", "[geometry]") {
    Mesh mesh = shapes::cube();
    Mesh other = shapes::cube(); // overlaps the first, and shares its planes
    for (auto& p : other.positions) p = {p.x * 0.5 + 0.5, p.y * 0.5, p.z * 2};
    append(mesh, other);
    append(mesh, test::noisy_icosphere(2, 0.1, 5));
    const FaceTree tree = tree_of(mesh);
    std::vector<Vec3> points{{1e300, 0.5, 0.5}, {1e6, 0.5, 0.5}, {0.75, 0.25, -1e9}};
    for (int x = -2; x <= 10; ++x)
        for (int y = -2; y <= 10; ++y)
            for (int z = -2; z <= 18; ++z) points.push_back({x * 0.125, y * 0.125, z * 0.125});
    for (std::uint64_t k = 0; k < 2000; ++k) points.push_back(test::random_point(2.5, 6, k));
    const auto answers = probe_points(tree, points);
    std::set<int> numbers;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool on = lies_on(tree, points[i]);
        REQUIRE((answers[i].side == Side::on) == on);
        if (!on) REQUIRE(answers[i].winding == winding(tree, points[i]));
        numbers.insert(answers[i].winding);
    }
    CHECK(numbers == std::set<int>{0, 1, 2, 3});
}

TEST_CASE("the winding number follows the way between two points", "[geometry]") {
    const FaceTree tree = tree_of(shapes::cube());
    const Vec3 inside{0.5, 0.25, 0.375};
    CHECK(winding_beside(tree, inside, 1, inside) == 1);
    CHECK(winding_beside(tree, inside, 1, {0.25, 0.5, 0.5}) == 1);
    for (const Vec3& out :
         {Vec3{2, 1, 1.5}, Vec3{0.5, 0.25, 3}, Vec3{-0.5, -0.75, -0.625}, Vec3{1.5, 1.25, 1.375}}) {
        CHECK(winding_beside(tree, inside, 1, out) == 0);
        CHECK(winding_beside(tree, out, 0, inside) == 1);
    }
    CHECK(winding_beside(tree, {-1, -1, -1}, 0, {2, 2, 2}) == 0); // along the diagonal, through two corners
    CHECK(winding_beside(tree, {-1, 0, 0}, 0, {2, 0, 0}) == 0);   // along an edge
}

TEST_CASE("points in line with edges and corners of a cube are told exactly", "[geometry]") {
    const Mesh cube = shapes::cube();
    const FaceTree tree = tree_of(cube);
    for (int x = -1; x <= 5; ++x)
        for (int y = -1; y <= 5; ++y)
            for (int z = -1; z <= 5; ++z) {
                const Vec3 p = Vec3{x * 1.0, y * 1.0, z * 1.0} * 0.25;
                const int low = std::min({x, y, z}), high = std::max({x, y, z});
                const bool out = low < 0 || high > 4, in = low > 0 && high < 4;
                const auto a = probe_points(tree, std::vector<Vec3>{p})[0];
                CHECK(a.side == (out ? Side::outside : in ? Side::inside : Side::on));
                if (!out && !in) CHECK(lies_on(tree, p));
            }
    // Above the border, in line with its edges: neither in nor on.
    CHECK_FALSE(lies_on(tree, {0.5, 0, 1.0000000000000002}));
}

TEST_CASE("a tolerance makes points near the surface lie on it", "[geometry]") {
    const FaceTree tree = tree_of(shapes::cube());
    const std::vector<Vec3> near{{0.5, 0.5, 1.01}};
    CHECK(probe_points(tree, near)[0].side == Side::outside);
    CHECK(probe_points(tree, near, {.tolerance = 0.011})[0].side == Side::on);
    CHECK(probe_points(tree, near)[0].closest.distance == Approx(0.01));
}

TEST_CASE("an open surface has no inside, nothing has no hits", "[geometry]") {
    const FaceTree sheet = tree_of(shapes::grid(2, 2));
    CHECK(probe_points(sheet, std::vector<Vec3>{{1, 1, 1}}, {.closed = false})[0].side == Side::unknown);
    CHECK(probe_points(sheet, std::vector<Vec3>{{1, 1, 0}}, {.closed = false})[0].side == Side::on);
    const FaceTree empty(Surface{});
    CHECK(all_hits(empty, {{0, 0, 0}, {1, 0, 0}}).empty());
    CHECK(winding(empty, {0, 0, 0}) == 0);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(all_hits(sheet, {{nan, 0, 0}, {1, 0, 0}}).empty());
    CHECK(probe_points(sheet, std::vector<Vec3>{{nan, 0, 0}})[0].side == Side::unknown);
    CHECK(all_hits(sheet, {{1, 1, 1}, {1, 1, 1}}).empty());
}

TEST_CASE("lines from far away and of any length meet the same", "[geometry]") {
    const FaceTree tree = tree_of(test::noisy_icosphere(2, 0.1, 3));
    for (const double far : {10.0, 1e4, 1e8}) {
        CHECK(all_hits(tree, {{far, 0.01, 0.02}, {0, 0.01, 0.02}, true}).size() == 2);
        CHECK(all_hits(tree, {{far, 0.01, 0.02}, {-far, 0.01, 0.02}}).size() == 2);
        CHECK(all_hits(tree, {{0, 0.01, 0.02}, {1 / far, 0.01, 0.02}, true}).size() == 1);
        CHECK(all_hits(tree, {{far, 0.01, 3}, {-far, 0.01, 3}}).empty());
    }
}

TEST_CASE("the cases of a segment and a facet", "[geometry]") {
    const std::vector<Vec3> square{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}; // a corner doubled
    const auto case_of = [&](const Vec3& from, const Vec3& to) { return meet({from, to}, square).meeting; };
    CHECK(case_of({1, 1, -1}, {1, 1, 3}) == Meeting::hit);
    CHECK(meet({{1, 1, -1}, {1, 1, 3}}, square).t == 0.25);
    CHECK(meet({{1, 1, -1}, {1, 1, 3}}, square).point == Vec3{1, 1, 0});
    CHECK(case_of({1, 1, 1}, {2, 1, 1}) == Meeting::parallel);
    CHECK(case_of({1, 1, 0}, {2, 1, 0}) == Meeting::in_plane);
    CHECK(case_of({1, 1, 1}, {1, 1, 3}) == Meeting::outside_segment);
    CHECK(case_of({3, 1, -1}, {3, 1, 3}) == Meeting::outside_facet);
    CHECK(case_of({2, 1, -1}, {2, 1, 3}) == Meeting::hit); // the border belongs to the facet
    CHECK(meet({{1, 1, 1}, {1, 1, 3}, true}, square).meeting == Meeting::outside_segment);
    CHECK(meet({{1, 1, 3}, {1, 1, 1}, true}, square).meeting == Meeting::hit);
    CHECK(meet({{1, 1, 3}, {1, 1, 1}}, std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).meeting ==
          Meeting::parallel); // no plane
}
