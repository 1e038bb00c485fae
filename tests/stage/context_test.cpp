#include "support/catch.hpp"

#include "options/types.hpp"
#include "stage/context.hpp"

using namespace facetmill;

namespace {

/// Two parts: a "body" of material "steel", a unit cube's corners wide, and a "wheel_left" twice as large.
Scene two_parts() {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].name = "steel";
    scene.materials[1].name = "rubber";
    for (int i = 0; i < 2; ++i) {
        Part part;
        part.name = i == 0 ? "body" : "wheel_left";
        part.mesh.positions = {{0, 0, 0}, {1, 1, 1}, {1, 0, 0}};
        part.mesh.corners = {0, 1, 2};
        part.mesh.primitives = {{static_cast<Index>(i), {}, {}}};
        if (i == 1)
            for (int axis = 0; axis < 3; ++axis) part.transform.m[axis][axis] = 2;
        scene.parts.push_back(std::move(part));
    }
    return scene;
}

std::vector<std::string> selected(std::vector<std::string> patterns) {
    const Scene scene = two_parts();
    const PartFilter filter{std::move(patterns)};
    std::vector<std::string> names;
    for (const auto& part : scene.parts)
        if (filter.selects(part, scene)) names.push_back(part.name);
    return names;
}

Length length_of(const std::string& text) {
    Length length;
    Problems problems;
    REQUIRE(OptionType<Length>::parse(Value::scalar(text), length, problems));
    return length;
}

using Names = std::vector<std::string>;

} // namespace

TEST_CASE("only selects parts by name, by material and by exclusion", "[stage]") {
    CHECK(selected({}) == Names{"body", "wheel_left"});
    CHECK(selected({"body"}) == Names{"body"});
    CHECK(selected({"wheel*"}) == Names{"wheel_left"});
    CHECK(selected({"rubber"}) == Names{"wheel_left"});
    CHECK(selected({"!wheel*"}) == Names{"body"});
    CHECK(selected({"*", "!steel"}) == Names{"wheel_left"});
    CHECK(selected({"engine"}).empty());
}

TEST_CASE("only selects by the materials of faces, lines and points, not of what is cut off", "[stage]") {
    Scene scene = two_parts();
    Mesh& mesh = scene.parts[0].mesh;
    mesh.primitives.push_back(
        {.material = 1, .attributes = {}, .json = {}}); // clip can leave such a primitive
    const auto rubber = [&] { return PartFilter{{"rubber"}}.selects(scene.parts[0], scene); };
    CHECK_FALSE(rubber());
    mesh.attributes = {{std::string(primitive_attribute), Domain::face, Role::index, 1, false,
                        std::vector<std::uint32_t>{1}}};
    CHECK(rubber());
    mesh.attributes.clear();
    mesh.corners.clear();
    CHECK(rubber()); // points have all
    mesh.lines = {0, 1};
    CHECK_FALSE(rubber());
    mesh.line_primitive = {1};
    CHECK(rubber());
}

TEST_CASE("places: inputs beside the pipeline, outputs in the output directory", "[stage]") {
    const Folders places{"pipelines", "build/out"};
    CHECK(places.input("scan.ply") == "pipelines/scan.ply");
    CHECK(places.input("../scan.ply") == "scan.ply");
    CHECK(places.input("/data/scan.ply") == "/data/scan.ply");
    CHECK(places.input("-") == "-");
    CHECK(places.output("a/b.glb") == "build/out/a/b.glb");
    CHECK(places.output("-") == "-");
}

namespace {

struct StageInScene {
    RunState run;
    report::StageRecord record;
    PartFilter only;
    Context context{run, record, only, Box{{0, 0, 0}, {3, 4, 0}}, {}};
};

} // namespace

TEST_CASE("lengths are resolved and recorded", "[stage]") {
    StageInScene stage;
    Scene scene = two_parts();
    scene.unit = Unit::mm;
    stage.run.load_diagonal = 50;
    const auto resolve = [&](const std::string& text, const Part* part = nullptr) {
        return stage.context.resolve(length_of(text), scene, "amplitude", part);
    };
    CHECK(resolve("2") == 2);
    CHECK(resolve("2cm") == Approx(20));
    CHECK(resolve("10%") == Approx(0.5));
    CHECK(resolve("10% of load") == Approx(5));
    REQUIRE(stage.record.resolved.size() == 1); // the last of that option
    CHECK(stage.record.resolved[0].option == "amplitude");
    CHECK(stage.record.resolved[0].given == "10% of load");
    CHECK(stage.record.resolved[0].is == Approx(5));
    CHECK(resolve("10% of part", &scene.parts[1]) == Approx(std::sqrt(12.0) / 10));
    CHECK(stage.record.resolved.at(1).option == "amplitude (wheel_left)");
}

TEST_CASE("a physical length needs a scene with a unit", "[stage]") {
    StageInScene stage;
    const Scene scene = two_parts();
    try {
        stage.context.resolve(length_of("2mm"), scene, "amplitude");
        FAIL("no error");
    } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::usage);
        CHECK(render(e.diagnostics().at(0)) ==
              "facetmill: error[E-UNIT]: 'amplitude' is 2mm, but the scene has no unit\n  hint: give the "
              "unit of the file (load: {unit: mm}), or use a bare number or a percentage");
    }
}

TEST_CASE("the parts worked on are the selected ones, and are marked changed", "[stage]") {
    StageInScene stage;
    stage.only.patterns = {"body"};
    Scene scene = two_parts();
    Names visited;
    stage.context.for_each_part(scene, [&](Part& part) { visited.push_back(part.name); });
    CHECK(visited == Names{"body"});
    CHECK(scene.parts[0].changed);
    CHECK_FALSE(scene.parts[1].changed);
}

TEST_CASE("what a stage says goes into its record", "[stage]") {
    StageInScene stage;
    stage.record.name = "cut";
    const Scene scene = two_parts();
    stage.context.warn("W-CAP", "one loop stays open");
    stage.context.attribute_changes(
        scene.parts[0], {{"NORMAL", Domain::wedge, AttributeChange::Kind::recomputed, "the cap is flat"}});
    report::Check check;
    check.name = "closed";
    stage.context.check(check);
    CHECK(stage.record.warnings.at(0).id == "W-CAP");
    CHECK(stage.record.attribute_changes.at(0).part == "body");
    CHECK(stage.run.record.checks.at(0).stage == "cut");
}
