#include "base/math/portable_math.hpp"
#include "geometry/globe/globe.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;
using test::failure;
using test::run_stage;
using test::scene_of;

namespace {

Box box_after(const std::string& options, Scene scene = scene_of(shapes::cube())) {
    return run_stage("transform", options, std::move(scene)).scene.bounds();
}

void check_box(const Box& box, const Vec3& min, const Vec3& max) {
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(box.min[i] == Approx(min[i]).margin(1e-12));
        CHECK(box.max[i] == Approx(max[i]).margin(1e-12));
    }
}

} // namespace

TEST_CASE("transform moves, scales and turns", "[stages]") {
    check_box(box_after("{translate: [1, 2, 3]}"), {1, 2, 3}, {2, 3, 4});
    check_box(box_after("{scale: 2}"), {0, 0, 0}, {2, 2, 2});
    check_box(box_after("{scale: [1, 2, -3]}"), {0, 0, -3}, {1, 2, 0});
    check_box(box_after("{rotate: 90deg}"), {-1, 0, 0}, {0, 1, 1});
    check_box(box_after("{rotate: {axis: [1, 0, 0], angle: 90}, pivot: centre}"), {0, 0, 0}, {1, 1, 1});
    check_box(box_after("{matrix: [0, 0, 1, 5, 1, 0, 0, 0, 0, 1, 0, 0]}"), {5, 0, 0}, {6, 1, 1});
    check_box(box_after("{scale: 2, centre: true}"), {-1, -1, -1}, {1, 1, 1});
    check_box(box_after("{translate: [0, 0, -7], ground: true}"), {0, 0, 0}, {1, 1, 1});
}

TEST_CASE("transform scales parts to fit", "[stages]") {
    const auto block = [] { // 1 x 2 x 4 from (2, 0, 0) on
        Mesh mesh = shapes::cube();
        for (Vec3& p : mesh.positions) p = {p.x + 2, p.y * 2, p.z * 4};
        return scene_of(std::move(mesh), Unit::mm);
    };
    check_box(box_after("{fit: 120}", block()), {60, 0, 0}, {90, 60, 120});
    check_box(box_after("{fit: 12cm}", block()), {60, 0, 0}, {90, 60, 120});
    check_box(box_after("{fit: 8, pivot: centre}", block()), {1.5, -1, -2}, {3.5, 3, 6});
    check_box(box_after("{fit: [10, 1, 10], ground: true}", block()), {1, 0, 0}, {1.5, 1, 2});
    // A percentage refers to the current side, the longest or each, and not to the diagonal.
    check_box(box_after("{fit: 50%}", block()), {1, 0, 0}, {1.5, 1, 2});
    check_box(box_after("{fit: [200%, 300%, 150%]}", block()), {3, 0, 0}, {4.5, 3, 6});
    check_box(box_after("{scale: 3, fit: 50%}", block()), {3, 0, 0}, {4.5, 3, 6});
    const auto halved = run_stage("transform", "{fit: 50%}", block());
    CHECK(halved.record.resolved.at(0).given == "50%");
    CHECK(halved.record.resolved.at(0).is == 2);
    CHECK(failure([&] {
              run_stage("transform", "{fit: 50% of load}", block());
          }).starts_with("stage [E-TRANSFORM]")); // without loaded parts no diagonal exists
    // fit applies to the result of the other moves. A flat part has a single dimension that fits in any
    // case.
    check_box(box_after("{scale: [8, 1, 1], rotate: {axis: [0, 1, 0], angle: 90}, fit: 2}", block()),
              {0, 0, -6}, {1, 0.5, -4});
    CHECK(run_stage("transform", "{fit: 6}", scene_of(shapes::grid(2, 3))).record.result["fit_factor"] == 2);
    CHECK(failure([&] { run_stage("transform", "{fit: [1, 2]}", block()); }) ==
          "usage [E-TRANSFORM] test.yaml:1:7: transform: fit needs one length or three, found 2");
    CHECK(failure([&] { run_stage("transform", "{fit: -1mm}", block()); }) ==
          "usage [E-TRANSFORM] test.yaml:1:7: transform: the lengths of fit must be above 0, found -1mm | "
          "write, for example, fit: 200mm");
    Mesh point;
    point.positions = {{1, 2, 3}};
    CHECK(failure([&] {
              run_stage("transform", "{fit: 1}", scene_of(point));
          }).starts_with("stage [E-TRANSFORM] transform: fit cannot scale the parts"));
}

TEST_CASE("transform converts units and the up axis, and sizes stay", "[stages]") {
    Scene scene = scene_of(shapes::cube(), Unit::mm);
    scene.up = UpAxis::z;
    const auto run = run_stage("transform", "{unit: m, up: y, translate: [1mm, 0, 0]}", scene);
    CHECK(run.scene.unit == Unit::m);
    CHECK(run.scene.up == UpAxis::y);
    check_box(run.scene.bounds(), {0.001, 0, -0.001}, {0.002, 0.001, 0});
    CHECK(run_stage("transform", "{unit: mm}", scene_of(shapes::cube())).record.warnings.at(0).id ==
          "W-UNITS");
    const auto guessed = run_stage("transform", "{up: y}", scene_of(shapes::cube()));
    CHECK(guessed.record.warnings.at(0).id == "W-UP");
    CHECK(guessed.scene.up == UpAxis::y);
    check_box(guessed.scene.bounds(), {0, 0, 0}, {1, 1, 1});
}

TEST_CASE("transform bakes no part that an animation moves", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    Document document;
    document.json = R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[]}],
        "nodes":[{"children":[1]},{"mesh":0},{"mesh":0}],
        "animations":[{"samplers":[{}],"channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}}]}]})";
    scene.documents.push_back(std::make_shared<Document>(document));
    for (int i = 0; i < 2; ++i) {
        scene.parts[i].document = 0;
        scene.parts[i].node = 1 + i;
    }
    const auto run = run_stage("transform", "{translate: [1, 2, 3], bake: true}", scene);
    CHECK(run.scene.parts[0].transform.m[1][3] == 2);
    CHECK(run.scene.parts[1].transform.identity());
    CHECK(run.scene.parts[1].mesh.bounds().min == Vec3{1, 2, 3});
    REQUIRE(run.record.warnings.size() == 1);
    CHECK(run.record.warnings[0].id == "W-TRANSFORM");
}

TEST_CASE("transform keeps skins, by units and axes too", "[stages]") {
    Scene scene = scene_of(shapes::cube(), Unit::m);
    scene.up = UpAxis::y;
    scene.parts[0].skinned = true;
    for (const char* options : {"{scale: 2}", "{unit: mm}", "{up: z}"}) {
        const auto run = run_stage("transform", options, scene);
        CHECK(run.scene.parts[0].skinned);
        CHECK_FALSE(run.scene.parts[0].transform.identity());
        CHECK(run.record.warnings.empty());
    }
}

TEST_CASE("transform moves nodes, and meshes when it bakes", "[stages]") {
    auto run = run_stage("transform", "{scale: [-1, 1, 1]}", scene_of(shapes::cube()));
    CHECK(run.scene.parts[0].mesh.positions == shapes::cube().positions);
    CHECK(inspect(run.scene).volume.value() == Approx(1));
    run = run_stage("transform", "{scale: [-1, 1, 1], bake: true}", scene_of(shapes::cube()));
    CHECK(run.scene.parts[0].transform.identity());
    CHECK(inspect(run.scene).volume.value() == Approx(1));
    CHECK(run.record.result["matrix"][0][0] == -1);
}

TEST_CASE("transform refuses what would flatten the parts", "[stages]") {
    const auto refusal = [](const std::string& options) {
        return failure([&] { run_stage("transform", options, scene_of(shapes::cube())); });
    };
    CHECK(refusal("{scale: 0}") ==
          "usage [E-TRANSFORM] test.yaml:1:9: transform: a factor of 0 would flatten the parts");
    CHECK(refusal("{scale: [1, 2]}") ==
          "usage [E-TRANSFORM] test.yaml:1:9: transform: scale needs one factor or three, found 2");
    CHECK(refusal("{matrix: [1, 2]}") ==
          "usage [E-TRANSFORM] test.yaml:1:10: transform: matrix needs 12 or 16 numbers, found 2");
    CHECK(refusal("{rotate: {axis: [0, 0, 0], angle: 3}}") ==
          "usage [E-TRANSFORM] test.yaml:1:10: transform: the axis of the rotation has zero length");
    CHECK(refusal("{translate: [1, 2]}") ==
          "usage [E-TRANSFORM] test.yaml:1:13: transform: translate needs three lengths, found 2");
}

TEST_CASE("transform names options without effect", "[stages]") {
    CHECK(failure([] {
              run_stage("transform", "{pivot: centre}", scene_of(shapes::cube()));
          }).find("1:9: transform: 'pivot' needs scale, rotate, orient_for or fit") != std::string::npos);
}

TEST_CASE("place puts the origin of a scene on the globe", "[stages]") {
    Scene scene = scene_of(shapes::cube(), Unit::mm);
    scene.up = UpAxis::y;
    const auto run =
        run_stage("transform", "{place: {lat: 48.8584, lon: 2.2945, height: 330m, heading: 90}}", scene);
    const Part& part = run.scene.parts[0];
    CHECK(run.scene.unit == Unit::m);
    CHECK(length(part.transform.point({}) - Vec3{4201152.758655, 168331.794517, 4780461.560653}) < 1e-4);
    // The y axis of the file is up: 10 m higher.
    CHECK(length(part.transform.point({0, 10000, 0}) -
                 geocentric({48.8584 * pi / 180, 2.2945 * pi / 180, 340})) < 1e-4);
    CHECK(run.record.result["globe"]["lat"].get<double>() == Approx(48.8584));
    CHECK(run.record.result["unit"] == "m");
    CHECK(run.warnings().empty());
}

TEST_CASE("crs converts every vertex to geocentric coordinates", "[stages]") {
    Scene scene = scene_of(shapes::grid(4, 4));
    for (Vec3& p : scene.parts[0].mesh.positions) p = {500608 + 1000 * p.x, 5200512 + 1000 * p.y, 384};
    const auto run = run_stage("transform", "{crs: \"EPSG:32632\", geoid: 47}", scene);
    const auto system = ProjectedSystem::named("EPSG:32632");
    REQUIRE(system);
    const auto& positions = run.mesh().positions;
    for (std::size_t v = 0; v < positions.size(); ++v)
        CHECK(length(positions[v] - system->geocentric(scene.parts[0].mesh.positions[v] + Vec3{0, 0, 47})) <
              1e-6);
    CHECK(run.record.result["globe"]["height"].get<double>() == Approx(384 + 47));
    CHECK(run.warnings().empty());
    const auto refused = [&](const char* options) { return test::refusal_of("transform", options, scene); };
    CHECK(
        refused("{crs: \"EPSG:31467\"}").starts_with("usage [E-CRS] transform: 'EPSG:31467' is not a known"));
    CHECK(refused("{crs: \"EPSG:32632\", place: {lat: 1, lon: 2}}").find("cannot be combined") !=
          std::string::npos);
    CHECK(refused("{geoid: 47}").find("needs crs") != std::string::npos);
    CHECK(test::refusal_of("transform", "{crs: \"EPSG:32632\"}", scene_of(shapes::grid(4, 4)))
              .find("seems to be in degrees") != std::string::npos);
}
