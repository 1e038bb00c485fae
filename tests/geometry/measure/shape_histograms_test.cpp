#include "support/catch.hpp"

#include "base/parallel.hpp"
#include "geometry/measure/shape_histograms.hpp"
#include "mesh/shapes.hpp"
#include "support/meshes.hpp"

#include <array>
#include <numeric>

using namespace facetmill;

namespace {

Scene scene_of_mesh(Mesh mesh) {
    Scene scene;
    scene.parts.emplace_back().mesh = std::move(mesh);
    return scene;
}

std::uint64_t sum(const Histogram& h) {
    return std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t{0});
}

/// What the bin that holds the number has.
std::uint64_t count_at(const Histogram& h, double x) {
    for (std::size_t i = 0; i < h.counts.size(); ++i)
        if (h.limits[i] <= x && x < h.limits[i + 1]) return h.counts[i];
    return 0;
}

} // namespace

TEST_CASE("histograms of right triangles", "[geometry]") {
    const auto h = shape_histograms(scene_of_mesh(shapes::grid(4, 3))); // squares of side 1, cut in two
    CHECK(h.edge_length.total == 72);
    CHECK(sum(h.edge_length) == 72);
    CHECK(count_at(h.edge_length, 1.0) == 48);
    CHECK(count_at(h.edge_length, 1.4142135623730951) == 24);
    CHECK(h.edge_length.minimum == 1);
    CHECK(h.smallest_angle.total == 24);
    CHECK(h.smallest_angle.mean == Approx(45));
    CHECK(h.aspect_ratio.mean == Approx(1.3938).epsilon(1e-3));
    CHECK(h.flat_faces == 0);
}

TEST_CASE("histograms in the world, of flat faces and of nothing", "[geometry]") {
    Scene scene = scene_of_mesh(shapes::grid(1, 1));
    for (int i = 0; i < 3; ++i) scene.parts[0].transform.m[i][i] = 4;
    CHECK(shape_histograms(scene).edge_length.maximum == Approx(4 * 1.4142135623730951));
    Mesh flat = shapes::grid(1, 1);
    for (Vec3& p : flat.positions) p = {p.x, 0, 0};
    CHECK(shape_histograms(scene_of_mesh(flat)).flat_faces == 2);
    CHECK(shape_histograms(scene_of_mesh(flat)).smallest_angle.maximum == 0);
    for (Vec3& p : flat.positions) p = {};
    CHECK(shape_histograms(scene_of_mesh(flat)).smallest_angle.maximum == 0); // no sides, no angle
    CHECK(shape_histograms(Scene{}).edge_length.total == 0);
    const Mesh noisy = test::noisy_icosphere(5, 0.1, 1);
    set_threads(1);
    const auto one = shape_histograms(scene_of_mesh(noisy));
    set_threads(3);
    const auto three = shape_histograms(scene_of_mesh(noisy));
    set_threads(0);
    CHECK(one.edge_length.mean == three.edge_length.mean);
    CHECK(one.aspect_ratio.counts == three.aspect_ratio.counts);
}

TEST_CASE("the smallest angle of a triangle, whichever corner it is at", "[geometry]") {
    const Vec3 a{}, b{1, 0, 0}, c{0.3, 0.2, 0.1}; // sharpest at b: 0.2236 up, 0.7 across
    for (const auto& turned : {std::array{a, b, c}, {b, c, a}, {c, a, b}, {b, a, c}}) {
        Mesh mesh;
        mesh.positions = {turned.begin(), turned.end()};
        mesh.corners = {0, 1, 2};
        CHECK(shape_histograms(scene_of_mesh(mesh)).smallest_angle.mean == Approx(17.71547));
        for (const double size : {1e-100, 1e180}) { // squares of areas are beyond all numbers
            for (Vec3& p : mesh.positions) p = p * size;
            CHECK(shape_histograms(scene_of_mesh(mesh)).smallest_angle.mean == Approx(17.71547));
        }
        for (Vec3& p : mesh.positions) p = p * 1e100;
        CHECK(shape_histograms(scene_of_mesh(mesh)).smallest_angle.total == 1);
    }
}

TEST_CASE("two histograms are trimmed to what both need", "[geometry]") {
    Histogram a{{0, 1, 2, 3, 4, 5, 6}, {0, 1, 2, 0, 0, 0}, 3, 1, 3, 2};
    Histogram b{{0, 1, 2, 3, 4, 5, 6}, {0, 0, 0, 4, 5, 0}, 9, 3, 5, 4};
    trim(a, b);
    CHECK(a.limits == std::vector<double>{1, 2, 3, 4, 5});
    CHECK(a.counts == std::vector<std::uint64_t>{1, 2, 0, 0});
    CHECK(b.counts == std::vector<std::uint64_t>{0, 0, 4, 5});
    trim(a, b, 2);
    CHECK(a.limits == std::vector<double>{1, 3, 5});
    CHECK(b.counts == std::vector<std::uint64_t>{0, 9});
    Histogram none;
    trim(none, a);
    CHECK(none.limits == a.limits);
    CHECK(none.counts == std::vector<std::uint64_t>{0});
}
