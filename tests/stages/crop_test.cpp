#include "base/math/numbers.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>

using namespace facetmill;
using test::refusal_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("crop takes footprints in place, as WKT and from files", "[stages]") {
    const auto area = [](const std::string& options) {
        return test::area(run_stage("crop", options, scene_of(shapes::grid(4, 3))).scene);
    };
    CHECK(area("[[0.5, 0.5], [3.5, 0.5], [3.5, 2.5]]") == Approx(3));
    CHECK(area("[[[0.5, 0.5], [3.5, 0.5], [3.5, 2.5], [0.5, 2.5]], [[1, 1], [2, 1], [2, 2], [1, 2]]]") ==
          Approx(5));
    CHECK(area("{footprint: \"POLYGON ((0.5 0.5, 3.5 0.5, 3.5 2.5))\", keep: outside}") == Approx(9));
    CHECK(area("{footprint: [[0.5, 0.5], [3.5, 0.5], [3.5, 2.5]], by: whole}") == 0.5 * 1);
    CHECK(area("'[[0.5, 0.5], [3.5, 0.5], [3.5, 2.5]]'") == Approx(3)); // as on the command line
    CHECK(refusal_of("crop", "'[[0.5, 0.5], [3.5'", scene_of(shapes::grid(4, 3)))
              .starts_with("usage [E-TYPE] expected a footprint (a file"));
    const test::TemporaryDirectory folder;
    const auto file = folder.path() / "outline.geojson";
    std::ofstream(file)
        << R"({"type": "Polygon", "coordinates": [[[0.5, 0.5], [3.5, 0.5], [3.5, 2.5], [0.5, 0.5]]]})";
    const auto run = run_stage("crop", "\"" + file.string() + "\"", scene_of(shapes::grid(4, 3)));
    CHECK(test::area(run.scene) == Approx(3));
    CHECK(run.state->record.inputs.size() == 1);
    CHECK(run.record.result["footprint_area"] == 3);
    const io::Bytes other(1);
    CHECK(test::failure([&] { run.state->outputs.add(file, other); }).find("would overwrite an input") !=
          std::string::npos);
}

TEST_CASE("crop converts a drawing to the unit of the scene, or warns", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto file = folder.path() / "inch.dxf";
    std::ofstream(file)
        << "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n1\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\n"
           "LWPOLYLINE\n70\n1\n10\n1\n20\n1\n10\n3\n20\n1\n10\n3\n20\n3\n10\n1\n20\n3\n0\n"
           "ENDSEC\n0\nEOF\n";
    auto scene = scene_of(shapes::grid(100, 100));
    scene.unit = Unit::mm;
    const auto converted = run_stage("crop", "\"" + file.string() + "\"", scene);
    CHECK(converted.record.result["footprint_area"].get<double>() == Approx(2580.64));
    CHECK(converted.warnings().empty());
    scene.unit = Unit::unknown;
    CHECK(run_stage("crop", "\"" + file.string() + "\"", scene).warnings() ==
          std::vector<std::string>{"W-UNITS"});
}

TEST_CASE("crop leaves triangles only on request", "[stages]") {
    const char* outline = "{footprint: [[0.4, -1], [2, -1], [2, 2], [0.5, 2]], cap: true, keep: both}";
    const auto polygons = run_stage("crop", outline, scene_of(shapes::cube()));
    CHECK_FALSE(polygons.scene.parts[0].mesh.all_triangles());
    std::string given = outline;
    given.insert(given.size() - 1, ", triangulate: true");
    const auto run = run_stage("crop", given, scene_of(shapes::cube()));
    REQUIRE(run.scene.parts.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const Mesh& mesh = run.scene.parts[i].mesh;
        CHECK(mesh.all_triangles());
        CHECK(inspect(mesh).closed);
        CHECK(test::volume(mesh) == Approx(test::volume(polygons.scene.parts[i].mesh)));
    }
    CHECK(run.record.result["faces_after"] == run.scene.face_count());
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
    CHECK(refusal_of("crop", "{footprint: [[0, 0], [1, 0], [1, 1]], cap: true, by: whole}",
                     scene_of(shapes::grid(4, 3))) ==
          "usage [E-CONFLICT] crop: 'cap' needs a cut at the outline, so it cannot be used with whole faces "
          "| remove cap, or use by: cut");
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
    CHECK(warned("[[10, 10], [11, 10], [11, 11]]") == "W-CROP-NOTHING crop: nothing of part 'part' was kept: "
                                                      "the footprint reaches from (10, 10) to (11, 11), "
                                                      "the part from (0, 0) to (4, 3)");
    CHECK(warned("[[-9, -9], [99, -9], [99, 99], [-9, 99]]") ==
          "W-CROP-ALL crop: the outline does not cut part 'part', which stays whole");
}

TEST_CASE("crop knows a footprint in degrees beside a mesh in metres", "[stages]") {
    Scene scene = scene_of(shapes::grid(4, 3));
    const auto hint = [&](const char* outline = "[[8.5, 47.3], [8.6, 47.3], [8.6, 47.4]]") {
        return run_stage("crop", outline, scene).record.warnings.at(0).hint;
    };
    CHECK(hint().find("degrees") == std::string::npos); // both may be metres
    for (Vec3& p : scene.parts[0].mesh.positions) p += Vec3{500000, 4649000, 0};
    CHECK(hint().starts_with("the footprint seems to be in degrees"));
    // Coordinates near 0, 0, or as large as a country, count from a different origin.
    for (const char* local :
         {"[[0, 0], [1, 0], [1, 1]]", "[[-2, -2], [2, -2], [2, 2]]", "[[20, 30], [60, 30], [60, 80]]"})
        CHECK(hint(local).find("that it has the same origin as the mesh") != std::string::npos);
    CHECK(hint("[[-0.25, 5.5], [-0.15, 5.5], [-0.15, 5.7]]")
              .starts_with("the footprint seems to be in degrees"));
}

TEST_CASE("crop refuses footprints before it runs", "[stages]") {
    CHECK(refusal_of("crop", "[[0, 0], [2, 2], [2, 0], [0, 2]]", scene_of(shapes::grid(4, 3)))
              .starts_with("usage [E-FOOTPRINT] crop: the footprint intersects itself near (1, 1)"));
    CHECK(refusal_of("crop", "[[0, 0], [1, 0]]", scene_of(shapes::grid(4, 3)))
              .starts_with("usage [E-FOOTPRINT] crop: ring 1 of the footprint has 2"));
    CHECK(refusal_of("crop", "[[0, 0], [1]]", scene_of(shapes::grid(4, 3)))
              .starts_with("usage [E-TYPE] expected a footprint"));
    CHECK(refusal_of("crop", "\"POLYGON ((0 0, 1\"", scene_of(shapes::grid(4, 3)))
              .starts_with("usage [E-WKT]"));
    CHECK(
        refusal_of("crop", "missing.geojson", scene_of(shapes::grid(4, 3))).starts_with("missing [E-FILE]"));
}

TEST_CASE("crop says when vertices far from the origin count as on the outline", "[stages]") {
    const std::string outline =
        "[[449990, 5399990], [450030, 5399990], [450030, 5400010.3], [449990, 5400010.3]]";
    Mesh far_away = shapes::cube();
    for (Vec3& p : far_away.positions) p = as_float32(p * 10.3 + Vec3{450000, 5400000, 0}); // y: 5400010.5
    const auto warned = [&](const Mesh& mesh, const std::string& options) {
        const auto ids = run_stage("crop", options, scene_of(mesh)).warnings();
        return std::count(ids.begin(), ids.end(), "W-SNAPPED");
    };
    CHECK(warned(far_away, "{footprint: " + outline + ", axis: z}") == 1);
    CHECK(warned(far_away, "{footprint: " + outline + ", axis: z, snap: 0}") == 0);
    Mesh near = shapes::cube(); // 0.1f is not 0.1, but the difference is negligible
    for (Vec3& p : near.positions) p = p * static_cast<double>(0.1F);
    CHECK(warned(near, "{footprint: [[0, 0], [0.1, 0], [0.1, 0.05], [0, 0.05]], axis: z}") == 0);
}

TEST_CASE("crop keeps the points of a cloud, each on one side", "[stages]") {
    Mesh cloud;
    for (int i = 0; i < 5; ++i) cloud.positions.push_back({static_cast<double>(i), 1, 0});
    const auto points = [&](const std::string& keep) {
        const std::string options = "{footprint: [[1, 0], [3, 0], [3, 2], [1, 2]], keep: " + keep + "}";
        return run_stage("crop", options, scene_of(cloud));
    };
    const auto inside = points("inside");
    REQUIRE(inside.mesh().vertex_count() == 3); // 1 and 3 are on the outline
    CHECK(inside.mesh().positions[0] == Vec3{1, 1, 0});
    CHECK(inside.warnings().empty());
    CHECK(points("outside").mesh().vertex_count() == 2);
    const auto both = points("both");
    REQUIRE(both.scene.parts.size() == 2);
    CHECK(both.scene.parts[0].mesh.vertex_count() == 3);
    CHECK(both.scene.parts[1].mesh.vertex_count() == 2);
    for (const char* by : {"whole", "centre", "overlapping"})
        CHECK(run_stage("crop", fmt::format("{{footprint: [[1, 0], [3, 0], [3, 2], [1, 2]], by: {}}}", by),
                        scene_of(cloud))
                  .mesh()
                  .vertex_count() == 3);
    CHECK(run_stage("crop", "[[10, 10], [11, 10], [11, 11]]", scene_of(cloud)).warnings() ==
          std::vector<std::string>{"W-CROP-NOTHING"});
    CHECK(run_stage("crop", "[[-9, -9], [9, -9], [9, 9], [-9, 9]]", scene_of(cloud)).warnings() ==
          std::vector<std::string>{"W-CROP-ALL"});
}

TEST_CASE(
    "crop and clip say how many parts of a scene stay whole and how many go, and warn when that is so of all",
    "[stages]") {
    Scene scene;
    for (int i = 0; i < 5; ++i) {
        Part& part = scene.parts.emplace_back();
        part.name = fmt::format("house{}", i);
        part.mesh = shapes::cube();
        part.transform.m[0][3] = 2.0 * i;
    }
    const auto crop = [&](const char* outline) { return run_stage("crop", outline, scene); };
    const auto some = crop("[[1.5, -1], [6.5, -1], [6.5, 2], [1.5, 2]]");
    CHECK(some.warnings().empty());
    CHECK(some.record.result["untouched_parts"] == 2);
    CHECK(some.record.result["emptied_parts"] == 2);
    CHECK(crop("[[90, 0], [91, 0], [91, 1]]").record.warnings.at(0).message ==
          "crop: nothing of the scene (5 parts) was kept: the footprint reaches from (90, 0) to (91, 1), the "
          "scene from (0, 0) to "
          "(9, 1)");
    CHECK(crop("[[-9, -9], [99, -9], [99, 99], [-9, 99]]").record.warnings.at(0).message ==
          "crop: the outline does not cut the scene (5 parts), which stays whole");
    const auto clip = run_stage("clip", "x=4.5", scene);
    CHECK(clip.warnings().empty());
    CHECK(clip.record.result["untouched_parts"] == 2);
    CHECK(clip.record.result["emptied_parts"] == 2);
    CHECK(run_stage("clip", "x=50", scene).warnings() == std::vector<std::string>{"W-CLIP-NOTHING"});
    CHECK(run_stage("clip", "x=-50", scene).warnings() == std::vector<std::string>{"W-CLIP-ALL"});
    // A part that was empty before counts nowhere.
    scene.parts[4].mesh = {};
    CHECK(crop("[[90, 0], [91, 0], [91, 1]]")
              .record.warnings.at(0)
              .message.find("the scene from (0, 0) to (7, 1)") != std::string::npos);
}
