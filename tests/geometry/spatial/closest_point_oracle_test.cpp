// Distances and hits held against CGAL's AABB tree and its bounded-error Hausdorff distance.
#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/deviation/deviation.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/rays.hpp"
#include "oracle/cgal_oracle.hpp"

using namespace facetmill;

namespace {

std::vector<Mesh> meshes() {
    return {test::noisy_icosphere(4, 0.1, 1), test::noisy_torus(40, 24, 0.05, 2),
            test::random_triangles(400, 0.3, 3), shapes::cube()};
}

} // namespace

TEST_CASE("closest points are as far as CGAL's", "[geometry]") {
    for (const Mesh& mesh : meshes()) {
        const FaceTree tree(surface_of(mesh));
        const FaceTree near(surface_of(mesh), FaceTree::Use::near);
        const oracle::Tree other(mesh);
        std::vector<Vec3> points = mesh.positions; // on the surface, near it, anywhere, far away
        for (std::uint64_t k = 0; k < 500; ++k) {
            points.push_back(mesh.positions[k % mesh.vertex_count()] + test::random_point(0.01, 8, k));
            points.push_back(test::random_point(2, 8, k));
            points.push_back(test::random_point(200, 8, k));
        }
        const auto found = closest_points(tree, points);
        for (std::size_t i = 0; i < points.size(); ++i)
            REQUIRE(found[i].distance == Approx(other.distance(points[i])).epsilon(1e-12).margin(1e-15));
        const auto again = closest_points(near, points);
        for (std::size_t i = 0; i < points.size(); ++i) REQUIRE(again[i].distance == found[i].distance);
    }
}

TEST_CASE("segments meet what they meet in CGAL's tree", "[geometry]") {
    std::size_t hits = 0;
    for (const Mesh& mesh : meshes()) {
        const FaceTree tree(surface_of(mesh));
        const oracle::Tree other(mesh);
        for (std::uint64_t k = 0; k < 1500; ++k) { // random ones: through no edge and no vertex
            const Line line{test::random_point(1.5, 8, 2 * k), test::random_point(1.5, 8, 2 * k + 1)};
            const auto found = all_hits(tree, line);
            REQUIRE(found.size() == other.met_by(line.from, line.to));
            REQUIRE(first_hit(tree, line).has_value() == !found.empty());
            hits += found.size();
        }
    }
    CHECK(hits > 4000);
}

TEST_CASE("deviation and its bound hold the Hausdorff distance between them", "[geometry]") {
    const Mesh ball = shapes::icosphere(3), rough = test::noisy_icosphere(2, 0.1, 4),
               ring = test::noisy_torus(30, 16, 0.03, 5);
    const std::pair<const Mesh*, const Mesh*> pairs[] = {
        {&ball, &rough}, {&rough, &ball}, {&ball, &ring}, {&ring, &ball}};
    for (const auto& [from, to] : pairs) {
        const auto d =
            deviation_to(surface_of(*from), FaceTree(surface_of(*to)), {.samples = 20000, .certify = true});
        constexpr double error = 1e-4;
        const double other = oracle::hausdorff_distance(*from, *to, error); // within error above the truth
        CHECK(d.maximum <= other * (1 + 1e-12));
        CHECK(*d.bound >= other - error);
        CHECK(*d.bound <= 1.011 * other); // certify_to
    }
}
