#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/group_distances.hpp"

#include <bit>

using namespace facetmill;

namespace {

/// Triangles of all shapes: random ones, slivers of every width, segments and points.
Mesh poor_triangles() {
    Mesh mesh = test::random_triangles(200, 0.3, 5);
    for (std::size_t t = 0; t < 100; ++t) {
        Vec3 *a = &mesh.positions[mesh.corners[3 * t]], *b = &mesh.positions[mesh.corners[3 * t + 1]],
             *c = &mesh.positions[mesh.corners[3 * t + 2]];
        const double width = t % 10 == 0 ? 0 : std::pow(10.0, -static_cast<double>(t % 20));
        *c = mix(*a, *b, 0.3) + (*c - *a) * width;
        if (t % 25 == 0) *b = *c = *a;
    }
    return mesh;
}

std::vector<Mesh> grouped_meshes() {
    return {test::noisy_icosphere(4, 0.1, 1), test::noisy_torus(40, 24, 0.05, 2), poor_triangles(),
            shapes::cube(), test::random_triangles(1, 0.5, 3)};
}

/// A group of points around a point of the surface, or anywhere: of any width, down to a single place.
std::vector<Vec3> group_of(const Mesh& mesh, std::uint64_t k) {
    const Vec3 middle =
        k % 3 == 0 ? test::random_point(2, 8, k) : mesh.positions[hashed(9, k) % mesh.vertex_count()];
    const double width = k % 7 == 0 ? 0 : std::pow(10.0, -static_cast<double>(k % 6));
    std::vector<Vec3> points;
    for (std::uint64_t i = 0; i <= k % GroupDistances::most; ++i)
        points.push_back(middle + test::random_point(width, k, i));
    return points;
}

} // namespace

TEST_CASE("points of a group are as far as each by itself, up to the error, whatever the hint",
          "[geometry]") {
    for (const Mesh& mesh : grouped_meshes()) {
        const FaceTree tree(surface_of(mesh), FaceTree::Use::near);
        GroupDistances together(tree), elsewhere(tree);
        std::size_t measured = 0, certain = 0;
        Index hint = none;
        for (std::uint64_t k = 0; k < 2000; ++k) {
            const auto points = group_of(mesh, k);
            Index wrong = static_cast<Index>(hashed(7, k) % tree.triangles.size());
            const bool done = together.measure(points, hint);
            REQUIRE(elsewhere.measure(points, wrong) == done);
            if (!done) continue;
            ++measured;
            Box box;
            for (const Vec3& p : points) box.add(p);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Closest closest = closest_point(tree, points[i]);
                const double exact = closest.distance;
                if (together.is_certain(i)) {
                    REQUIRE(together.triangle(i) == closest.triangle);
                    ++certain;
                }
                REQUIRE(std::abs(together.distance(i) - exact) <= together.error());
                REQUIRE(closest_on(tree, together.triangle(i), points[i]).distance <=
                        exact + 2 * together.error());
                REQUIRE(elsewhere.distance(i) == together.distance(i));
                REQUIRE(together.error() <= 1e-5 * (box.diagonal() + exact));
            }
        }
        CHECK(measured > 500);
        CHECK(certain > 500);
    }
}

TEST_CASE("groups too far away for their frame, and without a place, are refused", "[geometry]") {
    const FaceTree tree(surface_of(shapes::cube()), FaceTree::Use::near);
    GroupDistances together(tree);
    Index hint = none;
    CHECK_FALSE(together.measure(std::vector<Vec3>{{1e6, 0, 0}}, hint));
    const FaceTree nothing(Surface{}, FaceTree::Use::near);
    GroupDistances with_nothing(nothing);
    hint = none;
    CHECK_FALSE(with_nothing.measure(std::vector<Vec3>{{0, 0, 0}}, hint));
    CHECK_FALSE(with_nothing.all_within(std::vector<Vec3>{{0, 0, 0}}, 1, hint));
    CHECK_FALSE(with_nothing.lay_out(std::vector<Vec3>{{0, 0, 0}}, 1));
    CHECK_FALSE(together.lay_out(std::vector<Vec3>{{1e6, 0, 0}}, 1));
    CHECK_FALSE(together.lay_out(std::vector<Vec3>{{0, 0, 0}}, 0));
    CHECK(with_nothing.distance(0) == HUGE_VAL);
}

TEST_CASE("a group is within a distance when each point is, whatever the hint", "[geometry]") {
    for (const Mesh& mesh : grouped_meshes()) {
        const FaceTree tree(surface_of(mesh), FaceTree::Use::near);
        GroupDistances together(tree);
        std::size_t shown = 0;
        for (std::uint64_t k = 0; k < 2000; ++k) {
            const auto points = group_of(mesh, k);
            double farthest = 0;
            for (const Vec3& p : points) farthest = std::max(farthest, closest_point(tree, p).distance);
            Index hint = k % 2 == 0 ? none : static_cast<Index>(hashed(7, k) % tree.triangles.size());
            REQUIRE_FALSE(together.all_within(points, farthest * (1 - 1e-9), hint));
            for (std::size_t i = 0; i < points.size(); ++i)
                REQUIRE(together.distance(i) + together.error() >= closest_point(tree, points[i]).distance);
            shown += together.all_within(points, farthest * 1.5, hint);
        }
        CHECK(shown > 500);
    }
}

TEST_CASE("points are within a distance of a triangle for certain, those that are asked about",
          "[geometry]") {
    for (const Mesh& mesh : grouped_meshes()) {
        const FaceTree tree(surface_of(mesh), FaceTree::Use::near);
        GroupDistances together(tree);
        std::size_t near = 0, far = 0;
        for (std::uint64_t k = 0; k < 2000; ++k) {
            const auto points = group_of(mesh, k);
            const Index triangle = closest_point(tree, points[hashed(3, k) % points.size()]).triangle;
            std::vector<double> exact;
            for (const Vec3& p : points) exact.push_back(closest_on(tree, triangle, p).distance);
            const double distance = exact[hashed(4, k) % points.size()];
            if (!together.lay_out(points, distance)) continue;
            const auto among = static_cast<std::uint32_t>(hashed(5, k));
            const std::uint32_t all = together.within(points, triangle, ~std::uint32_t{0}),
                                some = together.within(points, triangle, among);
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (all >> i & 1) REQUIRE(exact[i] <= distance);
                if (exact[i] <= distance - 3 * together.error()) REQUIRE((all >> i & 1));
                if (among >> i & 1) REQUIRE((some >> i & 1) == (all >> i & 1));
                ++(all >> i & 1 ? near : far);
            }
        }
        CHECK(near > 500);
        CHECK(far > 500);
    }
}

TEST_CASE("points that lie across from a triangle are within the distance of it, most of those on a surface",
          "[geometry]") {
    std::vector<Mesh> meshes = grouped_meshes();
    for (const double far : {1e3, 1e7}) { // of the origin
        meshes.push_back(test::noisy_icosphere(4, 0.1, 1));
        for (Vec3& p : meshes.back().positions) p += Vec3{far, -far, far};
    }
    std::size_t across = 0;
    for (const Mesh& mesh : meshes) {
        const FaceTree tree(surface_of(mesh), FaceTree::Use::near);
        GroupDistances together(tree);
        for (std::uint64_t k = 0; k < 2000; ++k) {
            const auto points = group_of(mesh, k);
            const double distance = std::pow(10.0, -static_cast<double>(k % 5));
            const std::uint32_t all = ~std::uint32_t{0} >> (GroupDistances::most - points.size());
            std::uint32_t among = all & static_cast<std::uint32_t>(hashed(5, k) | hashed(6, k));
            const std::uint32_t asked = among;
            if (among == 0 || !together.lay_out(points, distance)) continue;
            std::uint32_t found = 0;
            together.take_across(points, distance, among, [&](std::size_t i, Index triangle) {
                REQUIRE(closest_on(tree, triangle, points[i]).distance <= distance);
                REQUIRE((found >> i & 1) == 0);
                found |= std::uint32_t{1} << i;
            });
            REQUIRE(among == (asked & ~found));
            REQUIRE((found & ~asked) == 0);
            across += static_cast<std::size_t>(std::popcount(found));
        }
    }
    CHECK(across > 5000);
    const Surface finer = surface_of(test::noisy_icosphere(5, 0.001, 2));
    const FaceTree tree(surface_of(test::noisy_icosphere(4, 0.001, 1)), FaceTree::Use::near);
    GroupDistances together(tree);
    std::size_t missed = 0;
    for (std::size_t t = 0; t < finer.size(); t += 8) {
        std::vector<Vec3> points;
        for (std::size_t i = t; i < t + 8; ++i)
            points.push_back((finer.point(i, 0) + finer.point(i, 1) + finer.point(i, 2)) / 3);
        std::uint32_t among = 255;
        REQUIRE(together.lay_out(points, 0.05));
        together.take_across(points, 0.05, among, [](std::size_t, Index) {});
        missed += static_cast<std::size_t>(std::popcount(among));
    }
    CHECK(missed < finer.size() / 10);
}

TEST_CASE("what float32 cannot tell from 0 in a wide group is not shown to be within a distance",
          "[geometry]") {
    Mesh lifted = shapes::cube();
    lifted.positions[0].z += 1e-9;
    const FaceTree tree(surface_of(lifted), FaceTree::Use::near);
    GroupDistances together(tree);
    Index hint = none;
    CHECK_FALSE(together.all_within(shapes::cube().positions, 0.5e-9, hint));
}

namespace {

/// The smallest distance within which a single triangle has all points of the set.
double shared_distance(const FaceTree& tree, const std::vector<Vec3>& points, std::uint32_t set) {
    double least = HUGE_VAL;
    for (Index t = 0; t < tree.triangles.size(); ++t) {
        double most = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (set >> i & 1) most = std::max(most, closest_on(tree, t, points[i]).distance);
        least = std::min(least, most);
    }
    return least;
}

} // namespace

TEST_CASE("sets of points are removed when one triangle is near all of each, and only then", "[geometry]") {
    for (const Mesh& mesh : grouped_meshes()) {
        const FaceTree tree(surface_of(mesh), FaceTree::Use::near);
        GroupDistances together(tree);
        Index hint = none;
        std::size_t removed = 0, kept = 0;
        for (std::uint64_t k = 0; k < 400; ++k) {
            const auto points = group_of(mesh, k);
            std::vector<std::uint32_t> sets;
            std::vector<double> distances;
            for (std::uint64_t s = 0; s < 6; ++s) {
                std::uint32_t set = 0;
                for (std::uint64_t j = 0; j < 3; ++j)
                    set |= std::uint32_t{1} << hashed(hashed(s, k), j) % points.size();
                sets.push_back(set);
                distances.push_back(shared_distance(tree, points, set));
            }
            const double distance = distances[k % 6];
            for (const double factor : {0.999, 1.001}) {
                std::vector<std::uint32_t> left = sets;
                together.remove_within(points, distance * factor, left, hint);
                for (std::size_t s = 0, next = 0; s < sets.size(); ++s) {
                    const bool stayed = next < left.size() && left[next] == sets[s];
                    next += stayed;
                    ++(stayed ? kept : removed);
                    if (distances[s] > distance * factor) REQUIRE(stayed);
                }
            }
        }
        CHECK(removed > 1000);
        CHECK(kept > 1000);
    }
}
