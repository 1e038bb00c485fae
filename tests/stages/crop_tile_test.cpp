#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

#include <fstream>

using namespace facetmill;
using test::run_stage;
using test::scene_of;

namespace {

std::string stage_refusal(const char* stage, const std::string& options) {
    std::string text = test::failure([&] { run_stage(stage, options, scene_of(shapes::grid(4, 3))); });
    const auto place = text.find("test.yaml:"); // checked by the tests of the document
    if (place != std::string::npos) text.erase(place, text.find(": ", place) + 2 - place);
    return text;
}

double area_of(const Scene& scene) {
    double sum = 0;
    for (const Part& part : scene.parts) sum += test::area(part.mesh);
    return sum;
}

} // namespace

TEST_CASE("tile makes a part of every cell", "[stages]") {
    const auto run = run_stage("tile", "2", scene_of(shapes::grid(4, 3)));
    REQUIRE(run.scene.parts.size() == 4);
    CHECK(run.scene.parts[0].name == "part.x0.y0");
    CHECK(run.scene.parts[3].name == "part.x1.y1");
    CHECK(area_of(run.scene) == Approx(12));
    CHECK(run.record.result["tiles"][1] ==
          Json({{"part", "part.x1.y0"}, {"tile_x", 1}, {"tile_y", 0}, {"faces", 8}}));
    const auto capped = run_stage("tile", "{size: [0.5, 0.25], axes: zx, origin: [0.25, 0], cap: true}",
                                  scene_of(shapes::cube()));
    CHECK(capped.scene.parts.size() == 12);
    double volume = 0;
    for (const Part& part : capped.scene.parts) volume += test::volume(part.mesh);
    CHECK(volume == Approx(1));
    CHECK(capped.scene.materials.size() == 1);
    CHECK(run_stage("tile", "10mm", scene_of(shapes::cube(), Unit::cm)).scene.parts.size() == 1);
}

TEST_CASE("tile refuses what makes no grid", "[stages]") {
    CHECK(stage_refusal("tile", "0") == "usage [E-TILE] tile: 'size' must be above 0, found 0");
    CHECK(
        stage_refusal("tile", "{size: 1, axes: xx}") ==
        "usage [E-TILE] tile: 'axes' takes each of x, y, z at most once, found 'xx' | for example axes: xy");
    CHECK(stage_refusal("tile", "{size: [1, 2, 3]}") ==
          "usage [E-TILE] tile: 3 sizes for 2 axes | give one size, or one for each axis");
    CHECK(stage_refusal("tile", "{size: 1, origin: [1]}") ==
          "usage [E-TILE] tile: 1 origins for 2 axes | give one for each axis");
    CHECK(
        stage_refusal("tile", "{size: 0.1, origin: [1e15, 0]}") ==
        "limit [E-TILE] a part lies 1e+16 tiles from the grid's origin along one axis, and at most 1e+09 are "
        "counted | choose a nearer origin, or a larger size");
    Mesh point = shapes::cube();
    for (Vec3& p : point.positions) p = {1, 2, 3};
    CHECK(test::failure([&] {
              run_stage("tile", "10%", scene_of(point));
          }).starts_with("stage [E-TILE] the size of the tiles comes to 0 in this scene"));
    CHECK(test::failure([&] {
              run_stage("section", "{hatch: 1%}", scene_of(point));
          }).starts_with("stage [E-HATCH] the spacing of 'hatch' comes to 0 in this scene"));
    CHECK(test::failure([&] {
              run_stage("section", "{spacing: 1%}", scene_of(point));
          }).starts_with("stage [E-SECTION] 'spacing' must be above zero"));
}

TEST_CASE("crop takes footprints in place, as WKT and from files", "[stages]") {
    const auto area = [](const std::string& options) {
        return area_of(run_stage("crop", options, scene_of(shapes::grid(4, 3))).scene);
    };
    CHECK(area("[[0.5, 0.5], [3.5, 0.5], [3.5, 2.5]]") == Approx(3));
    CHECK(area("[[[0.5, 0.5], [3.5, 0.5], [3.5, 2.5], [0.5, 2.5]], [[1, 1], [2, 1], [2, 2], [1, 2]]]") ==
          Approx(5));
    CHECK(area("{footprint: \"POLYGON ((0.5 0.5, 3.5 0.5, 3.5 2.5))\", keep: outside}") == Approx(9));
    CHECK(area("{footprint: [[0.5, 0.5], [3.5, 0.5], [3.5, 2.5]], by: whole}") == 0.5 * 1);
    CHECK(area("'[[0.5, 0.5], [3.5, 0.5], [3.5, 2.5]]'") == Approx(3)); // as on the command line
    CHECK(stage_refusal("crop", "'[[0.5, 0.5], [3.5'")
              .starts_with("usage [E-TYPE] expected a footprint (a file"));
    const test::TemporaryDirectory folder;
    const auto file = folder.path() / "outline.geojson";
    std::ofstream(file)
        << R"({"type": "Polygon", "coordinates": [[[0.5, 0.5], [3.5, 0.5], [3.5, 2.5], [0.5, 0.5]]]})";
    const auto run = run_stage("crop", "\"" + file.string() + "\"", scene_of(shapes::grid(4, 3)));
    CHECK(area_of(run.scene) == Approx(3));
    CHECK(run.state->record.inputs.size() == 1);
    CHECK(run.record.result["footprint_area"] == 3);
}

TEST_CASE("crop stands walls on the outline on request", "[stages]") {
    const auto run = run_stage("crop", "{footprint: [[0.5, -1], [2, -1], [2, 2], [0.5, 2]], cap: true}",
                               scene_of(shapes::cube()));
    CHECK(test::volume(run.scene.parts[0].mesh) == 0.5);
    CHECK(run.record.result["cap_faces"] == 6);
    REQUIRE(run.scene.materials.size() == 1);
    CHECK(run.scene.materials[0].name == "cap");
    const auto open = run_stage("crop", "{footprint: [[0.5, -1], [2, -1], [2, 2], [0.5, 2]], cap: true}",
                                scene_of(shapes::grid(1, 1)));
    REQUIRE(open.record.warnings.size() == 1);
    CHECK(open.record.warnings[0].id == "W-CAP-OPEN");
    CHECK(open.scene.materials.empty());
    CHECK(stage_refusal("crop", "{footprint: [[0, 0], [1, 0], [1, 1]], cap: true, by: whole}") ==
          "usage [E-CONFLICT] crop: cap needs a cut at the outline, and with whole faces there is none | "
          "leave out cap, or use by: cut");
}

TEST_CASE("crop keeps both sides as two parts", "[stages]") {
    const auto run =
        run_stage("crop", "{footprint: [[0.5, -1], [2, -1], [2, 2], [0.5, 2]], cap: true, keep: both}",
                  scene_of(shapes::cube()));
    REQUIRE(run.scene.parts.size() == 2);
    CHECK(run.scene.parts[0].name == "part.inside");
    CHECK(run.scene.parts[1].name == "part.outside");
    for (const Part& part : run.scene.parts) {
        CHECK(test::volume(part.mesh) == 0.5);
        CHECK(part.changed);
    }
    CHECK(run.record.result["cap_faces"] == 12);
    CHECK(run.record.result["faces_after"] == run.scene.parts[0].mesh.face_count() * 2);
    CHECK(run.record.warnings.empty());
    const auto all = run_stage("crop", "{footprint: [[-1, -1], [9, -1], [9, 9], [-1, 9]], keep: both}",
                               scene_of(shapes::cube()));
    CHECK(all.record.warnings.at(0).id == "W-CROP-ALL");
}

TEST_CASE("crop snaps unless told not to", "[stages]") {
    Mesh cube = shapes::cube();
    for (Vec3& p : cube.positions) p = p * static_cast<double>(0.1F);
    const std::string outside = "{footprint: [[0, 0], [0.1, 0], [0.1, 0.1], [0, 0.1]], keep: outside";
    const auto snapped = run_stage("crop", outside + "}", scene_of(cube));
    CHECK(snapped.scene.parts[0].mesh.face_count() == 0);
    CHECK(snapped.record.result["snapped"] == 6);
    const auto pure = run_stage("crop", outside + ", snap: 0}", scene_of(cube));
    CHECK(pure.scene.parts[0].mesh.face_count() > 0);
    CHECK(pure.record.result["snapped"] == 0);
}

TEST_CASE("crop looks along the scene's up axis", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.up = UpAxis::y;
    CHECK(run_stage("crop", "[[0, 0], [1, 0], [1, 1]]", scene).record.result["axis"] == "y");
    CHECK(run_stage("crop", "{footprint: [[0, 0], [1, 0], [1, 1]], axis: x}", scene).record.result["axis"] ==
          "x");
}

TEST_CASE("crop says when nothing or all is kept", "[stages]") {
    const auto warned = [](const char* options) {
        const auto run = run_stage("crop", options, scene_of(shapes::grid(4, 3)));
        REQUIRE(run.record.warnings.size() == 1);
        return run.record.warnings[0].id + " " + run.record.warnings[0].message;
    };
    CHECK(warned("[[10, 10], [11, 10], [11, 11]]") == "W-CROP-NOTHING crop: nothing of part 'part' was kept");
    CHECK(warned("[[-9, -9], [99, -9], [99, 99], [-9, 99]]") ==
          "W-CROP-ALL crop: the outline does not cut part 'part'; all of it was kept");
}

TEST_CASE("crop refuses footprints before it runs", "[stages]") {
    CHECK(stage_refusal("crop", "[[0, 0], [2, 2], [2, 0], [0, 2]]")
              .starts_with("usage [E-FOOTPRINT] crop: the footprint intersects itself near (1, 1)"));
    CHECK(stage_refusal("crop", "[[0, 0], [1, 0]]")
              .starts_with("usage [E-FOOTPRINT] crop: ring 1 of the footprint has 2"));
    CHECK(stage_refusal("crop", "[[0, 0], [1]]").starts_with("usage [E-TYPE] expected a footprint"));
    CHECK(stage_refusal("crop", "\"POLYGON ((0 0, 1\"").starts_with("usage [E-WKT]"));
    CHECK(stage_refusal("crop", "missing.geojson").starts_with("missing [E-FILE]"));
}
