#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/hilbert_curve.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
#include "support/meshes.hpp"

#include <limits>
#include <set>

using namespace facetmill;

namespace {

/// Trees of all uses that find distances, some of them flattened, and trees over an existing surface.
std::vector<FaceTree> trees_of(const Surface& surface) {
    std::vector<FaceTree> trees;
    trees.emplace_back(surface);
    trees.emplace_back(surface, FaceTree::Use::near);
    trees.emplace_back(surface, FaceTree::Use::near);
    trees.back().flatten();
    trees.emplace_back(surface, FaceTree::Use::few);
    trees.emplace_back(surface, FaceTree::Use::coarse);
    for (const auto use : {FaceTree::Use::near, FaceTree::Use::few, FaceTree::Use::coarse})
        trees.push_back(FaceTree::over(surface, surface.bounds(), use));
    trees.push_back(FaceTree::over(surface, surface.bounds(), FaceTree::Use::near));
    trees.back().flatten();
    return trees;
}

/// By trying every triangle.
double distance_by_trial(const Surface& surface, const Vec3& p) {
    double least = HUGE_VAL;
    for (std::size_t t = 0; t < surface.size(); ++t)
        least = std::min(least, length(closest_on_triangle(p, surface.point(t, 0), surface.point(t, 1),
                                                           surface.point(t, 2)) -
                                       p));
    return least;
}

} // namespace

TEST_CASE("the closest point of a triangle lies on its corners, edges and inside", "[geometry]") {
    const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{0, 2, 0};
    CHECK(closest_on_triangle({-1, -1, 3}, a, b, c) == a);
    CHECK(closest_on_triangle({4, -1, 1}, a, b, c) == b);
    CHECK(closest_on_triangle({-1, 5, 1}, a, b, c) == c);
    CHECK(closest_on_triangle({1, -2, 1}, a, b, c) == Vec3{1, 0, 0});
    CHECK(closest_on_triangle({2, 2, -1}, a, b, c) == Vec3{1, 1, 0});
    CHECK(length(closest_on_triangle({0.5, 0.5, 7}, a, b, c) - Vec3{0.5, 0.5, 0}) < 1e-15);
}

TEST_CASE("the closest point of a degenerate triangle is on its segment or point", "[geometry]") {
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{3, 0, 0};
    CHECK(closest_on_triangle({2, 1, 0}, a, b, c) == Vec3{2, 0, 0});
    CHECK(closest_on_triangle({2, 1, 0}, a, c, b) == Vec3{2, 0, 0});
    CHECK(closest_on_triangle({5, 1, 0}, a, a, a) == a);
    // A sliver a thousand million times as long as high: as good as its long edge.
    const Vec3 q = closest_on_triangle({0.5, 1, 0}, a, b, {0.3, 1e-9, 0});
    CHECK(length(q - Vec3{0.5, 0, 0}) < 2e-9);
}

TEST_CASE("the tree finds what trying every triangle finds", "[geometry]") {
    const Mesh shape = GENERATE(as<Mesh>{}, test::noisy_icosphere(2, 0.1, 3), shapes::quad_cube(),
                                shapes::torus(20, 9), shapes::tetrahedron());
    const Surface surface = surface_of(shape);
    const FaceTree whole(surface);
    for (const FaceTree& tree : trees_of(surface)) {
        REQUIRE(tree.size() == surface.size());
        for (std::uint64_t k = 0; k < 200; ++k) {
            const Vec3 p = test::random_point(k % 2 ? 1.5 : 30, 5, k);
            const Closest found = closest_point(tree, p);
            CHECK(found.distance == Approx(distance_by_trial(surface, p)).epsilon(0).margin(1e-14));
            CHECK(found.distance == Approx(length(found.point - p)));
            CHECK(found.face < shape.face_count());
            CHECK(found.face == closest_point(whole, p).face);
        }
    }
}

TEST_CASE("a coarse tree has few boxes and finds the same, whatever the order of the triangles",
          "[geometry]") {
    const Surface in_rows = surface_of(shapes::torus(61, 23)); // 2806 triangles, the last run is not full
    Surface mixed = in_rows;
    for (std::size_t t = 0; t < in_rows.size(); ++t) // 1009 and 2806 have no common factor
        std::copy_n(&in_rows.corners[3 * (t * 1009 % in_rows.size())], 3, &mixed.corners[3 * t]);
    for (const Surface* surface : {&in_rows, static_cast<const Surface*>(&mixed)}) {
        const FaceTree fine(*surface, FaceTree::Use::few),
            coarse = FaceTree::over(*surface, surface->bounds(), FaceTree::Use::coarse);
        CHECK(coarse.nodes.size() * 7 < fine.nodes.size());
        std::set<Index> held(coarse.sources.begin(), coarse.sources.end());
        CHECK(held.size() == surface->size());
        double size = 0; // of the lowest boxes
        for (std::size_t n = 0; n < coarse.level_begin[1]; ++n)
            for (std::size_t slot = 0; slot < 4; ++slot) {
                const auto& node = coarse.nodes[n];
                if (node.max[0][slot] >= node.min[0][slot])
                    size += static_cast<double>(node.max[0][slot] - node.min[0][slot]);
            }
        CHECK(size / 351 < 0.2); // a sixth of that of the middle of any eight
        Index hint = none;
        for (std::uint64_t k = 0; k < 500; ++k) {
            const Vec3 p = test::random_point(1.5, 7, k);
            const Closest one = closest_point(fine, p), other = closest_point(coarse, p, hint);
            REQUIRE(other.distance == one.distance);
            REQUIRE(other.face == one.face);
            REQUIRE(other.point == one.point);
            hint = other.triangle;
        }
    }
}

TEST_CASE("a hint and a distance that is enough never hide what is farther", "[geometry]") {
    const Surface surface = surface_of(test::noisy_icosphere(4, 0.05, 6));
    for (const FaceTree& tree : trees_of(surface))
        for (std::uint64_t k = 0; k < 500; ++k) {
            const Vec3 p = test::random_point(1.2, 5, k);
            const auto hint = static_cast<Index>(k * 7919 % tree.size());
            const double distance = closest_point(tree, p).distance;
            CHECK(closest_point(tree, p, hint).distance == distance);
            CHECK(closest_point(tree, p, hint, distance * 0.99).distance == distance);
            const double enough = closest_point(tree, p, hint, distance * 1.5).distance;
            CHECK(enough >= distance);
            CHECK(enough <= distance * 1.5);
        }
}

TEST_CASE("triangles far away from the others change no distance", "[geometry]") {
    const double far = GENERATE(1.0, 1e3, 1e5, 1e8, 1e15);
    Surface surface = surface_of(test::noisy_icosphere(3, 0.05, 4));
    for (const Vec3& at : {Vec3{far, far, far}, Vec3{-far, 0, far / 2}})
        for (const Vec3& off : {Vec3{}, Vec3{0.02, 0, 0}, Vec3{0, 0.02, 0.01}}) {
            surface.corners.push_back(static_cast<Index>(surface.positions.size()));
            surface.positions.push_back(at + off);
        }
    std::vector<Vec3> points;
    for (std::uint64_t k = 0; k < 40; ++k) {
        points.push_back(test::random_point(1.2, 5, 4 * k));
        points.push_back(surface.positions[k] + test::random_point(1e-4, 5, 4 * k + 1));
        points.push_back(Vec3{far, far, far} + test::random_point(1, 5, 4 * k + 2));
        points.push_back(test::random_point(4 * far, 5, 4 * k + 3));
    }
    for (const FaceTree& tree : trees_of(surface)) {
        const auto found = closest_points(tree, points);
        for (std::size_t i = 0; i < points.size(); ++i) // within the accuracy of a point's coordinates
            REQUIRE(found[i].distance ==
                    Approx(distance_by_trial(surface, points[i])).epsilon(1e-14).margin(4e-15 * (1 + far)));
    }
}

TEST_CASE("batches give what single queries give, whatever the number of threads", "[geometry]") {
    const FaceTree tree(surface_of(test::noisy_icosphere(3, 0.2, 9)));
    std::vector<Vec3> points;
    for (std::uint64_t k = 0; k < 5000; ++k) points.push_back(test::random_point(2, 5, k));
    const auto all = closest_points(tree, points);
    set_threads(1);
    const auto alone = closest_points(tree, points);
    set_threads(0);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Closest one = closest_point(tree, points[k]);
        REQUIRE(all[k].distance == one.distance);
        REQUIRE(all[k].face == one.face);
        REQUIRE(alone[k].point == all[k].point);
    }
}

TEST_CASE("of faces that meet at the closest point the lowest is named", "[geometry]") {
    const FaceTree tree(surface_of(shapes::cube()));
    CHECK(closest_point(tree, {-1, -1, -1}).face == 0);
    CHECK(closest_point(tree, {-1, -1, -1}).point == Vec3{0, 0, 0});
}

TEST_CASE("faces of a polygon mesh are named by their own number", "[geometry]") {
    const Mesh cube = shapes::quad_cube();
    const FaceTree tree(surface_of(cube));
    for (Index f = 0; f < cube.face_count(); ++f) {
        Vec3 middle;
        for (Index c = cube.face_begin(f); c < cube.face_end(f); ++c) middle += cube.point(c) / 4;
        CHECK(closest_point(tree, middle).face == f);
        CHECK(closest_point(tree, middle).distance == 0);
    }
}

TEST_CASE("numbers that are not finite are left out, and empty surfaces have no closest point",
          "[geometry]") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Mesh mesh = shapes::cube();
    mesh.positions[0].x = nan;
    const FaceTree tree(surface_of(mesh));
    CHECK(tree.triangles.size() < 12);
    CHECK(closest_point(tree, {2, 0.5, 0.5}).distance == Approx(1));
    CHECK(closest_point(tree, {nan, 0, 0}).face == none);
    CHECK(closest_point(FaceTree(Surface{}), {0, 0, 0}).face == none);
    CHECK(closest_points(FaceTree(Surface{}), std::vector<Vec3>{{0, 0, 0}})[0].distance == HUGE_VAL);
}

TEST_CASE("tiny, huge and far surfaces lose nothing", "[geometry]") {
    for (const double size : {1e-30, 1e-6, 1e9, 1e60}) {
        Mesh mesh = shapes::icosphere(2);
        for (auto& p : mesh.positions) p = (p + Vec3{1000, -2000, 500}) * size;
        const Surface surface = surface_of(mesh);
        const FaceTree tree(surface);
        for (std::uint64_t k = 0; k < 50; ++k) {
            const Vec3 p = (test::random_point(2, 5, k) + Vec3{1000, -2000, 500}) * size;
            CHECK(closest_point(tree, p).distance ==
                  Approx(distance_by_trial(surface, p)).epsilon(0).margin(1e-11 * size));
        }
        // Corners are found even where squares of distances overflow.
        Mesh largest = shapes::octahedron();
        for (auto& p : largest.positions) p = p * (size * 1e140);
        CHECK(closest_point(FaceTree(surface_of(largest)), {size * 3e140, 0, 0}).distance ==
              Approx(size * 2e140));
        CHECK(closest_point(tree, {1e150, 0, 0}).face != none);
    }
}

TEST_CASE("two steps down the curve at once are as two", "[geometry]") {
    for (std::uint64_t k = 0; k < 2000; ++k) {
        std::array<std::uint32_t, 3> at{};
        for (std::uint64_t axis = 0; axis < 3; ++axis)
            at[axis] = static_cast<std::uint32_t>(hashed(k, axis)) & ((1U << hilbert::axis_bits) - 1);
        std::uint64_t along = 0;
        std::size_t state = 0;
        for (int bit = hilbert::axis_bits - 1; bit >= 0; --bit) {
            const hilbert::Step step =
                hilbert::steps[state][(at[0] >> bit & 1) | (at[1] >> bit & 1) << 1 | (at[2] >> bit & 1) << 2];
            along = along << 3 | step.turn;
            state = step.state;
        }
        REQUIRE(hilbert::index(at[0], at[1], at[2]) == along);
    }
}

TEST_CASE("neighbours on the curve are neighbours in space", "[geometry]") {
    std::vector<std::array<std::uint32_t, 3>> cells(512);
    std::set<std::uint64_t> seen;
    constexpr std::uint32_t shift = hilbert::axis_bits - 3;
    for (std::uint32_t i = 0; i < 512; ++i) {
        const std::uint32_t x = i & 7, y = i >> 3 & 7, z = i >> 6;
        const std::uint64_t along = hilbert::index(x << shift, y << shift, z << shift) >> 3 * shift;
        REQUIRE(along < 512);
        seen.insert(along);
        cells[along] = {x, y, z};
    }
    CHECK(seen.size() == 512);
    for (std::size_t i = 1; i < 512; ++i) {
        int steps = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            steps += std::abs(static_cast<int>(cells[i][axis]) - static_cast<int>(cells[i - 1][axis]));
        CHECK(steps == 1);
    }
}

TEST_CASE("from far away the closest point is still the closest", "[geometry]") {
    const Surface surface = surface_of(test::noisy_icosphere(3, 0.05, 4));
    const FaceTree tree(surface);
    for (const double far : {50.0, 70.0, 1e3, 1e5, 1e7})
        for (std::uint64_t k = 0; k < 20; ++k) {
            const Vec3 p = test::random_point(far, 5, k);
            CHECK(closest_point(tree, p).distance == Approx(distance_by_trial(surface, p)).epsilon(1e-14));
        }
    const Closest found = closest_point(tree, {1e300, 0, 0});
    CHECK(found.point.x == Approx(1).epsilon(0.06)); // the side that faces the query
    CHECK(found.distance == 1e300);
}

TEST_CASE("slivers, folds and needles are as close as trying each says", "[geometry]") {
    // Long thin triangles in all directions, some without area.
    Mesh mesh;
    for (std::uint64_t k = 0; k < 300; ++k) {
        const Vec3 a = test::random_point(1, 5, 7 * k), b = a + test::random_point(0.5, 5, 7 * k + 1);
        const Vec3 c =
            mix(a, b, test::between(0, 1, 8, k)) + test::random_point(k % 3 ? 1e-7 : 0, 5, 7 * k + 2);
        for (const Vec3& p : {a, b, c}) {
            mesh.corners.push_back(static_cast<Index>(mesh.positions.size()));
            mesh.positions.push_back(p);
        }
    }
    const Surface surface = surface_of(mesh);
    const FaceTree tree(surface);
    for (std::uint64_t k = 0; k < 500; ++k) {
        const Vec3 p = test::random_point(1.2, 5, 9000 + k);
        CHECK(closest_point(tree, p).distance ==
              Approx(distance_by_trial(surface, p)).epsilon(0).margin(1e-14));
    }
}
