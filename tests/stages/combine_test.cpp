#include "support/catch.hpp"

#include "geometry/cut/cap_paint.hpp"
#include "parallel/memory.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"
#include "support/run_stage.hpp"

#include <set>

using namespace facetmill;
using test::run_stage;
using test::scene_of;

namespace {

/// A cube, and others of half its side: in a corner of it, and away from it.
Scene cube_and_drills() {
    Scene scene = scene_of(shapes::cube());
    scene.parts[0].name = "block";
    for (const char* name : {"drill", "far drill"}) {
        Part part = scene.parts[0];
        part.name = name;
        for (int i = 0; i < 3; ++i) part.transform.m[i][i] = 0.5;
        part.transform.m[0][3] = scene.parts.size() == 1 ? -0.25 : 3;
        scene.parts.push_back(part);
    }
    return scene;
}

double volume_of(const Part& part) {
    Mesh mesh = part.mesh;
    apply(mesh, part.transform);
    return test::volume(mesh);
}

} // namespace

TEST_CASE("combine takes parts away, and removes them from the scene", "[stages]") {
    Scene scene = cube_and_drills();
    const auto run = run_stage("combine", "{operation: difference, with: \"*drill\"}", scene);
    REQUIRE(run.scene.parts.size() == 1);
    CHECK(run.scene.parts[0].name == "block");
    CHECK(volume_of(run.scene.parts[0]) == Approx(1 - 0.0625));
    CHECK(run.record.result["parts"][0]["with"] == Json::array({"drill", "far drill"}));
    const Attribute* cut = run.mesh().find("cut_id", Domain::face);
    REQUIRE(cut);
    std::size_t numbered = 0;
    for (Index f = 0; f < run.mesh().face_count(); ++f) {
        CHECK(cut->value(f, 0) <= 1); // the far part contributes no face
        numbered += cut->value(f, 0) == 1;
    }
    CHECK(numbered == run.record.result["parts"][0]["faces_of_with"]);
    CHECK(numbered >= 6);
    REQUIRE(run.warnings() == std::vector<std::string>{"W-COMBINE-IDLE"});
    CHECK(run.record.warnings[0].message == "combine: 'far drill' subtracts nothing");
    // New numbers continue after existing numbers.
    Scene again = cube_and_drills();
    again.parts[0].mesh = run.mesh();
    again.parts[1].transform.m[0][3] = 0.75;
    const auto twice = run_stage("combine", "{operation: difference, with: drill}", again);
    CHECK(twice.scene.parts.size() == 2);
    const Attribute* both = twice.mesh().find("cut_id", Domain::face);
    std::set<double> numbers;
    for (Index f = 0; f < twice.mesh().face_count(); ++f) numbers.insert(both->value(f, 0));
    CHECK(numbers == std::set<double>{0, 1, 2});
}

TEST_CASE("combine takes groups of its tools for those of caps alone", "[stages]") {
    Scene scene = cube_and_drills();
    const auto numbered = [](Mesh& mesh, const char* name, auto&& number) {
        std::vector<std::uint32_t> numbers(mesh.face_count());
        for (Index f = 0; f < numbers.size(); ++f) numbers[f] = number(f);
        mesh.attributes.push_back({name, Domain::face, Role::index, 1, false, AttributeData(numbers)});
    };
    const auto change_of_group = [](const test::StageRun& run) {
        for (const auto& entry : run.record.attribute_changes)
            if (entry.change.attribute == "group") return entry.change.kind;
        return AttributeChange::Kind::kept;
    };
    Mesh& drill = scene.parts[1].mesh;
    numbered(drill, "group", [](Index f) { return 7 + f; });
    const auto without = run_stage("combine", "{operation: difference, with: \"*drill\"}", scene);
    CHECK_FALSE(without.mesh().find("group", Domain::face));
    CHECK(later_caps(without.mesh(), 0).empty());
    CHECK(change_of_group(without) == AttributeChange::Kind::dropped);
    // The block keeps its own faces, and the drill contributes only faces that close a cut.
    numbered(scene.parts[0].mesh, "group", [](Index) { return 3U; });
    numbered(drill, "cut_id", [](Index f) { return f < 2 ? 5U : 0U; });
    const auto run = run_stage("combine", "{operation: intersection, with: \"*drill\"}", scene);
    const Mesh& mesh = run.mesh();
    const Attribute *group = mesh.find("group", Domain::face), *cut = mesh.find("cut_id", Domain::face);
    REQUIRE(group);
    REQUIRE(cut);
    std::set<double> of_block, of_drill;
    for (Index f = 0; f < mesh.face_count(); ++f)
        (cut->value(f, 0) > 0 ? of_drill : of_block).insert(group->value(f, 0));
    CHECK(of_block == std::set<double>{3});
    CHECK(of_drill.contains(0));
    for (const double number : of_drill) CHECK((number == 0 || number == 7 || number == 8));
    CHECK(change_of_group(run) == AttributeChange::Kind::recomputed);
}

TEST_CASE("combine works on each part in its own space", "[stages]") {
    Scene scene = cube_and_drills();
    scene.parts.insert(scene.parts.begin() + 1, scene.parts[0]);
    scene.parts[1].name = "mirrored";
    scene.parts[1].transform.m[0][0] = -2; // from 2.75 down to 0.75
    scene.parts[1].transform.m[0][3] = 2.75;
    const auto run = run_stage("combine", "{operation: intersection, with: [\"*drill\"], keep: true}", scene);
    REQUIRE(run.scene.parts.size() == 4);
    CHECK(volume_of(run.scene.parts[0]) == Approx(0.0625));
    CHECK(run.scene.parts[1].mesh.face_count() == 0);
    CHECK(run.warnings() == std::vector<std::string>{"W-COMBINE-NOTHING"});
    scene.parts[3].transform.m[0][3] = 2.5;
    const auto mirrored = run_stage("combine", "{operation: intersection, with: far drill}", scene);
    CHECK(volume_of(mirrored.scene.parts[1]) == Approx(0.0625));
    CHECK(mirrored.scene.parts[1].transform == scene.parts[1].transform);
}

TEST_CASE("combine makes one part of all, numbered in group, with the materials of each", "[stages]") {
    Scene scene = cube_and_drills();
    scene.materials = {{.name = "red"}, {.name = "blue"}};
    scene.parts[0].mesh.primitives = {{0, {}, {}}};
    scene.parts[1].mesh.primitives = {{1, {}, {}}};
    const auto run = run_stage("combine", "union", scene);
    REQUIRE(run.scene.parts.size() == 1);
    CHECK(volume_of(run.scene.parts[0]) == Approx(1 + 0.0625 + 0.125));
    const Attribute* group = run.mesh().find("group", Domain::face);
    REQUIRE(group);
    for (Index f = 0; f < run.mesh().face_count(); ++f) {
        const Index material = run.mesh().primitives[run.mesh().primitive_of(f)].material;
        CHECK(material == (group->value(f, 0) == 0 ? 0 : group->value(f, 0) == 1 ? 1 : none));
    }
    const auto apart = run_stage("separate", "group", run.scene);
    CHECK(apart.scene.parts.size() == 3);
}

TEST_CASE("combine refuses what cannot be combined, by name", "[stages]") {
    const auto failure = [](const char* options, const Scene& scene) {
        return test::failure([&] { run_stage("combine", options, scene); });
    };
    const auto says = [](const std::string& text, const std::string& what) {
        return text.find(what) != std::string::npos;
    };
    Scene scene = cube_and_drills();
    CHECK(says(failure("difference", scene), "E-MISSING"));
    CHECK(says(failure("{operation: difference, with: dril}", scene), "E-PART"));
    CHECK(says(failure("{operation: difference, with: [drill, saw]}", scene), "saw"));
    CHECK(says(failure("{operation: difference, with: \"*\"}", scene), "E-PART"));
    Scene open = scene;
    open.parts[1].mesh = shapes::grid(2, 2);
    CHECK(says(failure("{operation: difference, with: drill}", open),
               "part 'drill' is not a solid: it is open"));
    Scene empty = scene;
    empty.parts[1].mesh = {};
    CHECK(says(failure("{operation: difference, with: drill}", empty), "part 'drill' has no faces"));
    Scene flat = scene;
    flat.parts[0].transform.m[2][2] = 0;
    CHECK(says(failure("{operation: difference, with: drill}", flat), "part 'block' is flattened"));
}

TEST_CASE("a part of 'with' that takes a whole component away is not idle", "[stages]") {
    Scene scene = cube_and_drills();
    scene.parts.resize(2);
    Mesh small = scene.parts[0].mesh;
    for (Vec3& p : small.positions) p = p * 0.5 + Vec3{5, 0, 0};
    append(scene.parts[0].mesh, small);
    scene.parts[1].transform = {};
    scene.parts[1].transform.m[0][3] = 4.75;
    scene.parts[1].transform.m[1][3] = scene.parts[1].transform.m[2][3] = -0.25;
    const auto run = run_stage("combine", "{operation: difference, with: drill}", scene);
    CHECK(run.mesh().face_count() == 12);
    CHECK(run.warnings().empty());
}

TEST_CASE("combine ends with E-MEMORY, the place and a way out, where the run may take no more", "[stages]") {
    set_memory_limit(1);
    const std::string text = test::failure(
        [] { run_stage("combine", "{operation: difference, with: drill}", cube_and_drills()); });
    set_memory_limit(0);
    INFO(text);
    for (const char* part :
         {"E-MEMORY", "part 'block' cannot be combined: there is not enough memory to combine 24 faces (near",
          "--memory"})
        CHECK(text.find(part) != std::string::npos);
}
