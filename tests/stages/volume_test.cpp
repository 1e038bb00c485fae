#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "support/failure.hpp"
#include "support/off_file.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::refusal_of;
using test::run_stage;
using test::scene_of;

namespace volume_stage_test {

namespace {

Mesh plate(double z) {
    Mesh mesh = shapes::grid(4, 3);
    for (Vec3& p : mesh.positions) p.z = z;
    return mesh;
}

} // namespace

TEST_CASE("volume reports cut and fill against a level", "[stages]") {
    const auto run = run_stage("volume", "2", scene_of(plate(5), Unit::m));
    const Json& r = run.record.result;
    CHECK(r["surface"] == "terrain");
    CHECK(r["level"] == 2);
    CHECK(r["above"]["volume"].get<double>() == Approx(36));
    CHECK(r["above"]["mean"].get<double>() == Approx(3));
    CHECK(r["below"]["volume"] == 0);
    CHECK(r["net"].get<double>() == Approx(36));
    CHECK(r["missing_area"] == 0);
    CHECK_FALSE(r.contains("missing_in_other"));
    CHECK(run.record.said[0] == "above (cut): 36 m3 on 12 m2, mean 3 m, at most 3 m");
    CHECK(run.warnings().empty());
    CHECK_FALSE(run.scene.parts[0].changed);
}

TEST_CASE("volume compares with another file inside a footprint", "[stages]") {
    const test::TemporaryDirectory folder;
    const std::string file = test::off_file(folder / "design.off", plate(4));
    const auto run =
        run_stage("volume", "{with: \"" + file + "\", footprint: [[1, 1], [5, 1], [5, 2], [1, 2]]}",
                  scene_of(plate(1)));
    const Json& r = run.record.result;
    CHECK(r["below"]["volume"].get<double>() == Approx(9));
    CHECK(r["missing_area"].get<double>() == Approx(1));
    CHECK(r["missing_in_other"].get<double>() == Approx(1));
    CHECK(run.warnings() == std::vector<std::string>{"W-VOLUME-MISSING", "W-VOLUME-MISSING"});
    CHECK(run.record.warnings[0].message ==
          "volume: 1 of the footprint (25 %) has no surface in the scene and is not compared");
    CHECK(run.state->record.inputs.size() == 1);
}

TEST_CASE("volume follows the up axis of the scene", "[stages]") {
    Scene scene = scene_of(shapes::grid(4, 3));
    scene.up = UpAxis::y;
    for (Vec3& p : scene.parts[0].mesh.positions) p = {p.x, 7, p.y};
    const auto run = run_stage("volume", "{level: 5, footprint: [[0, 0], [1, 0], [1, 3], [0, 3]]}", scene);
    CHECK(run.record.result["axis"] == "y");
    CHECK(run.record.result["above"]["volume"].get<double>() == Approx(6));
}

TEST_CASE("volume refuses what it cannot compare", "[stages]") {
    CHECK(
        refusal_of("volume", "{}", scene_of(plate(0))).starts_with("usage [E-VOLUME] volume: the reference"));
    CHECK(
        refusal_of("volume", "{level: 1, with: a.ply}", scene_of(plate(0))).starts_with("usage [E-VOLUME]"));
    CHECK(refusal_of("volume", "50%", scene_of(plate(0)))
              .starts_with("usage [E-VOLUME] volume: a level cannot"));
    Scene sheets = scene_of(plate(0));
    append(sheets.parts[0].mesh, plate(1));
    CHECK(
        refusal_of("volume", "1", sheets)
            .starts_with("stage [E-VOLUME] volume: the scene has sheets above each other, for example at "));
    Scene far = scene_of(plate(0));
    for (Vec3& p : far.parts[0].mesh.positions) p += Vec3{500000, 5200000, 400};
    const std::string refusal =
        refusal_of("volume", "{level: 1, footprint: [[9.1, 46.9], [9.2, 46.9], [9.2, 47]]}", far);
    CHECK(refusal.starts_with("stage [E-VOLUME] volume: the scene has no surface in the footprint"));
    CHECK(refusal.find("ogr2ogr") != std::string::npos);
    const test::TemporaryDirectory folder;
    const std::string file = test::off_file(folder / "cube.off", shapes::cube());
    CHECK(refusal_of("volume", "{with: \"" + file + "\"}", scene_of(plate(0))).find("closed solid") !=
          std::string::npos);
}

} // namespace volume_stage_test
