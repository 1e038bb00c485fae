#include "geometry/clean/steps.hpp"
#include "geometry/drain/drain.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/measure.hpp"
#include "support/run_stage.hpp"

#include <cmath>

using namespace facetmill;
using test::run_stage;
using test::scene_of;

namespace {

Mesh scaled(Mesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions) p = {p.x * by.x, p.y * by.y, p.z * by.z};
    return mesh;
}

double polygon_area(double radius) { return 16 * radius * radius * std::sin(std::acos(-1.0) / 16); }

void check_drained(const Mesh& mesh) {
    CHECK(test::closed(mesh));
    CHECK(test::edge_manifold(mesh));
    CHECK(clean_steps::crossings(mesh).count == 0);
}

} // namespace

TEST_CASE("thicken drains a hollow box", "[bed]") {
    const auto box = [] { return scene_of(scaled(shapes::cube(), {40, 30, 20}), Unit::mm); };
    const double hollow = 40.0 * 30 * 20 - 36.0 * 26 * 16;
    const auto run = run_stage("thicken", "{thickness: 2, drain: 5mm}", box());
    check_drained(run.mesh());
    CHECK(test::volume(run.mesh()) == Approx(hollow - polygon_area(2.5) * 2));
    CHECK(test::euler(run.mesh()) == 2); // one surface, like a cup
    CHECK(run.warnings().empty());
    const Json& part = run.record.result["parts"][0];
    REQUIRE(part["drain_holes"].size() == 1);
    CHECK(part["drain_holes"][0]["vent"] == false);
    CHECK(part["drain_holes"][0]["to"][2].get<double>() < 0);
    CHECK(part["closed_cavities"] == 0);

    const auto three =
        run_stage("thicken", "{thickness: 2, drain: {diameter: 4, count: 2, vent: true}}", box());
    check_drained(three.mesh());
    CHECK(test::volume(three.mesh()) == Approx(hollow - 3 * polygon_area(2) * 2));
    CHECK(test::euler(three.mesh()) == -2); // three holes: genus 2
    CHECK(three.record.result["parts"][0]["drain_holes"].size() == 3);

    Scene y_up = box();
    y_up.up = UpAxis::y;
    const auto lies = run_stage("thicken", "{thickness: 2, drain: 4}", y_up);
    CHECK(lies.record.result["parts"][0]["drain_holes"][0]["to"][1].get<double>() < 0);
    CHECK(test::volume(lies.mesh()) == Approx(hollow - polygon_area(2) * 2));
}

TEST_CASE("thicken drains a hollow ball at its lowest point", "[bed]") {
    const auto run = run_stage("thicken", "{thickness: 3, drain: {diameter: 4, vent: true}}",
                               scene_of(scaled(shapes::icosphere(4), {25, 25, 25})));
    check_drained(run.mesh());
    CHECK(test::euler(run.mesh()) == 0);
    const Json& holes = run.record.result["parts"][0]["drain_holes"];
    REQUIRE(holes.size() == 2);
    CHECK(std::hypot(holes[0]["from"][0].get<double>(), holes[0]["from"][1].get<double>()) < 2);
    CHECK(holes[0]["from"][2].get<double>() < -18);
    CHECK(holes[1]["from"][2].get<double>() > 18);
    // About the volume of a cylinder through a shell of 3: the shell is a little thicker off the axis.
    const Mesh plain = run_stage("thicken", "3", scene_of(scaled(shapes::icosphere(4), {25, 25, 25}))).mesh();
    CHECK(test::volume(plain) - test::volume(run.mesh()) == Approx(2 * polygon_area(2) * 3).epsilon(0.02));
}

TEST_CASE("drain moves with instances and names cavities that stay closed", "[bed]") {
    Scene two = scene_of(scaled(shapes::cube(), {40, 30, 20}));
    two.parts.push_back(two.parts[0]);
    two.parts[1].transform.m[0][3] = 100;
    const auto run = run_stage("thicken", "{thickness: 2, drain: 5}", two);
    const Json& parts = run.record.result["parts"];
    CHECK(parts[1]["drain_holes"][0]["to"][0].get<double>() ==
          Approx(parts[0]["drain_holes"][0]["to"][0].get<double>() + 100));
    check_drained(run.scene.parts[1].mesh);
    const auto wide =
        run_stage("thicken", "{thickness: 2, drain: 17}", scene_of(scaled(shapes::cube(), {40, 30, 20})));
    CHECK(wide.warnings() == std::vector<std::string>{"W-THICKEN-DRAIN"});
    CHECK(wide.record.result["parts"][0]["closed_cavities"] == 1);
    const auto sheet = run_stage("thicken", "{thickness: 0.2, drain: 0.1}", scene_of(shapes::grid(2, 2)));
    CHECK(sheet.warnings() == std::vector<std::string>{"W-THICKEN-DRAIN"});
    CHECK(test::problems_of("thicken",
                            test::options({{"thickness", "1"}, {"mode", "edges"}, {"drain", "1"}})) ==
          "E-CONFLICT thicken: 'drain' needs mode: surface | add mode: surface, or leave out 'drain'");
}
