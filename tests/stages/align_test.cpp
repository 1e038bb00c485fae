#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/off_file.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::options;
using test::run_stage;
using test::scene_of;

TEST_CASE("align: parts move together, and the matrix is reported", "[stages]") {
    const test::TemporaryDirectory folder;
    Mesh target = shapes::cube();
    for (Vec3& p : target.positions) p = {p.x * 3, p.y * 2, p.z};
    const std::string file = test::off_file(folder / "target.off", target);
    Scene scene = scene_of(target);
    scene.parts[0].transform.m[0][3] = 5;
    const auto r = run_stage("align", options({{"with", file}}), std::move(scene));
    CHECK(r.scene.bounds().max.x == Approx(3).margin(1e-4));
    CHECK(r.record.result["residual"].get<double>() < 1e-6);
    CHECK(r.record.result["residual_before"].get<double>() > 1);
    CHECK(r.record.result["matrix"].size() == 16);
    CHECK(r.warnings().empty());
}

TEST_CASE("align: other shapes give a warning", "[stages]") {
    const test::TemporaryDirectory folder;
    const std::string file = test::off_file(folder / "target.off", shapes::torus(24, 12, 3, 0.2));
    CHECK(run_stage("align", options({{"with", file}}), scene_of(shapes::cube())).warnings() ==
          std::vector<std::string>{"W-ALIGN"});
}
