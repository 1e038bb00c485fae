#include "geometry/print_direction/print_direction.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"
#include "support/run_stage.hpp"

#include <cmath>

using namespace facetmill;
using test::run_stage;
using test::scene_of;

namespace {

/// The measure of a direction, written out plainly.
std::pair<double, double> overhang_and_height(const Mesh& mesh, const Vec3& up) {
    double low = HUGE_VAL, high = -HUGE_VAL, overhang = 0;
    for (const Vec3& p : mesh.positions) {
        low = std::min(low, dot(p, up));
        high = std::max(high, dot(p, up));
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 &a = mesh.point(3 * f), &b = mesh.point(3 * f + 1), &c = mesh.point(3 * f + 2);
        const Vec3 n = cross(b - a, c - a);
        const double cosine = dot(n, up) / length(n);
        const double top = std::max({dot(a, up), dot(b, up), dot(c, up)});
        if (cosine < -std::sqrt(0.5) - 1e-6 && top > low + 1e-5) overhang += length(n) / 2;
    }
    return {overhang, high - low};
}

} // namespace

TEST_CASE("print direction lays a table on its top", "[bed]") {
    // A plate on a column: a T in section. Upside down, nothing overhangs.
    Mesh table;
    for (const auto& [low, high] :
         {std::pair<Vec3, Vec3>{{-1, -1, 0}, {1, 1, 5}}, {{-5, -5, 5}, {5, 5, 6}}}) {
        Mesh box = shapes::cube();
        for (Vec3& p : box.positions)
            p = {low.x + p.x * (high.x - low.x), low.y + p.y * (high.y - low.y),
                 low.z + p.z * (high.z - low.z)};
        append(table, box);
    }
    // Up to 60 degrees, so that standing on an edge at 45 degrees is no way out.
    const auto r = find_print_direction(surface_of(table), {0, 0, 1}, {std::acos(0.5)});
    CHECK(r.before.overhang == Approx(100)); // the whole lower side of the plate
    CHECK(r.before.height == Approx(6));
    CHECK(r.after.overhang == Approx(4)); // the end of the column, inside the plate
    CHECK(r.after.up.z == Approx(-1));
}

TEST_CASE("print direction is as good as many tried directions", "[bed]") {
    for (const std::uint64_t seed : {1, 2, 3}) {
        Mesh mesh = test::noisy_icosphere(2, 0.4, seed);
        for (Vec3& p : mesh.positions) p = {p.x * 3, p.y * 2, p.z};
        const auto r = find_print_direction(surface_of(mesh), {0, 0, 1});
        const auto [overhang, height] = overhang_and_height(mesh, r.after.up);
        CHECK(r.after.overhang == Approx(overhang));
        CHECK(r.after.height == Approx(height));
        CHECK(r.before.overhang == Approx(overhang_and_height(mesh, {0, 0, 1}).first));
        double least = HUGE_VAL;
        for (std::uint64_t k = 0; k < 3000; ++k)
            least =
                std::min(least, overhang_and_height(mesh, normalised(test::random_point(1, seed, k))).first);
        CHECK(r.after.overhang <= least * 1.05 + 0.001 * test::area(mesh));
    }
}

TEST_CASE("transform orients parts for printing", "[bed]") {
    Mesh stick = shapes::cube(); // 1 x 1 x 9 stands; it should lie
    for (Vec3& p : stick.positions) p = {p.x + 4, p.y, p.z * 9 - 2};
    const auto run = run_stage("transform", "{orient_for: printing}", scene_of(stick, Unit::mm));
    const Box box = run.scene.bounds();
    CHECK(box.min.z == Approx(0).margin(1e-12));
    CHECK(box.max.z == Approx(1));
    const Json& o = run.record.result["orientation"];
    CHECK(o["before"] == Json({{"overhang_area", 0.0}, {"height", 9.0}}));
    CHECK(o["after"]["height"].get<double>() == Approx(1));
    // A part that lies well stays as it is.
    const auto again = run_stage("transform", "{orient_for: printing}", run.scene);
    CHECK(again.scene.bounds().max.x == Approx(box.max.x));
    CHECK(again.scene.bounds().max.y == Approx(box.max.y));
    Scene y_up = scene_of(stick);
    y_up.up = UpAxis::y;
    CHECK(run_stage("transform", "{orient_for: printing}", y_up).scene.bounds().max.y == Approx(1));
}

TEST_CASE("transform shrinks to fit and does not enlarge", "[bed]") {
    const auto size = [](const char* options) {
        return run_stage("transform", options, scene_of(shapes::cube())).scene.bounds().extent().x;
    };
    CHECK(size("{fit: 0.5, shrink_only: true}") == Approx(0.5));
    CHECK(size("{fit: [2, 3, 1.5], shrink_only: true}") == 1);
    CHECK(size("{fit: 2}") == Approx(2));
    CHECK(test::problems_of("transform", test::options({{"shrink_only", "true"}})) ==
          "E-CONFLICT transform: 'shrink_only' needs fit | add fit, or leave out 'shrink_only'");
}

TEST_CASE("a turn takes one direction to another", "[bed]") {
    const Vec3 directions[] = {
        {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, normalised({1, 2, 3}), normalised({-3, 1, 0.2})};
    for (const Vec3& a : directions)
        for (const Vec3& b : directions) {
            const Transform t = turn_onto(a, b);
            CHECK(length(t.vector(a) - b) < 1e-12);
            CHECK(t.determinant() == Approx(1));
        }
}
