#include "support/catch.hpp"

#include "geometry/measure/shape_histograms.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
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

/// The count of the bin that contains the number.
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

TEST_CASE("faces of all kinds are counted together as one by one", "[geometry]") {
    // Triangles in runs of any length between quads, some of them flat, tiny, huge or nowhere.
    Mesh all;
    all.face_offsets = {0};
    const auto add = [&](std::initializer_list<Vec3> points) {
        for (const Vec3& p : points) {
            all.corners.push_back(static_cast<Index>(all.positions.size()));
            all.positions.push_back(p);
        }
        all.face_offsets.push_back(static_cast<Index>(all.corners.size()));
    };
    std::size_t flat = 0, nowhere = 0;
    for (int i = 0; i < 700; ++i) {
        const double s = i % 50 == 7 ? 1e-75 : i % 50 == 9 ? 1e75 : 1 + i % 13;
        const bool is_quad = i % 200 == 60, is_flat = i % 90 == 11 && !is_quad,
                   is_nowhere = i % 90 == 12 && !is_quad;
        flat += is_flat;
        nowhere += is_nowhere;
        if (is_quad)
            add({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}});
        else if (is_flat || is_nowhere)
            add({{0, 0, 0}, {s, is_nowhere ? NAN : 0, 0}, {2 * s, 0, 0}});
        else
            add({{0, 0, 0}, {s, 0, s * (i % 3)}, {s * (i % 7), s * (1 + i % 5), 0}});
    }
    const auto together = shape_histograms(scene_of_mesh(all));
    CHECK(together.flat_faces == flat);
    CHECK(together.smallest_angle.total == 700 - nowhere);
    ShapeHistograms summed;
    double angles = 0, edges = 0;
    for (Index f = 0; f < all.face_count(); ++f) {
        Mesh one;
        one.face_offsets = {0, all.face_size(f)};
        for (Index c = all.face_begin(f); c < all.face_end(f); ++c) {
            one.corners.push_back(static_cast<Index>(one.positions.size()));
            one.positions.push_back(all.point(c));
        }
        const auto h = shape_histograms(scene_of_mesh(one));
        for (const auto& [sum_of, part] : {std::pair(&summed.edge_length, &h.edge_length),
                                           std::pair(&summed.smallest_angle, &h.smallest_angle),
                                           std::pair(&summed.aspect_ratio, &h.aspect_ratio)}) {
            sum_of->counts.resize(part->counts.size());
            for (std::size_t i = 0; i < part->counts.size(); ++i) sum_of->counts[i] += part->counts[i];
        }
        angles += h.smallest_angle.mean * static_cast<double>(h.smallest_angle.total);
        edges = std::max(edges, h.edge_length.maximum);
    }
    CHECK(together.edge_length.counts == summed.edge_length.counts);
    CHECK(together.smallest_angle.counts == summed.smallest_angle.counts);
    CHECK(together.aspect_ratio.counts == summed.aspect_ratio.counts);
    CHECK(together.smallest_angle.mean == Approx(angles / static_cast<double>(700 - nowhere)).epsilon(1e-12));
    CHECK(together.edge_length.maximum == edges);
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
