#include "cells/process/measure_cells.hpp"

#include "mesh/placement.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/cells.hpp"

using namespace facetmill;
using namespace facetmill::cells;

namespace {

void check_near(const Vec3& a, const Vec3& b, double size) {
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(a[i] - b[i]) <= 1e-12 * size);
}

/// Sums may differ in the last digits, all else may not.
void check_statistics(const Statistics& a, const Statistics& b, double last_digits = 0) {
    CHECK(a.count == b.count);
    CHECK(a.minimum == Approx(b.minimum).epsilon(last_digits).margin(last_digits));
    CHECK(a.maximum == Approx(b.maximum).epsilon(last_digits).margin(last_digits));
    CHECK(a.median == Approx(b.median).epsilon(last_digits).margin(last_digits));
    const double size = std::max(std::abs(b.minimum), std::abs(b.maximum));
    CHECK(std::abs(a.mean - b.mean) <= 1e-12 * size);
    CHECK(std::abs(a.deviation - b.deviation) <= 1e-12 * size);
}

void check_measures(const Mesh& mesh, std::uint64_t most, double scale = 1) {
    const test::TemporaryDirectory folder;
    Part part;
    part.mesh = mesh;
    part.transform = {{{-2 * scale, 0, 0, 0}, {0, 0, -scale, 5 * scale}, {0, scale, 0, 0}}}; // mirrors
    const auto partition = test::cells_of(folder, mesh, most);
    const CellMeasures found =
        measure_cells(*partition, part.transform, {folder.path(), test::cell_memory}, {.feature_angle = 0.1});
    const Mesh world = in_world(part);
    const FaceResult faces = measure_faces(world);
    check_statistics(found.faces.area, faces.area);
    check_statistics(found.faces.angle, faces.angle);
    check_statistics(found.faces.aspect_ratio, faces.aspect_ratio);
    CHECK(found.faces.kinds.of_kind == faces.kinds.of_kind);
    check_near(found.faces.signed_area, faces.signed_area, faces.area.sum);
    const EdgeResult edges = measure_edges(world, {.feature_angle = 0.1});
    check_statistics(found.edges.length, edges.length);
    check_statistics(found.edges.turn, edges.turn);
    CHECK(found.edges.convex == edges.convex);
    CHECK(found.edges.concave == edges.concave);
    CHECK(found.edges.flat == edges.flat);
    CHECK(found.edges.feature == edges.feature);
    CHECK(found.edges.boundary == edges.boundary);
    CHECK(found.edges.non_manifold == edges.non_manifold);
    const CurvatureResult curvature = measure_curvature(world);
    check_statistics(found.curvature.of_gaussian, curvature.of_gaussian, 1e-9);
    check_statistics(found.curvature.of_mean, curvature.of_mean, 1e-9);
    CHECK(found.curvature.total == Approx(curvature.total).margin(1e-8));
    const MassResult mass = measure_mass(world);
    CHECK(found.mass.shell.area == Approx(mass.shell.area).epsilon(1e-12));
    check_near(found.mass.shell.centroid, mass.shell.centroid, 10 * scale);
    REQUIRE(found.mass.solid.has_value() == mass.solid.has_value());
    if (!mass.solid) return;
    CHECK(found.mass.solid->volume == Approx(mass.solid->volume).epsilon(1e-12));
    CHECK(found.mass.solid->spread.xx == Approx(mass.solid->spread.xx).epsilon(1e-12));
}

} // namespace

TEST_CASE("measures of cells are those of the mesh", "[cells]") {
    for (const std::uint64_t most : {30, 700, 100000}) {
        check_measures(test::noisy_icosphere(4, 0.01, 7), most);
        check_measures(test::with_noise(shapes::grid(40, 40), 0.2, 5), most);
        check_measures(shapes::grid(40, 41), most); // all edges alike
    }
    for (unsigned seed = 1; seed <= 4; ++seed) check_measures(test::nasty(seed), 20 + 97 * seed);
}

TEST_CASE("measures of cells have no limits of range", "[cells]") {
    check_measures(test::noisy_icosphere(3, 0.01, 7), 50, 1e-40);
    check_measures(test::noisy_icosphere(3, 0.01, 7), 50, 1e60);
}
