// Tiles that fit a bed, and their pegs.
#include "geometry/clean/steps.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"
#include "support/run_stage.hpp"

#include <cmath>

using namespace facetmill;
using test::failure;
using test::run_stage;
using test::scene_of;

namespace {

Mesh scaled(Mesh mesh, const Vec3& by, const Vec3& to = {}) {
    for (Vec3& p : mesh.positions) p = Vec3{p.x * by.x, p.y * by.y, p.z * by.z} + to;
    return mesh;
}

double volume_of(const Scene& scene) {
    double sum = 0;
    for (const Part& part : scene.parts) sum += test::volume(part.mesh);
    return sum;
}

void check_solids(const Scene& scene, const Vec3& bed) {
    for (const Part& part : scene.parts) {
        INFO(part.name);
        CHECK(test::closed(part.mesh));
        CHECK(test::edge_manifold(part.mesh));
        CHECK(clean_steps::crossings(part.mesh).count == 0);
        const Vec3 extent = part.mesh.bounds().extent();
        for (std::size_t i = 0; i < 3; ++i) CHECK(extent[i] <= bed[i] * (1 + 1e-12));
    }
}

/// The area of a regular polygon with corners on a circle.
double polygon_area(int sides, double radius) {
    const double pi = std::acos(-1.0);
    return sides / 2.0 * radius * radius * std::sin(2 * pi / sides);
}

} // namespace

TEST_CASE("tile fits a ball into the fewest tiles", "[stages][bed]") {
    const auto ball = [] {
        return scene_of(scaled(shapes::icosphere(3), {250, 250, 250}, {7, -3, 1}), Unit::mm);
    };
    const auto run = run_stage("tile", "{fit: 200mm}", ball());
    REQUIRE(run.scene.parts.size() == 27);
    CHECK(run.scene.parts[0].name == "part.01.x0.y0.z0");
    CHECK(run.scene.parts[1].name == "part.02.x1.y0.z0");
    CHECK(run.scene.parts[26].name == "part.27.x2.y2.z2");
    CHECK(volume_of(run.scene) == Approx(volume_of(ball())).epsilon(1e-12));
    check_solids(run.scene, {200, 200, 200});
    CHECK(run.warnings().empty());
    CHECK(run_stage("tile", "{fit: [300, 200, 600]}", ball()).scene.parts.size() == 6);
    CHECK(run_stage("tile", "{fit: [300, 200], axes: xz}", ball()).scene.parts.size() == 6);
}

TEST_CASE("tile keeps a part that fits", "[stages][bed]") {
    // A float file may be one step larger than its bed.
    const double side = std::nextafter(200.0F, 300.0F);
    const auto run = run_stage("tile", "{fit: 200}", scene_of(scaled(shapes::cube(), {side, 10, 10})));
    REQUIRE(run.scene.parts.size() == 1);
    CHECK(run.scene.parts[0].name == "part");
    CHECK(run.mesh().face_count() == 12);
    CHECK(
        run_stage("tile", "{fit: 200}", scene_of(scaled(shapes::cube(), {400, 10, 10}))).scene.parts.size() ==
        2);
    CHECK(
        run_stage("tile", "{fit: 200}", scene_of(scaled(shapes::cube(), {401, 10, 10}))).scene.parts.size() ==
        3);
}

TEST_CASE("tile joins tiles by pegs", "[stages][bed]") {
    // 4 x 2 x 1 tiles: 3 * 2 pairs along x, and 4 along y.
    const auto block = [] { return scene_of(scaled(shapes::cube(), {390, 190, 90}, {-5, 0, 0})); };
    const auto run = run_stage(
        "tile", "{fit: 110, pegs: {diameter: 6, length: 8, clearance: 0.25, wall: 3, count: 2}}", block());
    REQUIRE(run.scene.parts.size() == 8);
    check_solids(run.scene, {110, 110, 110});
    CHECK(run.warnings().empty());
    REQUIRE(run.record.result["pegs"].size() == 20);
    CHECK(run.record.result["without_pegs"] == 0);
    const double pi = std::acos(-1.0);
    const double peg = polygon_area(32, 3) * 8;
    const double hole = polygon_area(32, 3.25 / std::cos(pi / 32)) * 8.25;
    CHECK(volume_of(run.scene) == Approx(390.0 * 190 * 90 + 20 * (peg - hole)).epsilon(1e-12));
    // Tiles are equally long with their pegs.
    CHECK(run.scene.parts[0].mesh.bounds().extent().x == Approx((390 + 3 * 8) / 4.0));
    CHECK(run.scene.parts[3].mesh.bounds().extent().x == Approx((390 + 3 * 8) / 4.0));
    const Attribute* tile_x = run.scene.parts[1].mesh.find("tile_x", Domain::face);
    REQUIRE(tile_x);
    for (std::size_t f = 0; f < tile_x->size(); ++f) REQUIRE(tile_x->value(f, 0) == 1);
}

TEST_CASE("tile makes holes for dowels and magnets", "[stages][bed]") {
    const double pi = std::acos(-1.0), whole = 200.0 * 50 * 50;
    const auto block = [] { return scene_of(scaled(shapes::cube(), {200, 50, 50})); };
    const auto dowels = run_stage(
        "tile", "{fit: 100, pegs: {kind: dowels, diameter: 5, length: 20, clearance: 0.1}}", block());
    REQUIRE(dowels.scene.parts.size() == 2);
    const double area = polygon_area(32, 2.6 / std::cos(pi / 32));
    CHECK(volume_of(dowels.scene) == Approx(whole - 4 * area * 10.1));
    check_solids(dowels.scene, {100, 50, 50});
    const auto magnets = run_stage(
        "tile", "{fit: 100, pegs: {kind: magnets, diameter: 5, length: 3, clearance: 0.1, count: 1}}",
        block());
    CHECK(volume_of(magnets.scene) == Approx(whole - 2 * area * 3.1));
    // A single magnet is in the middle of the section.
    const Json at = magnets.record.result["pegs"][0]["at"];
    CHECK(at[0].get<double>() == Approx(100));
    CHECK(std::fabs(at[1].get<double>() - 25) < 2);
    CHECK(std::fabs(at[2].get<double>() - 25) < 2);
}

TEST_CASE("tile joins turned, mirrored and scaled parts", "[stages][bed]") {
    Scene scene = scene_of(scaled(shapes::cube(), {39, 9, 9}));
    scene.parts[0].transform.m[0][0] = 0; // x to y, mirrored, in tenfold size
    scene.parts[0].transform.m[1][1] = 0;
    scene.parts[0].transform.m[1][0] = 10;
    scene.parts[0].transform.m[0][1] = 10;
    scene.parts[0].transform.m[2][2] = 10;
    const auto run = run_stage("tile", "{fit: 200, pegs: {diameter: 6, clearance: 0}}", scene);
    REQUIRE(run.scene.parts.size() == 2);
    const double pi = std::acos(-1.0);
    const double change = 2 * 6 * (polygon_area(32, 3) - polygon_area(32, 3 / std::cos(pi / 32)));
    CHECK(volume_of(run.scene) == Approx(39.0 * 9 * 9 + change / 1000).epsilon(1e-12));
    check_solids(run.scene, {20, 20, 20});
}

TEST_CASE("tile names neighbours without room for a peg", "[stages][bed]") {
    const auto run = run_stage("tile", "{fit: 100, pegs: 6}", scene_of(scaled(shapes::cube(), {190, 50, 8})));
    CHECK(run.scene.parts.size() == 2);
    REQUIRE(run.record.warnings.size() == 1);
    CHECK(run.record.warnings[0].id == "W-TILE-PEGS");
    CHECK(run.record.warnings[0].message ==
          "tile: part 'part' has no room for a peg at 1 pair of tiles: 'part.1.x0' and 'part.2.x1'");
    CHECK(run.record.result["without_pegs"] == 1);
    CHECK(failure([] {
              run_stage("tile", "{fit: 2, pegs: 0.1}", scene_of(scaled(shapes::grid(3, 3), {1, 1, 1})));
          }).starts_with("stage [E-TILE] tile: part 'part' is not a closed solid"));
    CHECK(failure([] {
              run_stage("tile", "{fit: 5, pegs: 6}", scene_of(scaled(shapes::cube(), {19, 5, 5})));
          }).starts_with("stage [E-TILE] tile: pegs of length 6 leave no room for a tile in 5"));
}

TEST_CASE("tile keeps pegs inside the solid", "[stages][bed]") {
    // A torus: its middle, where pegs would be farthest apart, is empty.
    const auto ring = [] { return scene_of(scaled(shapes::torus(96, 48), {100, 100, 100})); };
    const auto run = run_stage("tile", "{fit: 150, pegs: {diameter: 8, clearance: 0.3}}", ring());
    REQUIRE(run.scene.parts.size() == 4);
    check_solids(run.scene, {150, 150, 150});
    CHECK(run.record.result["pegs"].size() == 8);
    const double pi = std::acos(-1.0);
    const double peg = polygon_area(32, 4) * 8, hole = polygon_area(32, 4.3 / std::cos(pi / 32)) * 8.3;
    CHECK(volume_of(run.scene) == Approx(volume_of(ring()) + 8 * (peg - hole)).epsilon(1e-9));
    for (const Json& p : run.record.result["pegs"]) { // 4.3 + 4 within the tube of radius 40
        const double x = p["at"][0], y = p["at"][1], z = p["at"][2];
        CHECK(std::hypot(std::hypot(x, y) - 100, z) < 40 - 8);
    }
}
