#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

#include <algorithm>

using namespace facetmill;
using test::failure;
using test::run_stage;
using test::scene_of;

TEST_CASE("section reports one plane and passes the scene on", "[stages]") {
    const auto run = run_stage("section", "z=25%", scene_of(shapes::cube()));
    const Json& r = run.record.result;
    CHECK(r["planes"] == 1);
    CHECK(r["contours"] == 1);
    CHECK(r["area"] == 1.0);
    CHECK(r["kinds"]["quad"] == 1);
    CHECK(r["sections"][0]["origin"] == Json::array({0.0, 0.0, 0.25}));
    CHECK(r["sections"][0]["parts"][0]["contours"][0]["centroid"]["plane"] == Json::array({0.5, 0.5}));
    CHECK(run.scene.parts[0].mesh.face_count() == 12);
    CHECK_FALSE(run.scene.parts[0].changed);
}

TEST_CASE("a section has moments as a whole, its holes taken off", "[stages]") {
    Mesh tube = shapes::cube();
    for (Vec3& p : tube.positions) p = {4 * p.x, 2 * p.y, p.z};
    Mesh core = shapes::cube();
    for (Vec3& p : core.positions) p = {p.x + 2, p.y + 0.5, p.z};
    for (std::size_t c = 0; c < core.corners.size(); c += 3) std::swap(core.corners[c], core.corners[c + 1]);
    append(tube, core);
    const auto run = run_stage("section", "z=0.5", scene_of(tube, Unit::mm));
    const Json& whole = run.record.result["sections"][0]["parts"][0];
    CHECK(whole["area"] == 7);
    CHECK(whole["centroid"]["plane"][0].get<double>() == Approx((8 * 2 - 2.5) / 7));
    CHECK(whole["second_moments"]["about_origin"]["y"].get<double>() ==
          Approx(2 * 64.0 / 3 - (1.0 / 12 + 6.25)));
    CHECK(run.record.said ==
          std::vector<std::string>{"1 section: area 7 mm2, 2 contours (1 hole)",
                                   "centroid 1.92857 1 0.5, second moments about it 2.58333 to 10.2976 mm4"});
    append(tube, shapes::cube()); // overlaps the rest: the region would count twice
    CHECK(
        run_stage("section", "z=0.5", scene_of(tube)).record.result["sections"][0]["parts"][0]["centroid"] ==
        nullptr);
    CHECK(run_stage("section", "{count: 4}", scene_of(shapes::cube())).record.said ==
          std::vector<std::string>{"4 sections: area 4, 4 contours", "areas times spacing 1, volume 1"});
    CHECK(run_stage("section", "z=9", scene_of(shapes::cube())).record.said ==
          std::vector<std::string>{"1 section: area 0, 1 empty"});
}

TEST_CASE("hatching is limited over all sections together", "[stages]") {
    CHECK(failure([] {
              run_stage("section", "{count: 90, hatch: 0.00001}", scene_of(shapes::cube()));
          }).starts_with("limit [E-HATCH] hatching all sections would take about 12727922 lines"));
}

TEST_CASE("section takes planes in every form", "[stages]") {
    for (const char* plane :
         {"{plane: z=0.5}", "{plane: {normal: [0, 0, 3], through: [9, 9, 0.5]}}",
          "{plane: {normal: [0, 0, 1], through: 50%}}", "{plane: {coefficients: [0, 0, 2, -1]}}",
          "{plane: {normal: [0, 0, 1], through: centre}}", ""})
        CHECK(run_stage("section", plane, scene_of(shapes::cube())).record.result["area"] == 1.0);
}

TEST_CASE("a count of sections is spread over the extent and meets the volume", "[stages]") {
    const auto run = run_stage("section", "{count: 5}", scene_of(shapes::cube()));
    const Json& r = run.record.result;
    CHECK(r["planes"] == 5);
    CHECK(r["spacing"].get<double>() == Approx(0.2));
    CHECK(r["sections"][0]["height"].get<double>() == Approx(-0.4));
    CHECK(r["volume"].get<double>() == Approx(1));
    CHECK(r["ratio"].get<double>() == Approx(1));
}

TEST_CASE("every distance through the whole extent, or from the plane on with count", "[stages]") {
    CHECK(run_stage("section", "{plane: z=0.1, spacing: 0.25}", scene_of(shapes::cube()))
              .record.result["planes"] == 4);
    const auto run = run_stage("section", "{plane: z=0.1, spacing: 0.5, count: 3}", scene_of(shapes::cube()));
    CHECK(run.record.result["planes"] == 3);
    CHECK(run.record.result["empty"] == 1); // z = 1.1 misses
    CHECK(run_stage("section", "{spacing: 2mm, plane: z=1mm}", scene_of(shapes::cube(), Unit::cm))
              .record.result["planes"] == 5);
}

TEST_CASE("an empty section is a result", "[stages]") {
    const auto run = run_stage("section", "z=7", scene_of(shapes::cube()));
    CHECK(run.record.result["empty"] == 1);
    CHECK(run.record.result["area"] == 0.0);
    CHECK(run.record.warnings.empty());
}

TEST_CASE("an open mesh is said", "[stages]") {
    const auto run = run_stage("section", "x=0.5", scene_of(shapes::grid(2, 2)));
    REQUIRE(run.record.warnings.size() == 1);
    CHECK(run.record.warnings[0].id == "W-OPEN-SECTION");
    CHECK(run.record.warnings[0].hint.starts_with("use only the lines of a terrain or a sheet"));
    // Next to closed contours, an open contour may mean a hole.
    Scene two = scene_of(shapes::cube());
    append(two.parts[0].mesh, shapes::grid(2, 2));
    const auto some = run_stage("section", "x=0.5", two);
    REQUIRE(some.record.warnings.size() == 1);
    CHECK(some.record.warnings[0].hint.ends_with("close the holes of a solid with clean: {holes: minimal}"));
    CHECK(run.record.result["open"] == 1);
}

TEST_CASE("sections are written as drawings", "[stages]") {
    const test::TemporaryDirectory directory;
    const std::string at = directory.path().string();
    const auto run = run_stage("section",
                               "{plane: z=0.5, hatch: {spacing: 0.1, angle: 30}, path: ['" + at +
                                   "/a.svg', '" + at + "/a.dxf', '" + at + "/a.json']}",
                               scene_of(shapes::cube()));
    run.state->outputs.commit();
    for (const char* name : {"a.svg", "a.dxf", "a.json"})
        CHECK(std::filesystem::file_size(directory.path() / name) > 200);
}

TEST_CASE("section refuses what is no plane and no drawing", "[stages]") {
    const auto refusal = [](const char* options) {
        return failure([&] { run_stage("section", options, scene_of(shapes::cube())); });
    };
    CHECK(refusal("{path: a.pdf}") == "usage [E-DRAWING] test.yaml:1:8: section: 'a.pdf' is not a supported "
                                      "drawing format | use .svg, .dxf, .geojson or .json");
    CHECK(refusal("{plane: {normal: [0, 0, 0]}}") == "usage [E-PLANE] test.yaml:1:1: the plane's normal is "
                                                     "zero, so it has no direction | give a direction: "
                                                     "plane: {normal: [0, 0, 1]}");
    CHECK(refusal("w=2") ==
          "usage [E-TYPE] test.yaml:1:1: expected a plane ({normal: [0, 0, 1], through: centre}, z=0.2, "
          "x=10%, [A, B, C, D]), found 'w=2'");
    CHECK(refusal("{spacing: 9.5367431640625e-07}") ==
          "limit [E-SECTION] the stack would have 1048577 planes, but at most 100000 are possible | choose a "
          "larger spacing");
    CHECK(refusal("{plane: z=2mm}") ==
          "usage [E-UNIT] 'plane' is 2mm, but the scene has no unit | give the unit of the file (load: "
          "{unit: mm}), or use a bare number or a percentage");
}

TEST_CASE("section warns of contours that run clockwise or cross themselves", "[stages]") {
    Mesh cube = shapes::cube();
    const auto has = [](const auto& run, const std::string& id) {
        const auto ids = run.warnings();
        return std::find(ids.begin(), ids.end(), id) != ids.end();
    };
    CHECK_FALSE(has(run_stage("section", "z=0.5", scene_of(cube)), "W-INSIDE-OUT"));
    for (std::size_t c = 0; c < cube.corners.size(); c += 3) std::swap(cube.corners[c], cube.corners[c + 1]);
    const auto inside_out = run_stage("section", "z=0.5", scene_of(cube));
    REQUIRE(inside_out.warnings() == std::vector<std::string>{"W-INSIDE-OUT"});
    CHECK(inside_out.record.warnings[0].message == "1 outline runs clockwise, so its area is negative: the "
                                                   "mesh is inside out where the plane cuts it");
    Mesh bow = shapes::quad_cube(); // of which two walls cross
    std::swap(bow.positions[2], bow.positions[3]);
    std::swap(bow.positions[6], bow.positions[7]);
    const auto run = run_stage("section", "z=0.5", scene_of(bow));
    REQUIRE(run.warnings() == std::vector<std::string>{"W-SECTION-CROSSES"});
    CHECK(run.record.warnings[0].message ==
          "1 contour intersects itself: every region that it winds around counts as inside");
    CHECK(run.record.result["area"] == 0.5);
    CHECK(run.record.result["empty"] == 0);
}

TEST_CASE("section draws contours of a terrain over each other, without warnings", "[stages]") {
    Mesh hill = shapes::grid(8, 8);
    for (Vec3& p : hill.positions) p = {p.x + 500000, p.y + 5200000, p.x / 2};
    const test::TemporaryDirectory folder;
    const auto path = [&](const char* name) { return (folder / name).string(); };
    const auto run = run_stage("section",
                               "{layout: contours, spacing: 1, scale: 1000, path: [\"" + path("m.svg") +
                                   "\", \"" + path("m.dxf") + "\", \"" + path("m.geojson") + "\"]}",
                               scene_of(hill, Unit::m));
    CHECK(run.warnings().empty());
    const Json& r = run.record.result;
    CHECK(r["planes"] == 5); // heights 0 to 4
    CHECK(r["length"].get<double>() == Approx(32));
    CHECK_FALSE(r.contains("ratio"));
    CHECK(r["sections"][1]["height"] == 1);
    CHECK(run.record.said == std::vector<std::string>{"5 sections: length 32 m, 4 contours, 1 empty"});
}

TEST_CASE("a profile is upright", "[stages]") {
    CHECK(test::refusal_of("section", "{plane: z=50%, layout: profile}", scene_of(shapes::grid(4, 4)))
              .starts_with("stage [E-SECTION] the plane of a profile is not vertical"));
    CHECK(test::refusal_of("section", "{plane: x=50%, exaggeration: 2}", scene_of(shapes::grid(4, 4)))
              .find("layout: profile") != std::string::npos);
    const auto run = run_stage("section", "{plane: y=50%, layout: profile, exaggeration: 5}",
                               scene_of(shapes::grid(4, 4)));
    CHECK(run.warnings().empty());
    CHECK(run.record.result["length"] == 4);
}
