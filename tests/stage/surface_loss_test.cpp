// No stage loses surface in silence.
#include "support/catch.hpp"
#include "support/run_stage.hpp"

#include "mesh/shapes.hpp"
#include "stage/known_surfaces.hpp"

using namespace facetmill;

namespace {

using test::scene_of;

/// A stage that leaves the scene that `eat` returns.
struct Eater : Stage {
    StageInfo facts{.name = "eat", .about = "", .details = "", .examples = {}};
    std::function<Scene(Scene, Context&)> eat;

    Eater() { info = &facts; }
    void* target() override { return nullptr; }
    Scene run(Scene scene, Context& context) const override { return eat(std::move(scene), context); }
};

/// A stage that may lose so much, and leaves the scene that make returns.
test::StageRun performed(MayLose may_lose, Scene scene, const std::function<Scene(Scene)>& make) {
    Eater stage;
    stage.facts.may_lose = may_lose;
    stage.eat = [&](Scene entering, Context&) { return make(std::move(entering)); };
    test::StageRun run;
    run.record.name = "eat";
    const PartFilter all;
    Context context(*run.state, run.record, all, scene.bounds(), {});
    run.scene = perform(stage, std::move(scene), context);
    return run;
}

std::string warned(MayLose may_lose, Scene scene, const std::function<Scene(Scene)>& make) {
    const auto run = performed(may_lose, std::move(scene), make);
    REQUIRE(run.record.warnings.size() <= 1);
    if (run.record.warnings.empty()) return "";
    CHECK(run.record.warnings[0].id == "W-SURFACE-LOST");
    return run.record.warnings[0].message;
}

/// Leaves the first faces of the first part.
auto leaving(std::size_t faces) {
    return [faces](Scene scene) {
        scene.parts.at(0).mesh.corners.resize(3 * faces);
        return scene;
    };
}

/// A sheet of ten faces of equal area.
Scene sheet() { return scene_of(shapes::grid(5, 1)); }

} // namespace

TEST_CASE("a stage that leaves no face says so, unless it has said so itself", "[stage]") {
    for (const MayLose may : {MayLose::tenth, MayLose::half, MayLose::area})
        CHECK(warned(may, sheet(), leaving(0)) ==
              "'eat' lost surface of part 'part': it lost all of its 10 faces");
    CHECK(warned(MayLose::all, sheet(), leaving(0)) == "");
    CHECK(warned(MayLose::tenth, scene_of(Mesh{}), leaving(0)) == "");
}

TEST_CASE("a stage that takes more of the area than it may says how much", "[stage]") {
    CHECK(warned(MayLose::tenth, sheet(), leaving(9)) == "");
    CHECK(warned(MayLose::tenth, sheet(), leaving(8))
              .starts_with("'eat' lost surface of part 'part': it lost 20 % of its area, "));
    CHECK(warned(MayLose::half, sheet(), leaving(5)) == "");
    CHECK(warned(MayLose::half, sheet(), leaving(4)).find("60 %") != std::string::npos);
    CHECK(warned(MayLose::area, sheet(), leaving(1)) == "");
}

TEST_CASE("surface is missed in every part, and in the scene when the parts are others", "[stage]") {
    Scene two = sheet();
    two.parts.push_back(two.parts[0]);
    two.parts[1].name = "other";
    CHECK(warned(MayLose::tenth, two, leaving(0)) ==
          "'eat' lost surface of part 'part': it lost all of its 10 faces");
    const auto first_only = [](Scene scene) {
        scene.parts.pop_back();
        return scene;
    };
    CHECK(
        warned(MayLose::tenth, two, first_only).starts_with("'eat' lost surface of the scene: it lost 50 %"));
    CHECK(warned(MayLose::half, two, first_only) == "");
    const auto nothing = [](Scene) { return Scene{}; };
    CHECK(warned(MayLose::half, two, nothing) ==
          "'eat' lost surface of the scene: it lost all of its 20 faces");
}

TEST_CASE("what one stage leaves of the surface is what the next one finds", "[stage]") {
    Eater stage;
    stage.eat = [](Scene scene, Context&) { return leaving(8)(std::move(scene)); };
    test::StageRun run;
    run.record.name = "eat";
    const PartFilter all;
    Context context(*run.state, run.record, all, sheet().bounds(), {});
    std::optional<std::vector<PartSurface>> surfaces;
    const auto eaten = [&] {
        run.record.warnings.clear();
        const Scene left = perform(stage, sheet(), context, surfaces);
        CHECK(left.face_count() == 8);
        return run.record.warnings.size();
    };
    CHECK(eaten() == 1);
    REQUIRE(surfaces);
    CHECK(surfaces->at(0).faces == 8);
    CHECK(surfaces->at(0).area == surfaces_of_parts(leaving(8)(sheet())).at(0).area);
    CHECK(eaten() == 0); // the recorded size is eight faces, so none was lost
    surfaces->at(0).area = 1e3;
    CHECK(eaten() == 1);

    surfaces->at(0).area = 1e-3;
    stage.facts.crossing_faces =
        CrossingFacePolicy::fill; // before the stage, as after stages that leave none
    CHECK(eaten() == 1);
    stage.facts.may_lose = MayLose::all;
    CHECK(eaten() == 0);
    CHECK_FALSE(surfaces);
    surfaces.emplace();
    stage.facts.may_lose = MayLose::tenth;
    stage.eat = [](Scene, Context&) -> Scene { throw std::runtime_error("no"); };
    CHECK_THROWS(perform(stage, sheet(), context, surfaces));
    CHECK_FALSE(surfaces);
}

TEST_CASE("the size that a stage measured is what the next one finds, part by part", "[stage]") {
    test::StageRun run;
    const PartFilter all;
    Scene scene = scene_of(shapes::icosphere(2));
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "other";
    scene.parts[1].transform.m[1][1] = 2;
    Eater stage;
    const SurfaceSize told{1, 2};
    stage.eat = [&](Scene entering, Context& context) {
        context.keep_size(1, told);
        return entering;
    };
    std::optional<std::vector<PartSurface>> surfaces;
    Context first(*run.state, run.record, all, scene.bounds(), {});
    scene = perform(stage, std::move(scene), first, surfaces);
    REQUIRE(surfaces);
    CHECK_FALSE(surfaces->at(0).size);
    REQUIRE(surfaces->at(1).size);
    CHECK(surfaces->at(1).area == told.area);

    stage.eat = [&](Scene entering, Context& context) {
        const Part& part = entering.parts[0];
        CHECK(context.size_before(entering, 0).area == surface_size(part.mesh, part.transform).area);
        CHECK(context.size_before(entering, 1).volume == told.volume);
        context.keep_size(1, told);
        entering.parts.pop_back(); // the recorded size belongs to none of the parts
        return entering;
    };
    Context second(*run.state, run.record, all, scene.bounds(), {});
    scene = perform(stage, std::move(scene), second, surfaces);
    CHECK_FALSE(surfaces->at(0).size);
}

TEST_CASE("relax and simplify leave the sizes that they measured", "[stages]") {
    for (const auto& [name, options] :
         {std::pair("relax", "{iterations: 1}"), std::pair("simplify", "{ratio: 50%}")}) {
        Problems problems;
        const auto source = std::make_shared<const SourceText>(SourceText{"test.yaml", options});
        const auto stage =
            test::use_of(test::stage_for_test(name), pipeline::parse_yaml(source, problems), problems);
        Scene scene = scene_of(shapes::icosphere(3));
        scene.parts[0].transform.m[1][1] = 2;
        test::StageRun run;
        const PartFilter all;
        Context context(*run.state, run.record, all, scene.bounds(), {});
        std::optional<std::vector<PartSurface>> surfaces;
        scene = perform(*stage, std::move(scene), context, surfaces);
        REQUIRE(surfaces);
        REQUIRE(surfaces->at(0).size);
        const SurfaceSize anew = surface_size(scene.parts[0].mesh, scene.parts[0].transform);
        CHECK(surfaces->at(0).size->area == anew.area);
        CHECK(surfaces->at(0).size->volume == anew.volume);
        CHECK(surfaces->at(0).area == surfaces_of_parts(scene).at(0).area);
    }
}

TEST_CASE("areas beyond numbers are not compared", "[stage]") {
    Scene wide = sheet();
    for (Vec3& p : wide.parts[0].mesh.positions) p = p * 1e200;
    CHECK(warned(MayLose::tenth, wide, leaving(2)) == "");
    Scene flat = sheet();
    for (Vec3& p : flat.parts[0].mesh.positions) p.y = 0;
    CHECK(warned(MayLose::tenth, flat, leaving(2)) == "");
}

TEST_CASE("relax that shrinks a sphere away says so", "[stages]") {
    const auto run = test::run_stage("relax", "{iterations: 400}", scene_of(shapes::icosphere(1)));
    CHECK(run.warnings() == std::vector<std::string>{"W-SURFACE-LOST"});
    CHECK(test::run_stage("relax", "{iterations: 1}", scene_of(shapes::icosphere(2))).warnings().empty());
}

TEST_CASE("clean of a sheet with its hole filled leaves faces, or says that it does not", "[stages]") {
    const auto run = test::run_stage("clean", "{holes: minimal, self_intersections: all}", sheet());
    const auto warnings = run.warnings();
    const bool told = std::find(warnings.begin(), warnings.end(), "W-SURFACE-LOST") != warnings.end();
    CHECK((run.mesh().face_count() > 0 || told));
}

TEST_CASE("what is taken as asked is not lost", "[stages]") {
    Scene scene = sheet();
    append(scene.parts[0].mesh, shapes::icosphere(2));
    CHECK(test::run_stage("clean", "{components: {keep: 1}}", scene).warnings().empty());
    CHECK(test::run_stage("transform", "{scale: 0.001}", scene).warnings().empty());
}
