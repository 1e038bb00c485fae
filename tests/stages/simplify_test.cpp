#include "geometry/crumple/crumple.hpp"
#include "geometry/edit/surgery.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"
#include "support/surface.hpp"

#include <fmt/format.h>

using namespace facetmill;
using test::options;
using test::problems_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("simplify measures what it did, in the world", "[stages]") {
    Scene scene = scene_of(shapes::icosphere(3));
    for (int i = 0; i < 3; ++i) scene.parts[0].transform.m[i][i] = 10;
    const auto r = run_stage("simplify", "{ratio: 10%, certify: true}", scene);
    const Json& part = r.record.result["parts"][0];
    CHECK(part["ratio"].get<double>() == Approx(0.1));
    const Json& d = part["deviation"];
    CHECK(d["maximum"].get<double>() > 0.1); // of a sphere of radius 10
    CHECK(d["maximum"].get<double>() < 1);
    CHECK(d["rms"].get<double>() < d["maximum"].get<double>());
    CHECK(d["bound"].get<double>() >= d["maximum"].get<double>());
    CHECK(d["forward"]["samples"].get<int>() == 100000);
    CHECK_FALSE(run_stage("simplify", "{ratio: 10%, measure: false}", scene)
                    .record.result["parts"][0]
                    .contains("deviation"));
}

TEST_CASE("simplify says on the terminal what it did", "[stages]") {
    const auto said = [](const char* options) {
        return run_stage("simplify", options, scene_of(shapes::icosphere(3))).record.said.at(0);
    };
    CHECK(said("10%").starts_with("part: 1,280 -> 128 triangles (10 %), stopped by ratio; deviation "));
    CHECK(said("{ratio: 10%, measure: false}") == "part: 1,280 -> 128 triangles (10 %), stopped by ratio");
    CHECK(said("{faces: 1, measure: false, max_quadric_error: off}") ==
          "part: 1,280 -> 4 triangles (0.312 %), stopped above the target");
    CHECK(said("{faces: 5000, measure: false}") == "part: 1,280 -> 1,280 triangles (100 %), nothing to do");
}

TEST_CASE("simplify: max_error is a length in the world", "[stages]") {
    Scene scene = scene_of(shapes::icosphere(4));
    for (int i = 0; i < 3; ++i) scene.parts[0].transform.m[i][i] = 10;
    const auto r = run_stage("simplify", "{max_error: 0.1}", scene);
    const Json& part = r.record.result["parts"][0];
    CHECK(part["stopped_by"] == "max_error");
    CHECK(part["deviation"]["maximum"].get<double>() <= 0.1 * (1 + 1e-9));
    CHECK(part["deviation"]["maximum"].get<double>() > 0.05);
}

TEST_CASE("simplify: levels of detail become parts", "[stages]") {
    const auto r = run_stage("simplify", "{lods: [100%, 50%, 10%]}", scene_of(shapes::icosphere(3)));
    for (const char* text : {"'100%,50%,10%'", "'[100%, 50%, 10%]'"}) // as one-liners have it
        CHECK(run_stage("simplify", fmt::format("{{lods: {}}}", text), scene_of(shapes::icosphere(3)))
                  .scene.parts.size() == 3);
    REQUIRE(r.scene.parts.size() == 3);
    CHECK(r.scene.parts[0].name == "part");
    CHECK(r.scene.parts[2].name == "part.lod2");
    CHECK(r.scene.parts[0].mesh.face_count() == 1280);
    CHECK(r.scene.parts[1].mesh.face_count() == 640);
    CHECK(r.scene.parts[2].mesh.face_count() == 128);
    const Json& parts = r.record.result["parts"];
    CHECK(parts.size() == 3);
    CHECK(parts[1]["deviation"]["maximum"].get<double>() < parts[2]["deviation"]["maximum"].get<double>());
}

namespace {

/// The halves of a rough ball, as two parts whose borders touch.
Scene halves() {
    const Mesh ball = crumple(shapes::icosphere(4), {.amplitude = 0.01}).mesh;
    std::vector<Index> labels(ball.face_count());
    for (Index f = 0; f < labels.size(); ++f)
        labels[f] = ball.point(3 * f).z + ball.point(3 * f + 1).z + ball.point(3 * f + 2).z > 0;
    auto pieces = separated(ball, labels, 2);
    Scene scene = scene_of(std::move(pieces[0]));
    scene.parts.push_back(Part{"upper", std::move(pieces[1])});
    return scene;
}

/// All parts merged, with vertices at the same position welded.
test::Counts welded(const Scene& scene) {
    Mesh all;
    for (const Part& part : scene.parts) append(all, part.mesh);
    weld_exact(all);
    return test::count(all);
}

} // namespace

TEST_CASE("simplify: borders of parts that touch stay matched", "[stages]") {
    for (const char* options : {"10%", "{ratio: 10%, method: shortest-edge}", "{faces: 500}",
                                "{ratio: 10%, lock: boundary}", "{ratio: 20%, method: constrained}"}) {
        INFO(options);
        const auto r = run_stage("simplify", options, halves());
        REQUIRE(r.scene.parts.size() == 2);
        CHECK(r.scene.parts[1].name == "upper");
        CHECK(r.scene.face_count() <= 1100);
        CHECK(welded(r.scene).open == 0);
        CHECK(welded(r.scene).euler == 2);
        for (const Part& part : r.scene.parts) {
            CHECK(test::count(part.mesh).euler == 1);
            CHECK(part.mesh.attributes.empty());
        }
    }
    const Json parts = run_stage("simplify", "10%", halves()).record.result["parts"];
    CHECK(parts[0]["joint_with"] == Json{"upper"});
    CHECK(parts[0]["triangles_before"].get<int>() + parts[1]["triangles_before"].get<int>() == 5120);
}

TEST_CASE("simplify: where only one of two parts that touch is simplified, the border stays", "[stages]") {
    Scene scene = halves();
    Scene only = scene;
    only.parts[1].transform.m[0][3] =
        0x1p-60; // another node, at the same position within the accuracy of doubles
    const auto apart = run_stage("simplify", "10%", only);
    CHECK(welded(apart.scene).open == 0);
    CHECK_FALSE(apart.record.result["parts"][0].contains("joint_with"));
    scene.parts[1].mesh.attributes.push_back({"extra", Domain::face, Role::generic, 1, false,
                                              std::vector<double>(scene.parts[1].mesh.face_count())});
    const auto other = run_stage("simplify", "10%", scene); // attributes that do not fit together
    CHECK(welded(other.scene).open == 0);
    CHECK(other.scene.face_count() < 1500);
}

TEST_CASE("simplify: levels of parts that touch match level by level", "[stages]") {
    const auto r = run_stage("simplify", "{lods: [100%, 30%, 5%]}", halves());
    REQUIRE(r.scene.parts.size() == 6);
    for (const char* suffix : {"", ".lod1", ".lod2"}) {
        Scene level;
        for (const Part& part : r.scene.parts)
            if (part.name == std::string("part") + suffix || part.name == std::string("upper") + suffix)
                level.parts.push_back(part);
        REQUIRE(level.parts.size() == 2);
        CHECK(welded(level).open == 0);
    }
}

TEST_CASE("simplify: a part that is gone is told", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    const auto r = run_stage("simplify", "{faces: 1, topology: allow, max_quadric_error: off}", scene);
    CHECK(r.mesh().face_count() == 0);
    CHECK(r.warnings() == std::vector<std::string>{"W-SIMPLIFY-VANISHED", "W-SURFACE-LOST"});
}

TEST_CASE("simplify: what cannot be is refused before anything is opened", "[stages]") {
    const auto refusal = [](const char* options) {
        return test::failure([&] { run_stage("simplify", options, scene_of(shapes::cube())); });
    };
    CHECK(refusal("{lods: [50%, 80%]}").find("simplify: lods: ratios must go from fine to coarse") !=
          std::string::npos);
    CHECK(refusal("{lods: [50%], faces: 10}").find("simplify: lods has its own targets") !=
          std::string::npos);
    CHECK(refusal("{ratio: 10%, lock: sems}").find("lock has no 'sems'") != std::string::npos);
    CHECK(refusal("{ratio: 10%, lock: [box]}").find("lock: {box: {min: [0, 0, 0]") != std::string::npos);
    CHECK(refusal("{max_error: -1}") != "");
}

TEST_CASE("simplify: locks are a list of words or a map", "[stages]") {
    const auto open = [](const test::StageRun& r) {
        const Mesh& m = r.scene.parts[0].mesh;
        return std::count_if(m.positions.begin(), m.positions.end(),
                             [](const Vec3& p) { return p.x == 0 || p.y == 0 || p.x == 8 || p.y == 8; });
    };
    const Scene grid = scene_of(shapes::grid(8, 8));
    CHECK(open(run_stage("simplify", "{ratio: 5%, lock: boundary, measure: false}", grid)) == 32);
    CHECK(open(run_stage("simplify", "{ratio: 5%, lock: [seams, boundary], measure: false}", grid)) == 32);
    CHECK(open(run_stage("simplify", "{ratio: 5%, lock: {boundary: true}, measure: false}", grid)) == 32);
    CHECK(open(run_stage("simplify", "{ratio: 5%, lock: 'seams,boundary', measure: false}", grid)) == 32);
    CHECK(open(run_stage("simplify", "{ratio: 5%, measure: false}", grid)) < 32);
    const auto boxed = run_stage(
        "simplify", "{ratio: 5%, measure: false, lock: {box: {min: [0, 0, -1], max: [8, 0.5, 1]}}}", grid);
    CHECK(std::count_if(boxed.scene.parts[0].mesh.positions.begin(),
                        boxed.scene.parts[0].mesh.positions.end(),
                        [](const Vec3& p) { return p.y == 0; }) == 9);
}

TEST_CASE("simplify: options that do not go together are told at once", "[stages]") {
    const auto problems = [](const char* text) {
        Problems found;
        const auto source = std::make_shared<const SourceText>(SourceText{"test.yaml", text});
        return test::problems_of("simplify", pipeline::parse_yaml(source, found));
    };
    CHECK(problems("{ratio: 10%, method: cluster, lock: boundary, self_intersections: avoid}")
              .find("cluster cannot lock vertices") != std::string::npos);
    CHECK(problems("{ratio: 10%, method: cluster, lock: boundary, self_intersections: avoid}")
              .find("cluster cannot avoid self-intersections") != std::string::npos);
    CHECK(problems("{ratio: 10%, method: shortest-edge, weights: {uv: 2}}").find("weights need") !=
          std::string::npos);
    CHECK(problems("{ratio: 10%, constraints: {roundness: 0.2}}").find("constraints need") !=
          std::string::npos);
    CHECK(problems("{ratio: 10%, method: constrained, topology: allow}").find("keeps the topology") !=
          std::string::npos);
    CHECK(problems("{ratio: 10%, weights: {colour: -1}}").find("E-RANGE") != std::string::npos);
    CHECK(problems("{ratio: 10%, weights: 0}") == "");
    CHECK(problems("{ratio: 10%, lock: {box: {min: [0, 0, 0], max: [0, 1, 1]}}}").find("E-BOX") !=
          std::string::npos);
    // A number that could be a ratio or a count is refused with a question.
    CHECK(problems("1").find("write 100%, or name the option for a count (faces: 1)") != std::string::npos);
    CHECK(problems("5000").find("a ratio needs a point or a % (50%); for a count write faces: 5000") !=
          std::string::npos);
    CHECK(problems("{lods: []}").find("simplify: lods needs at least one ratio") != std::string::npos);
    CHECK(problems("{lods: [50%], method: constrained, max_error: 1%, lock: boundary}") ==
          "E-CONFLICT simplify: the method constrained has no max_error | use constraints: {hausdorff: 0.1%} "
          "to limit the error\nE-CONFLICT simplify: the method constrained has no lods | use another method, "
          "or one simplify stage for each level\nE-CONFLICT simplify: lods has its own targets | leave out "
          "ratio, faces, vertices and max_error");
    CHECK(problems("1.5").find("E-RANGE") != std::string::npos);
}

TEST_CASE("simplify reports what became of the topology when it may change", "[stages]") {
    Mesh m = shapes::icosphere(3), crumb = shapes::icosphere(1);
    for (auto& p : crumb.positions) p = p * 0.001 + Vec3{2, 0, 0};
    append(m, crumb);
    const auto r = run_stage("simplify", "{ratio: 20%, topology: allow, measure: false}", scene_of(m));
    const Json& topology = r.record.result["parts"][0]["topology"];
    CHECK(topology["before"]["components"] == 2);
    CHECK(topology["after"]["components"] == 1);
    CHECK_FALSE(run_stage("simplify", "{ratio: 20%, measure: false}", scene_of(m))
                    .record.result["parts"][0]
                    .contains("topology"));
    const auto fast = run_stage("simplify", "{ratio: 20%, method: cluster, measure: false}", scene_of(m));
    CHECK(fast.record.result["parts"][0]["cell"].get<double>() > 0);
    CHECK(run_stage("simplify", "{ratio: 20%, method: constrained}", scene_of(m))
              .record.result["parts"][0]["largest_error"]
              .is_null());
}

TEST_CASE("simplify takes faces without area, and targets above and below what there is", "[stages]") {
    Mesh flat;
    flat.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    flat.corners = {0, 1, 2, 1, 2, 3, 0, 1, 3};
    for (const char* method : {"quadric", "quadric-endpoints", "shortest-edge", "constrained", "cluster"}) {
        const auto r =
            run_stage("simplify", std::string("{faces: 1, method: ") + method + "}", scene_of(flat));
        CHECK(r.mesh().face_count() > 0);
        const auto above =
            run_stage("simplify", std::string("{faces: 5000, method: ") + method + "}", scene_of(flat));
        CHECK(above.warnings() == std::vector<std::string>{"W-SIMPLIFY-NOTHING"});
        CHECK(above.mesh().corners == flat.corners);
    }
    const auto stuck =
        run_stage("simplify", "{faces: 1, max_quadric_error: off}", scene_of(shapes::icosphere(2)));
    CHECK(stuck.warnings() == std::vector<std::string>{"W-SIMPLIFY-STOPPED"});
    CHECK(stuck.mesh().face_count() == 4);
}

TEST_CASE("simplify: 100 % does nothing, as it says, without a warning", "[stages]") {
    CHECK(run_stage("simplify", "100%", scene_of(shapes::icosphere(2))).warnings().empty());
    CHECK(
        run_stage("simplify", "{lods: [100%, 50%, 10%]}", scene_of(shapes::icosphere(3))).warnings().empty());
    CHECK(run_stage("simplify", "{faces: 320}", scene_of(shapes::icosphere(2))).warnings().empty());
    CHECK(run_stage("simplify", "{vertices: 162}", scene_of(shapes::icosphere(2))).warnings().empty());
    CHECK(run_stage("simplify", "{faces: 321}", scene_of(shapes::icosphere(2))).warnings() ==
          std::vector<std::string>{"W-SIMPLIFY-NOTHING"});
    CHECK(run_stage("simplify", "{ratio: 100%, faces: 5000}", scene_of(shapes::cube())).warnings() ==
          std::vector<std::string>{"W-SIMPLIFY-NOTHING"});
}

TEST_CASE("simplify: area and volume before and after are reported", "[stages]") {
    Scene scene = scene_of(shapes::icosphere(4));
    for (int i = 0; i < 3; ++i) scene.parts[0].transform.m[i][i] = 10;
    const Json size = run_stage("simplify", "10%", scene).record.result["parts"][0]["size"];
    const double ball = 4.18879 * 1000;
    CHECK(size["before"]["volume"].get<double>() == Approx(ball).epsilon(0.01));
    CHECK(size["after"]["volume"].get<double>() == Approx(ball).epsilon(0.02));
    CHECK(size["after"]["volume"] != size["before"]["volume"]);
    CHECK(size["before"]["area"].get<double>() == Approx(1256.6).epsilon(0.01));
    CHECK(size["after"]["area"].get<double>() == Approx(1256.6).epsilon(0.02));
    const Json open = run_stage("simplify", "20%", scene_of(shapes::grid(8, 8))).record.result["parts"][0];
    CHECK(open["size"]["before"]["volume"].is_null());
    CHECK(open["size"]["after"]["area"].get<double>() == Approx(64));
    CHECK_FALSE(run_stage("simplify", "{ratio: 20%, measure: false}", scene_of(shapes::grid(8, 8)))
                    .record.result["parts"][0]
                    .contains("size"));
}

TEST_CASE("parts share the samples of the deviation by area and number of triangles", "[stages]") {
    Scene scene = scene_of(shapes::icosphere(3)); // 1280 triangles
    scene.parts.push_back(scene.parts[0]);
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "twice";
    scene.parts[2].name = "still";
    for (int i = 0; i < 3; ++i) scene.parts[1].transform.m[i][i] = 2;
    for (std::size_t i = 1; i < 3; ++i) scene.parts[i].transform.m[0][3] = 10 * double(i);
    const auto r = run_stage("simplify", "{ratio: 10%}", scene);
    const auto samples = [&](std::size_t part) {
        return r.record.result["parts"][part]["deviation"]["forward"]["samples"].get<double>();
    };
    CHECK(samples(0) == Approx(100000 * (1.0 / 6 + 1.0 / 12)).margin(1)); // a third, and one of 1 + 4 + 1
    CHECK(samples(1) == Approx(100000 * (1.0 / 6 + 4.0 / 12)).margin(1));
    CHECK(samples(2) == samples(0));
}

TEST_CASE("simplify: parts with one mesh become what each becomes alone, however they stand", "[stages]") {
    const Scene one = scene_of(shapes::icosphere(3));
    Scene scene = one;
    for (const char* name : {"moved", "turned", "large"}) {
        scene.parts.push_back(one.parts[0]);
        scene.parts.back().name = name;
    }
    for (std::size_t p = 1; p < 4; ++p) scene.parts[p].transform.m[0][3] = 16 * double(p);
    std::swap(scene.parts[2].transform.m[0], scene.parts[2].transform.m[1]); // and mirrored
    for (int i = 0; i < 3; ++i) scene.parts[3].transform.m[i][i] = 2;
    for (const std::string asked : {"{ratio: 10%, share: equal}", "{lods: [50%, 10%], share: equal}",
                                    "{ratio: 10%, method: cluster}"}) {
        const auto all = run_stage("simplify", asked, scene);
        for (std::size_t p = 0; p < 4; ++p) {
            Scene alone = one;
            alone.parts[0] = scene.parts[p];
            const auto r = run_stage("simplify", asked, alone);
            CHECK(all.scene.parts[p].mesh.positions == r.scene.parts[0].mesh.positions);
            CHECK(all.scene.parts[p].mesh.corners == r.scene.parts[0].mesh.corners);
        }
    }
    const Json parts = run_stage("simplify", "{ratio: 10%, share: equal}", scene).record.result["parts"];
    const auto maximum = [&](std::size_t p) { return parts[p]["deviation"]["maximum"].get<double>(); };
    const auto x_of = [&](std::size_t p, const char* end) {
        return parts[p]["deviation"]["forward"]["at"][end][0].get<double>();
    };
    CHECK(x_of(1, "from") == Approx(x_of(0, "from") + 16));
    CHECK(x_of(1, "to") == Approx(x_of(0, "to") + 16));
    CHECK(maximum(1) == maximum(0));
    CHECK(maximum(3) == Approx(2 * maximum(0)).epsilon(0.01));
    CHECK(parts[1]["size"] == parts[0]["size"]);
}

TEST_CASE("simplify: a bare ratio, and what is reported", "[stages]") {
    const auto r = run_stage("simplify", Value::scalar("25%"), scene_of(shapes::icosphere(3)));
    CHECK(r.mesh().face_count() == 320);
    const Json& part = r.record.result["parts"][0];
    CHECK(part["triangles_before"] == 1280);
    CHECK(part["triangles_after"] == 320);
    CHECK(part["stopped_by"] == "ratio");
    CHECK(r.warnings().empty());
}

TEST_CASE("simplify says of a cloud of points that it has no faces, not that it has no vertices",
          "[stages]") {
    Mesh cloud;
    cloud.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto r = run_stage("simplify", options({{"ratio", "50%"}}), scene_of(cloud));
    CHECK(r.mesh().vertex_count() == 4);
    REQUIRE(r.warnings() == std::vector<std::string>{"W-SIMPLIFY-NOTHING"});
    CHECK(r.record.warnings[0].message ==
          "part 'part' has no faces to simplify: the point cloud stays unchanged");
    CHECK(r.record.said.empty());
}

TEST_CASE("simplify: a target at or above the input is said, and is no failure", "[stages]") {
    const auto r = run_stage("simplify", options({{"faces", "5000"}}), scene_of(shapes::cube()));
    CHECK(r.warnings() == std::vector<std::string>{"W-SIMPLIFY-NOTHING"});
    CHECK(r.record.warnings[0].message ==
          "part 'part' has 12 triangles and 8 vertices, at or below the target: nothing to do");
    CHECK(test::same(r.mesh(), shapes::cube()));
}

TEST_CASE("simplify: what topology does not allow is said, and is no failure", "[stages]") {
    const auto r = run_stage("simplify", options({{"faces", "2"}}), scene_of(shapes::tetrahedron()));
    CHECK(r.warnings() == std::vector<std::string>{"W-SIMPLIFY-STOPPED"});
    CHECK(r.record.warnings[0].message == "part 'part' stopped at 4 triangles, above the target: the "
                                          "remaining edges are blocked: 6 by topology");
    CHECK(r.record.result["parts"][0]["stopped_by"] == "stuck");
}

TEST_CASE("simplify: a count is shared among the parts", "[stages]") {
    Scene scene = scene_of(shapes::icosphere(3));
    scene.parts.push_back(scene_of(shapes::icosphere(2)).parts.front());
    const auto r = run_stage("simplify", "{faces: 400, share: equal, max_quadric_error: off}", scene);
    CHECK(r.scene.parts[0].mesh.face_count() == 320);
    CHECK(r.scene.parts[1].mesh.face_count() == 80);
}

TEST_CASE("simplify: needs a target, and a bare 1 or 5000 is no ratio", "[stages]") {
    CHECK(problems_of("simplify", {}) != "");
    CHECK(problems_of("simplify", Value::scalar("1")) != "");
    CHECK(problems_of("simplify", Value::scalar("5000")) != "");
}

// --- one target for several parts

namespace {

std::size_t faces_of(const test::StageRun& r, std::size_t part) {
    return r.scene.parts[part].mesh.face_count();
}

/// A sphere and a flat sheet next to it.
Scene sphere_and_sheet() {
    Scene scene = scene_of(shapes::icosphere(3));           // 1280 triangles
    scene.parts.push_back({"sheet", shapes::grid(16, 16)}); // 512
    scene.parts[1].transform.m[0][3] = 4;
    return scene;
}

double largest_deviation(const test::StageRun& r) {
    double largest = 0;
    for (const Json& part : r.record.result["parts"])
        largest = std::max(largest, part["deviation"]["maximum"].get<double>());
    return largest;
}

} // namespace

TEST_CASE("simplify: several parts keep their triangles where they are needed", "[stages]") {
    const auto by_error = run_stage("simplify", "50%", sphere_and_sheet());
    const auto equal = run_stage("simplify", "{ratio: 50%, share: equal}", sphere_and_sheet());
    CHECK(faces_of(equal, 0) == 640);
    CHECK(faces_of(equal, 1) >= 255); // a collapse at the boundary removes one
    CHECK(faces_of(equal, 1) <= 256);
    CHECK(by_error.scene.face_count() == 896);
    CHECK(faces_of(by_error, 1) < 64); // it is flat
    CHECK(largest_deviation(by_error) < 0.8 * largest_deviation(equal));
    CHECK(by_error.warnings().empty());
    for (const Json& part : by_error.record.result["parts"]) CHECK(part["stopped_by"] == "ratio");
    CHECK(run_stage("simplify", "{faces: 900}", sphere_and_sheet()).scene.face_count() == 900);
    const auto vertices = run_stage("simplify", "{vertices: 400}", sphere_and_sheet());
    CHECK(vertices.scene.parts[0].mesh.vertex_count() + vertices.scene.parts[1].mesh.vertex_count() == 400);
    CHECK(vertices.record.result["parts"][0]["stopped_by"] == "vertices");
}

TEST_CASE("simplify: each level of several parts is a target of all", "[stages]") {
    const auto r = run_stage("simplify", "{lods: [100%, 50%, 25%]}", sphere_and_sheet());
    REQUIRE(r.scene.parts.size() == 6); // sphere, sheet, and two levels of each
    CHECK(faces_of(r, 0) + faces_of(r, 1) == 1792);
    CHECK(faces_of(r, 2) + faces_of(r, 4) == 896);
    CHECK(faces_of(r, 3) + faces_of(r, 5) == 448);
    const auto once = run_stage("simplify", "50%", sphere_and_sheet());
    CHECK(faces_of(once, 0) == faces_of(r, 2));
}

TEST_CASE("simplify: errors of parts are compared as their nodes scale them", "[stages]") {
    Scene scene = scene_of(shapes::icosphere(3));
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "large";
    for (int i = 0; i < 3; ++i) scene.parts[1].transform.m[i][i] = 8;
    scene.parts[1].transform.m[0][3] = 20;
    for (const char* options : {"20%", "{ratio: 20%, method: shortest-edge}"}) {
        INFO(options);
        const auto r = run_stage("simplify", options, scene);
        CHECK(r.scene.face_count() == 512);
        CHECK(faces_of(r, 1) > 2 * faces_of(r, 0));
    }
}

TEST_CASE("simplify: parts with one mesh and one scale share alike, and each of them counts", "[stages]") {
    Scene scene = sphere_and_sheet();
    for (const char* name : {"second", "turned"}) {
        scene.parts.push_back(scene.parts[0]);
        scene.parts.back().name = name;
        scene.parts.back().transform.m[1][3] = 4.0 * double(scene.parts.size());
    }
    std::swap(scene.parts[3].transform.m[0], scene.parts[3].transform.m[1]);
    const auto r = run_stage("simplify", "50%", scene);
    CHECK(test::same(r.scene.parts[0].mesh, r.scene.parts[2].mesh));
    CHECK(test::same(r.scene.parts[0].mesh, r.scene.parts[3].mesh));
    const std::size_t target = 3 * 640 + 256;
    CHECK(r.scene.face_count() <= target);
    CHECK(r.scene.face_count() + 6 > target); // a collapse removes two faces of each of the three
}

TEST_CASE("simplify: parts share a target by error also within max_error and without crossings", "[stages]") {
    const auto plain = run_stage("simplify", "50%", sphere_and_sheet());
    for (const char* more : {"max_error: 1", "self_intersections: count", "self_intersections: avoid"}) {
        INFO(more);
        const auto r = run_stage("simplify", fmt::format("{{ratio: 50%, {}}}", more), sphere_and_sheet());
        for (std::size_t p = 0; p < 2; ++p) {
            CHECK(faces_of(r, p) == faces_of(plain, p));
            CHECK(r.record.result["parts"][p]["stopped_by"] == "ratio");
        }
        CHECK(r.warnings().empty());
    }
}

TEST_CASE("simplify: borders of parts stay matched where others share the target", "[stages]") {
    Scene scene = halves();
    scene.parts.push_back({"sheet", shapes::grid(32, 32)});
    scene.parts.back().transform.m[0][3] = 4;
    const auto r = run_stage("simplify", "{faces: 1000}", scene);
    CHECK(r.scene.face_count() == 1000);
    Scene ball = r.scene;
    ball.parts.pop_back();
    CHECK(welded(ball).open == 0);
    CHECK(r.record.result["parts"][0]["joint_with"] == Json{"upper"});
}

// --- the limit on the error

TEST_CASE("simplify stops before the shape is lost, and says so", "[stages]") {
    const auto r = run_stage("simplify", "30%", scene_of(shapes::cube()));
    CHECK(test::same(r.mesh(), shapes::cube()));
    CHECK(r.warnings() == std::vector<std::string>{"W-SIMPLIFY-LIMIT"});
    CHECK(r.record.warnings[0].message ==
          "part 'part' stopped at 12 of 12 triangles, above the target: fewer triangles would move the "
          "surface by more than max_quadric_error (1% of part)");
    const Json& part = r.record.result["parts"][0];
    CHECK(part["stopped_by"] == "max_quadric_error");
    CHECK(part["max_quadric_error"].get<double>() == Approx(0.01 * std::sqrt(3.0)));
    CHECK(part["blocked_edges"]["error"].get<int>() > 0);
    for (const char* off : {"{ratio: 30%, max_quadric_error: off}", "{ratio: 30%, max_quadric_error: false}",
                            "{ratio: 30%, max_quadric_error: 50% of part}"}) {
        const auto all = run_stage("simplify", off, scene_of(shapes::cube()));
        CHECK(all.mesh().face_count() == 4);
        CHECK(all.warnings() == std::vector<std::string>{"W-SURFACE-LOST"});
    }
}

TEST_CASE("simplify: separate boxes do not become slivers, and one warning tells of all", "[stages]") {
    Scene scene;
    for (int i = 0; i < 20; ++i) {
        Mesh box = shapes::cube();
        for (Vec3& p : box.positions) p = Vec3{p.x * (1 + 0.1 * i), p.y, p.z * 0.5} + Vec3{4.0 * i, 0, 0};
        scene.parts.push_back({fmt::format("box{}", i), std::move(box)});
    }
    const auto r = run_stage("simplify", "30%", scene);
    CHECK(r.scene.face_count() == 240);
    REQUIRE(r.warnings() == std::vector<std::string>{"W-SIMPLIFY-LIMIT"});
    CHECK(r.record.warnings[0].message.starts_with(
        "20 parts, the first part 'box0', stopped at 240 of 240 triangles, above the target"));
    // Flat parts are still simplified.
    scene.parts.push_back({"sheet", shapes::grid(16, 16)});
    scene.parts.back().transform.m[1][3] = 4;
    const auto more = run_stage("simplify", "50%", scene);
    CHECK(more.scene.face_count() >= 375); // a collapse at the boundary removes one
    CHECK(more.scene.face_count() <= 376);
    CHECK(more.warnings().empty());
}

TEST_CASE("simplify: the limit on the error is a length, of the part's diagonal or in the world",
          "[stages]") {
    Scene scene = scene_of(shapes::icosphere(3));
    for (int i = 0; i < 3; ++i) scene.parts[0].transform.m[i][i] = 10;
    const auto left = [&](const char* options) {
        return run_stage("simplify", options, scene).mesh().face_count();
    };
    const double diagonal = 10 * shapes::icosphere(3).bounds().diagonal();
    const auto r = run_stage("simplify", "{faces: 4, max_quadric_error: 0.5% of part}", scene);
    const Json& part = r.record.result["parts"][0];
    CHECK(part["max_quadric_error"].get<double>() == Approx(0.005 * diagonal));
    CHECK(part["largest_error"].get<double>() <= 0.005 * diagonal);
    CHECK(part["largest_error"].get<double>() > 0.004 * diagonal);
    CHECK(left(fmt::format("{{faces: 4, max_quadric_error: {}}}", 0.005 * diagonal).c_str()) ==
          r.mesh().face_count());
    CHECK(left("{faces: 4}") < r.mesh().face_count());
    CHECK(left("{faces: 4}") > 4);
}

TEST_CASE("simplify: what the limit on the error and the sharing do not go with is refused", "[stages]") {
    const auto problems = [](const char* text) {
        Problems found;
        const auto source = std::make_shared<const SourceText>(SourceText{"test.yaml", text});
        return test::problems_of("simplify", pipeline::parse_yaml(source, found));
    };
    const auto refuses = [&](const char* text, const char* what) {
        return problems(text).find(what) != std::string::npos;
    };
    CHECK(refuses("{ratio: 10%, max_error: 1%, max_quadric_error: 1%}",
                  "max_error replaces max_quadric_error"));
    CHECK(refuses("{ratio: 10%, method: cluster, max_quadric_error: 1%}", "needs the method quadric"));
    CHECK(
        refuses("{ratio: 10%, method: cluster, share: error}", "are not comparable, so parts cannot share"));
    CHECK(refuses("{ratio: 10%, max_quadric_error: -1}", "E-RANGE"));
    CHECK(refuses("{ratio: 10%, max_quadric_error: none}", "a length"));
    CHECK(problems("{ratio: 10%, max_error: 1%, max_quadric_error: off}") == "");
    CHECK(problems("{ratio: 10%, method: cluster, share: equal}") == "");
}

TEST_CASE("simplify: as far as it goes within an error is what was asked for", "[stages]") {
    const auto r = run_stage("simplify", options({{"max_error", "50%"}}), scene_of(shapes::icosphere(1)));
    CHECK(r.mesh().face_count() == 4);
    CHECK(r.warnings().empty());
}
