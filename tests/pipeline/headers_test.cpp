#include "support/catch.hpp"

#include "support/planning.hpp"
#include "support/temporary.hpp"

using namespace facetmill;

namespace {

constexpr const char* triangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// A directory with inputs, and the result of checking a pipeline against their headers.
struct Folder {
    test::TemporaryDirectory directory;
    Folder() {
        test::put(directory / "good.off", triangle);
        test::put(directory / "broken.ply", "ply\nformat ascii 1.0\nelement vertex many\nend_header\n");
        test::put(directory / "noise.xyz", "\x01\x02 nothing known");
        test::put(directory / "body.gltf",
                  R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                  R"("nodes":[{"mesh":0,"name":"hull"},{"mesh":0,"name":"mast"}]})");
    }
    pipeline::Plan plan(const std::string& stages) const {
        pipeline::PlanSettings settings;
        settings.places = {directory.path(), directory.path()};
        auto result = planned_stages(stages, settings);
        if (!result.problems.empty()) FAIL(result.problems);
        return std::move(result.plan);
    }
    /// "exit code: rendered" of every error.
    std::vector<std::string> errors(const std::string& stages) const {
        std::vector<std::string> all;
        for (const auto& error : read_headers(plan(stages)).errors)
            all.push_back(std::to_string(static_cast<int>(error.kind())) + ": " +
                          render(error.diagnostics().front()));
        return all;
    }
};

using Texts = std::vector<std::string>;

} // namespace

TEST_CASE("headers tell formats, units and the names of parts", "[pipeline]") {
    Folder ground;
    const auto plan = ground.plan("  - load: [body.gltf, good.off]\n");
    const auto headers = read_headers(plan);
    REQUIRE(headers.inputs.size() == 2);
    CHECK(headers.inputs[0].header.format == "gltf");
    CHECK(headers.inputs[0].header.unit == Unit::m);
    CHECK(headers.inputs[0].header.parts == Texts{"hull", "mast"});
    CHECK(headers.inputs[1].header.unit == Unit::unknown);
    CHECK(headers.errors.empty());
    const std::string text = describe(plan, headers);
    CHECK(text.find("body.gltf  (gltf, in m, y up; parts: hull, mast)\n") != std::string::npos);
    CHECK(text.find("good.off  (off, no unit)\n") != std::string::npos);
    CHECK(describe_json(plan, headers)["headers"][0]["parts"] == Json({"hull", "mast"}));
}

TEST_CASE("lengths with a unit are resolved where the scene's is known", "[pipeline]") {
    Folder ground;
    const auto plan = ground.plan("  - load: {path: good.off, unit: mm}\n  - crumple: {amplitude: 0.1in}\n");
    const auto headers = read_headers(plan);
    CHECK(describe(plan, headers).find("crumple: {amplitude: 0.1in}  (amplitude: 0.1in is 2.54 mm)\n") !=
          std::string::npos);
    CHECK(describe_json(plan, headers)["stages"][1]["resolved"].dump() ==
          R"({"amplitude":{"given":"0.1in","is":2.54,"unit":"mm"}})");
    CHECK(ground.errors("  - load: good.off\n  - transform: {unit: mm}\n  - write: {path: a.ply, unit: m}\n")
              .empty());
    const auto errors = ground.errors("  - load: good.off\n  - write: {path: a.ply, unit: mm}\n");
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].find("E-UNIT]: the scene has no unit, so it cannot be written in mm") !=
          std::string::npos);
}

TEST_CASE("the unit of an attribute is not that of the scene", "[pipeline]") {
    Folder ground;
    const std::string render = "  - render: {path: a.png, attribute: thickness, unit: mm}\n";
    CHECK(ground.errors("  - load: good.off\n" + render).empty());
    const auto plan =
        ground.plan("  - load: {path: good.off, unit: mm}\n" + render + "  - crumple: {amplitude: 0.1in}\n");
    CHECK(describe(plan, read_headers(plan)).find("0.1in is 2.54 mm") != std::string::npos);
}

TEST_CASE("stages name options of their own to the pipeline", "[pipeline]") {
    std::size_t named = 0;
    for (const auto& stage : stages())
        for (const auto* role : {&stage.roles.sets_unit, &stage.roles.writes_in_unit, &stage.roles.baseline,
                                 &stage.roles.updates_baseline}) {
            if (role->empty()) continue;
            CAPTURE(stage.name, *role);
            CHECK(stage.options->find(*role));
            ++named;
        }
    CHECK(named == 5);
}

TEST_CASE("inputs that no stage could load are found before anything runs", "[pipeline]") {
    Folder ground;
    const auto errors = ground.errors("  - load: [broken.ply, noise.xyz, good.off]\n");
    REQUIRE(errors.size() == 2);
    CHECK(errors[0].find("6: ") == 0);
    CHECK(errors[0].find("broken.ply:3") != std::string::npos);
    INFO(errors[1]);
    CHECK(errors[1].find("2: p.yaml:3:24: error[E-FORMAT]: facetmill cannot read the format of '") == 0);
}

TEST_CASE("a physical length on a scene without a unit is found before anything runs", "[pipeline]") {
    Folder ground;
    const char* later = "  - crumple: {amplitude: 2mm}\n  - branch:\n      a: [{crumple: 0.1in}]\n";
    const auto errors = ground.errors(std::string("  - load: good.off\n") + later);
    REQUIRE(errors.size() == 2);
    CHECK(errors[0] == "2: p.yaml:4:26: error[E-UNIT]: 'amplitude' is 2mm, but the scene has no unit\n    - "
                       "crumple: {amplitude: 2mm}\n                           ^~~\n  hint: give the unit of "
                       "the file (load: {unit: mm}), or use a bare number or a percentage");
    CHECK(ground.errors(std::string("  - load: {path: good.off, unit: mm}\n") + later).empty());
    CHECK(ground.errors(std::string("  - load: body.gltf\n") + later).empty());
    CHECK(ground.errors("  - load: good.off\n  - transform: {unit: mm, fit: 12mm}\n").empty());
}

TEST_CASE("so is the length in the short form of a plane, where it stands", "[pipeline]") {
    Folder ground;
    for (const std::string planes : {"plane: z=5mm", "planes: [x=10%, z=5mm]"}) {
        const auto errors = ground.errors("  - load: good.off\n  - clip: {" + planes + "}\n");
        REQUIRE(errors.size() == 1);
        INFO(errors[0]);
        CHECK(errors[0].find(
                  fmt::format("2: p.yaml:4:{}: error[E-UNIT]: '{}' is 5mm, but the scene has no unit",
                              12 + planes.find("5mm"), planes.substr(0, planes.find(':')))) == 0);
        CHECK(errors[0].find("^~~\n") != std::string::npos);
        CHECK(ground.errors("  - load: {path: good.off, unit: mm}\n  - clip: {" + planes + "}\n").empty());
    }
}

TEST_CASE("headers of missing files, streams and compressed files wait for the run", "[pipeline]") {
    Folder ground;
    test::put(ground.directory / "scan.ply.gz", "\x1f\x8b not gzip at all");
    CHECK(read_headers(ground.plan("  - load: [absent.ply, \"-\", scan.ply.gz]\n")).inputs.empty());
    CHECK(ground.errors("  - load: [absent.ply, \"-\", scan.ply.gz]\n  - crumple: 2mm\n").empty());
}

TEST_CASE("of many files that cannot be loaded the first are told and the others counted", "[pipeline]") {
    test::TemporaryDirectory directory;
    const auto errors = [&] {
        pipeline::PlanSettings settings;
        settings.places = {directory.path(), directory.path()};
        const auto result = planned_stages("  - load: '*.txt'\n", settings);
        REQUIRE(result.problems.empty());
        return read_headers(result.plan).errors;
    };
    const auto put = [&](int from, int to) {
        for (int i = from; i < to; ++i) test::put(directory / fmt::format("note{:02}.txt", i), "no mesh");
    };
    put(0, 10);
    CHECK(errors().size() == 10);
    put(10, 11);
    REQUIRE(errors().size() == 11);
    CHECK(std::string_view(errors().back().what()).find("note10.txt' cannot be loaded, either") !=
          std::string_view::npos);
    put(11, 40);
    const auto all = errors();
    REQUIRE(all.size() == 11);
    CHECK(all.back().kind() == all.front().kind());
    CHECK(all.back().diagnostics().front().id == "E-FORMAT");
    const std::string_view rest = all.back().what();
    CHECK(rest.find("30 more files cannot be loaded, '") != rest.npos);
    CHECK(rest.find("note10.txt' the first of them") != rest.npos);
}
