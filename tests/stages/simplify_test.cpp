#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
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
    CHECK(d["from_given"]["samples"].get<int>() > 100000);
    CHECK_FALSE(run_stage("simplify", "{ratio: 10%, measure: false}", scene)
                    .record.result["parts"][0]
                    .contains("deviation"));
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

TEST_CASE("simplify: what cannot be is refused before anything is opened", "[stages]") {
    const auto refusal = [](const char* options) {
        return test::failure([&] { run_stage("simplify", options, scene_of(shapes::cube())); });
    };
    CHECK(refusal("{lods: [50%, 80%]}").find("simplify: lods: ratios go from fine to coarse") !=
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
