#include "support/catch.hpp"
#include "support/failure.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"
#include "support/meshes.hpp"
#include "support/run_stage.hpp"

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

TEST_CASE("merge leaves no joints without a skin, thicken no skin without joints", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts[0].skinned = true;
    scene.parts[0].mesh.attributes = {
        {"JOINTS_0", Domain::wedge, Role::joints, 4, false, std::vector<std::uint8_t>(32, 0)},
        {"WEIGHTS_0", Domain::wedge, Role::weights, 4, false, std::vector<float>(32, 0.25F)}};
    const auto merged = run_stage("merge", "", scene);
    CHECK_FALSE(merged.scene.parts[0].skinned);
    CHECK(merged.warnings() == std::vector<std::string>{"W-SKIN"});
    CHECK(merged.scene.parts[0].mesh.find("JOINTS_0", Domain::wedge) == nullptr);
    CHECK(merged.scene.parts[0].mesh.find("WEIGHTS_0", Domain::wedge) == nullptr);
    const auto wires = run_stage("thicken", "{thickness: 0.1, mode: edges}", scene);
    CHECK_FALSE(wires.scene.parts[0].skinned);
    CHECK(wires.scene.bounds().max.x < 2);
    CHECK(wires.record.warnings.at(0).id == "W-SKIN");
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
          "usage [E-TRANSFORM] test.yaml:1:9: transform: scale takes one factor or three, found 2");
    CHECK(refusal("{matrix: [1, 2]}") ==
          "usage [E-TRANSFORM] test.yaml:1:10: transform: matrix takes 12 or 16 numbers, found 2");
    CHECK(refusal("{rotate: {axis: [0, 0, 0], angle: 3}}") ==
          "usage [E-TRANSFORM] test.yaml:1:10: transform: the axis of a rotation has no length");
    CHECK(refusal("{translate: [1, 2]}") ==
          "usage [E-TRANSFORM] test.yaml:1:13: transform: translate takes three lengths, found 2");
}

TEST_CASE("separate leaves cavities in their solids, unless it is told to", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    const auto hollow = run_stage("thicken", "{thickness: 0.1}", scene).scene;
    CHECK(run_stage("separate", "", hollow).scene.parts.size() == 1);
    const auto apart = run_stage("separate", "{cavities: true}", hollow).scene;
    REQUIRE(apart.parts.size() == 2);
    CHECK(*inspect(apart.parts[1].mesh).volume < 0);
}

TEST_CASE("options without effect are named", "[stages]") {
    CHECK(failure([] {
              run_stage("transform", "{pivot: centre}", scene_of(shapes::cube()));
          }).find("pivot goes with scale or rotate") != std::string::npos);
    CHECK(failure([] {
              run_stage("separate", "{attribute: patch}", scene_of(shapes::cube()));
          }).find("'attribute' goes with by: group") != std::string::npos);
}

TEST_CASE("merge gives no part the name of another", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    for (const char* name : {"arm", "leg"}) {
        scene.parts.push_back(scene.parts[0]);
        scene.parts.back().name = name;
    }
    const StageInfo& merge = test::stage_for_test("merge");
    Problems problems;
    const auto options = test::options_of(merge, Value::scalar("leg"), problems);
    test::StageRun run;
    const PartFilter some{{"part", "arm"}};
    Context context(*run.state, run.record, some, scene.bounds(), {});
    const Scene merged = merge.run(std::move(scene), options.get(), context);
    REQUIRE(merged.parts.size() == 2);
    CHECK(merged.parts[0].name == "leg_2");
}

TEST_CASE("all pieces of a skinned part keep its skin", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    append(scene.parts[0].mesh, shapes::cube());
    scene.parts[0].skinned = true;
    scene.parts[0].document = 0;
    scene.parts[0].node = 3;
    const auto run = run_stage("separate", "", scene);
    REQUIRE(run.scene.parts.size() == 2);
    for (const Part& part : run.scene.parts) CHECK((part.skinned && part.document == 0 && part.node == 3));
}

TEST_CASE("merge joins parts in the world, separate takes them apart again", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "other";
    scene.parts[1].transform.m[0][3] = 5;
    auto run = run_stage("merge", "{name: both}", scene);
    REQUIRE(run.scene.parts.size() == 1);
    CHECK(run.scene.parts[0].name == "both");
    CHECK(run.scene.parts[0].mesh.face_count() == 24);
    check_box(run.scene.bounds(), {0, 0, 0}, {6, 1, 1});
    for (const std::string by : {"group", "component"}) {
        const auto apart = run_stage("separate", by, run.scene);
        REQUIRE(apart.scene.parts.size() == 2);
        CHECK(apart.scene.parts[1].name == "both.1");
        CHECK(apart.scene.parts[0].mesh.vertex_count() == 8);
        check_box(apart.scene.parts[1].mesh.bounds(), {5, 0, 0}, {6, 1, 1});
        CHECK(inspect(apart.scene).closed);
    }
}

TEST_CASE("merge welds what touches", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].transform.m[0][3] = 1;
    const auto run = run_stage("merge", "{weld: true}", scene);
    CHECK(run.record.result["welded_vertices"] == 4);
    CHECK(run.scene.parts[0].mesh.vertex_count() == 12);
}

TEST_CASE("separate parts by material, and keeps a part of one piece as it is", "[stages]") {
    Scene scene = scene_of(shapes::quad_cube());
    scene.materials = {{.name = "red"}, {.name = "blue"}};
    Mesh& mesh = scene.parts[0].mesh;
    mesh.primitives = {{.material = 0, .attributes = {}, .json = {}},
                       {.material = 1, .attributes = {}, .json = {}}};
    mesh.attributes = {{std::string(primitive_attribute), Domain::face, Role::index, 1, false,
                        std::vector<std::uint32_t>{0, 1, 0, 0, 1, 0}}};
    const auto run = run_stage("separate", "material", scene);
    REQUIRE(run.scene.parts.size() == 2);
    CHECK(run.scene.parts[0].name == "part.red");
    CHECK(run.scene.parts[1].name == "part.blue");
    CHECK(run.scene.parts[1].mesh.face_count() == 2);
    CHECK(run_stage("separate", "", scene_of(shapes::cube())).scene.parts[0].name == "part");
}

TEST_CASE("separate refuses a group that is not there, and too many parts", "[stages]") {
    CHECK(failure([] { run_stage("separate", "group", scene_of(shapes::cube())); }) ==
          "stage [E-GROUP] separate: part 'part' has no face attribute 'group' | merge creates 'group'; "
          "facetmill info lists the attributes");
    for (const double value : {0.5, HUGE_VAL - HUGE_VAL, HUGE_VAL, 1e300}) {
        Scene scene = scene_of(shapes::tetrahedron());
        scene.parts[0].mesh.attributes.push_back(
            {"group", Domain::face, Role::generic, 1, false, std::vector<double>{1, 2, value, -3}});
        CHECK(failure([&] { run_stage("separate", "group", scene); })
                  .starts_with(
                      "stage [E-GROUP] separate: 'group' of part 'part' does not number groups: it is "));
        scene.parts[0].mesh.attributes[0].set_value(2, 0, 1);
        CHECK(run_stage("separate", "group", scene).scene.parts.size() == 3);
    }
    Mesh soup;
    for (Index i = 0; i < 9; ++i) {
        soup.positions.push_back({double(i), double(i * i), 0});
        soup.corners.push_back(i);
    }
    CHECK(failure([&] { run_stage("separate", "{max_parts: 2}", scene_of(soup)); }) ==
          "stage [E-PARTS] separate: there would be 3 parts or more, and max_parts is 2 | remove small "
          "components "
          "first (clean: "
          "{components: {min_faces: 10}}), or raise max_parts");
}

TEST_CASE("two-sided marks materials", "[stages]") {
    const auto run = run_stage("two-sided", "material", scene_of(shapes::grid(1, 1)));
    REQUIRE(run.scene.materials.size() == 1);
    CHECK(run.scene.materials[0].double_sided);
    CHECK(run.scene.parts[0].mesh.primitives[0].material == 0);
    CHECK(run.scene.parts[0].mesh.face_count() == 2);
    CHECK(run_stage("two-sided", "", scene_of(shapes::grid(1, 1))).scene.parts[0].mesh.face_count() == 4);
}

TEST_CASE("thicken takes its thickness in the world, and reports it as measured", "[stages]") {
    Scene scene = scene_of(shapes::grid(2, 2));
    for (int i = 0; i < 3; ++i) scene.parts[0].transform.m[i][i] = 10;
    const auto run = run_stage("thicken", "1", scene);
    CHECK(inspect(run.scene).volume.value() == Approx(400));
    CHECK(run.record.result["parts"][0]["wall_thickness"]["min"].get<double>() == Approx(1));
    CHECK(run.record.result["parts"][0]["self_intersections"] == 0);
    const auto thick = run_stage("thicken", "0.5", scene_of(test::noisy_icosphere(2, 0.3, 1)));
    REQUIRE(thick.record.warnings.size() > 0);
    CHECK(thick.record.warnings.back().id == "W-THICKEN");
    CHECK(run_stage("thicken", "{thickness: 0.1, mode: edges}", scene_of(shapes::cube()))
              .record.result["parts"][0]["cylinders"] == 18);
}

TEST_CASE("orient warns of what it could not do", "[stages]") {
    const auto run = run_stage("orient", "", scene_of(shapes::moebius(9)));
    REQUIRE(run.record.warnings.size() == 1);
    CHECK(run.record.warnings[0].id == "W-ORIENT");
    CHECK(run.record.result["parts"][0]["non_orientable_components"] == 1);
    CHECK(run_stage("orient", "", scene_of(shapes::grid(2, 2))).record.warnings.at(0).id == "W-ORIENT-OPEN");
    CHECK(run_stage("orient", "flip", scene_of(shapes::cube())).record.result["parts"][0]["flipped_faces"] ==
          12);
}
