#include "support/catch.hpp"

#include "geometry/intersect/self_intersections.hpp"
#include "support/failure.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::failure;
using test::options;
using test::problems_of;
using test::run_stage;
using test::scene_of;

namespace {

/// A closed unit cube of twelve triangles without the last.
Mesh holed_cube() {
    Mesh mesh = shapes::cube();
    mesh.corners.resize(33);
    return mesh;
}

} // namespace

TEST_CASE("clean reports what each step did", "[stages]") {
    const auto run = run_stage("clean", "{holes: minimal}", scene_of(holed_cube()));
    const auto& part = run.record.result["parts"][0];
    CHECK(part["changed"] == true);
    CHECK(part["filled_holes"] == 1);
    CHECK(part["hole_faces"] == 1);
    CHECK(part["welded_vertices"] == 0);
    CHECK(inspect(run.scene).closed);
    CHECK(run.record.warnings.empty());
}

TEST_CASE("clean says what it moved apart; asking for it needs 32-bit coordinates", "[stages]") {
    const auto run = run_stage("clean", "{precision: single}", scene_of(shapes::hourglass()));
    const auto& part = run.record.result["parts"][0];
    CHECK(part["changed"] == true);
    CHECK(part["moved_apart"] == 1);
    CHECK(part["farthest_apart"] > 0);
    CHECK(part["farthest_apart"] < 1e-6);
    CHECK(run.record.warnings.empty());
    const auto plain = run_stage("clean", "{precision: single, apart: false}", scene_of(shapes::hourglass()));
    CHECK(plain.record.result["parts"][0]["moved_apart"] == 0);
    CHECK(!plain.record.result["parts"][0].contains("farthest_apart"));
    CHECK(failure([] {
              run_stage("clean", "{apart: true}", scene_of(shapes::cube()));
          }).find("'apart' has no effect") != std::string::npos);
}

TEST_CASE("a bare clean leaves holes and small components", "[stages]") {
    const auto run = run_stage("clean", "", scene_of(holed_cube()));
    CHECK(run.record.result["parts"][0]["changed"] == false);
    CHECK(run.scene.parts[0].mesh.face_count() == 11);
}

TEST_CASE("clean warns of what it could not repair, and where", "[stages]") {
    Scene scene = scene_of(shapes::moebius(9));
    scene.parts[0].transform.m[0][3] = 100;
    const auto run = run_stage("clean", "{holes: planar}", std::move(scene));
    REQUIRE(run.record.warnings.size() == 1);
    CHECK(run.record.warnings[0].id == "W-CLEAN");
    CHECK(run.record.result["parts"][0]["not_done"][0]["step"] == "holes");
    CHECK(run.record.result["parts"][0]["not_done"][0]["at"][0] > 90);
}

TEST_CASE("clean reports what it united; true is all, false is off", "[stages]") {
    Mesh mesh = shapes::cube(), other = shapes::cube();
    for (Vec3& p : other.positions) p += Vec3{0.5, 0.5, 0.5};
    append(mesh, other);
    for (const char* options :
         {"{self_intersections: union}", "{self_intersections: all}", "{self_intersections: true}"}) {
        const auto run = run_stage("clean", options, scene_of(mesh));
        const auto& part = run.record.result["parts"][0];
        CHECK(part["united_components"] == 2);
        CHECK(part["refined_faces"] == 12);
        CHECK(part["covered_faces"] == 0);
        CHECK(inspect(run.scene).volume == 1.875);
        CHECK(run.record.warnings.empty());
    }
    for (const char* options : {"{self_intersections: off}", "{self_intersections: false}", ""})
        CHECK(run_stage("clean", options, scene_of(mesh)).record.result["parts"][0]["changed"] == false);
    CHECK(failure([&] {
              run_stage("clean", "{self_intersections: yes}", scene_of(mesh));
          }).find("E-CHOICE") != std::string::npos);
    // A reversed cube is inside out, and a warning says so.
    for (Index f = 12; f < 24; ++f) std::swap(mesh.corners[3 * f], mesh.corners[3 * f + 1]);
    const auto run = run_stage("clean", "{self_intersections: union}", scene_of(mesh));
    REQUIRE(run.record.warnings.size() == 1);
    CHECK(run.record.warnings[0].id == "W-CLEAN");
    CHECK(run.record.warnings[0].message.find("orient") != std::string::npos);
}

TEST_CASE("clean takes lengths in the world", "[stages]") {
    Mesh mesh = shapes::cube();
    const auto stray = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back(mesh.positions[mesh.corners[0]] + Vec3{0.01, 0, 0});
    mesh.corners[0] = stray;
    Scene scene = scene_of(mesh, Unit::mm);
    for (int i = 0; i < 3; ++i) scene.parts[0].transform.m[i][i] = 10; // the gap is 0.1 mm in the world
    const auto closed = [&](const std::string& within) {
        return inspect(run_stage("clean", "{stitch: near, tolerance: " + within + "}", scene).scene).closed;
    };
    CHECK_FALSE(closed("0.05mm"));
    CHECK(closed("0.2mm"));
}

TEST_CASE("clean refuses options that make no sense together", "[stages]") {
    const auto refusal = [](const std::string& options) {
        return failure([&] { run_stage("clean", options, scene_of(shapes::cube())); });
    };
    CHECK(refusal("{weld: near}") ==
          "usage [E-MISSING] test.yaml:1:1: clean: near needs a tolerance | give it: tolerance: 0.01%");
    CHECK(
        refusal("{tolerance: 1}") ==
        "usage [E-CONFLICT] test.yaml:1:13: clean: 'tolerance' has no effect, because no step is set to near "
        "| weld: near, stitch: near or t_junctions: near");
    CHECK(refusal("{components: {}}") ==
          "usage [E-MISSING] test.yaml:1:1: clean: components needs a limit for small components | "
          "components: {min_faces: 100}, {min_size: 1%}, {min_area: 1%} or {keep: 1}");
}

TEST_CASE("clean resolves the intersections that rounding to single makes", "[stages]") {
    Mesh ball = shapes::icosphere(3), inner = shapes::icosphere(3);
    for (Vec3& p : inner.positions) p = p * (1 - 3e-7);
    for (std::size_t c = 0; c < inner.corners.size(); c += 3)
        std::swap(inner.corners[c], inner.corners[c + 1]);
    append(ball, inner);
    for (Vec3& p : ball.positions) p = p * 10.0 + Vec3{100.123, 200.4567, 50.7891};
    REQUIRE(find_self_intersections(ball).count == 0);
    const auto run = run_stage("clean", "{precision: single}", scene_of(ball));
    CHECK(find_self_intersections(run.mesh()).count == 0);
    Mesh crossing = shapes::cube(); // intersects already: what rounding adds is reported
    for (Vec3& p : crossing.positions) p = p * 30.0 + Vec3{90, 195, 45};
    append(ball, crossing);
    const auto other = run_stage("clean", "{precision: single}", scene_of(ball));
    const auto before = find_self_intersections(ball).count,
               after = find_self_intersections(other.mesh()).count;
    if (after > before) CHECK(other.warnings() == std::vector<std::string>{"W-CLEAN"});
}

TEST_CASE("clean: small components and hidden faces are removed, with their area", "[stages]") {
    Mesh mesh = shapes::icosphere(2);
    Mesh cube = shapes::cube();
    for (Vec3& p : cube.positions) p = p * 0.1;
    append(mesh, cube);
    const auto small = run_stage("clean", "{components: {min_size: 0.5}}", scene_of(mesh));
    const auto& part = small.record.result["parts"][0];
    CHECK(part["removed_components"] == 1);
    CHECK(part["component_faces"] == 12);
    CHECK(part["component_area"].get<double>() == Approx(0.06));
    const auto seen = run_stage("clean", options({{"hidden", "true"}}), scene_of(mesh));
    CHECK(seen.mesh().face_count() == 320);
    CHECK(seen.record.result["parts"][0]["hidden_area"].get<double>() == Approx(0.06));
    CHECK(seen.record.result["parts"][0]["outer_rays"] > 100000);
    CHECK(problems_of("clean", options({{"gap", "1"}})).substr(0, 11) == "E-CONFLICT ");
}
