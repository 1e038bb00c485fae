#include "geometry/intersect/self_intersections.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/capped.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"
#include "support/surface.hpp"

#include <cstdio>

using namespace facetmill;
using test::options;
using test::problems_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("relax: a bare number is the iterations", "[stages]") {
    const auto once = run_stage("relax", Value::scalar("2"), scene_of(shapes::icosphere(2)));
    const auto twice =
        run_stage("relax", Value{}, run_stage("relax", Value{}, scene_of(shapes::icosphere(2))).scene);
    CHECK(test::same(once.mesh(), twice.mesh()));
    CHECK(once.record.result["parts"][0]["moved_vertices"] == 162);
    CHECK(once.scene.parts[0].changed);
}

TEST_CASE("relax: attribute changes name every attribute", "[stages]") {
    const auto r = run_stage("relax", Value{}, scene_of(shapes::uv_cube()));
    CHECK(r.record.attribute_changes.size() == 2);
}

TEST_CASE("relax: options out of range are refused with the range", "[stages]") {
    CHECK(problems_of("relax", options({{"lambda", "0"}})).substr(0, 8) == "E-RANGE ");
    CHECK(problems_of("relax", options({{"iterations", "-1"}})).substr(0, 8) == "E-RANGE ");
}

TEST_CASE("relax: until has many iterations, and says when they were not enough", "[stages]") {
    const auto r = run_stage("relax", options({{"until", "0.01%"}}), scene_of(shapes::icosphere(2)));
    const auto& part = r.record.result["parts"][0];
    CHECK(part["iterations"] > 2);
    CHECK(part["settled"] == true);
    CHECK(part["after"]["volume"].get<double>() > 0.97 * part["before"]["volume"].get<double>());
    CHECK(r.warnings().empty());
    const auto few = run_stage("relax", options({{"until", "0.01%"}, {"iterations", "2"}}),
                               scene_of(shapes::icosphere(2)));
    CHECK(few.record.result["parts"][0]["iterations"] == 2);
    CHECK(few.warnings() == std::vector<std::string>{"W-RELAX-STOPPED"});
    Mesh point = shapes::tetrahedron();
    for (auto& p : point.positions) p = {};
    CHECK(run_stage("relax", options({{"until", "1%"}}), scene_of(point))
              .record.result["parts"][0]["iterations"] == 1);
}

TEST_CASE("relax: a method that shrinks stops before the surface is a point", "[stages]") {
    for (const char* method : {"laplacian", "cotangent", "implicit"}) {
        const auto r = run_stage("relax", options({{"until", "0.001%"}, {"method", method}}),
                                 scene_of(shapes::icosphere(3)));
        const auto& part = r.record.result["parts"][0];
        CAPTURE(method, part["iterations"]);
        CHECK(r.warnings() == std::vector<std::string>{"W-RELAX-STOPPED"});
        CHECK(part["settled"] == false);
        CHECK(part["iterations"] > 1);
        CHECK(part["after"]["area"].get<double>() > 0.6 * part["before"]["area"].get<double>());
    }
}

TEST_CASE("relax: area and volume before and after; options that go with methods", "[stages]") {
    const auto r = run_stage("relax", options({{"method", "hc"}}), scene_of(shapes::icosphere(2)));
    const auto& part = r.record.result["parts"][0];
    CHECK(part["before"]["volume"].get<double>() > part["after"]["volume"].get<double>());
    CHECK(run_stage("relax", Value{}, scene_of(shapes::grid(2, 2)))
              .record.result["parts"][0]["after"]["volume"]
              .is_null());
    CHECK(problems_of("relax", options({{"method", "taubin"}, {"lambda", "0.9"}})).substr(0, 8) ==
          "E-RANGE ");
    CHECK(problems_of("relax", options({{"pass_band", "0.2"}})) ==
          "E-CONFLICT relax: 'pass_band' needs the method taubin");
}

TEST_CASE("relax: caps of cuts stay planar unless they are free", "[stages]") {
    const Scene capped = test::capped_sphere();
    CHECK(test::cap_unevenness(capped.parts[0].mesh) == 0);
    const auto fixed = run_stage("relax", "{iterations: 3}", capped);
    CHECK(test::cap_unevenness(fixed.mesh()) == 0);
    CHECK(fixed.record.result["parts"][0]["held_vertices"] > 10);
    CHECK(fixed.record.result["parts"][0]["moved_vertices"] > 100);
    const auto free = run_stage("relax", "{iterations: 3, caps: free}", capped);
    CHECK(test::cap_unevenness(free.mesh()) > 0.001);
    CHECK(free.record.result["parts"][0]["held_vertices"] == 0);
    const auto only_caps = run_stage("relax", "{iterations: 3, mask: {attribute: cut_id}}", capped);
    CHECK(only_caps.warnings() == std::vector<std::string>{"W-MASK"});
    CHECK(only_caps.record.result["parts"][0]["moved_vertices"] == 0);
}
