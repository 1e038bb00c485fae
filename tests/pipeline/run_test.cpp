#include "support/catch.hpp"

#include "pipeline/run.hpp"
#include "report/render.hpp"
#include "support/heard.hpp"
#include "support/planning.hpp"
#include "support/temporary.hpp"

#include <algorithm>
#include <fmt/format.h>

using namespace facetmill;
using pipeline::RunSettings;
using report::RunRecord;

namespace {

/// A directory with the input a.ply, in which pipelines run.
struct Ground {
    test::TemporaryDirectory directory;
    Ground() { test::put(directory / "a.ply", "x"); }

    RunRecord run(const std::string& stages, RunSettings settings = {}, const std::string& rest = {}) {
        pipeline::PlanSettings plan;
        plan.places = {directory.path(), directory.path()};
        auto result = planned("facetmill: 1\nstages:\n" + stages + rest, plan);
        if (!result.problems.empty()) FAIL(result.problems);
        settings.check_invariants = true;
        return pipeline::run_plan(result.plan, settings);
    }
    std::string file(const char* name) const { return test::get(directory / name); }
};

std::string errors_of(const RunRecord& record) {
    std::string out;
    for (const auto& d : record.errors) out += (out.empty() ? "" : "\n") + render(d);
    return out;
}

std::string ran(const RunRecord& record) {
    std::string out;
    for (const auto& s : record.stages)
        out += fmt::format("{}{}{}", out.empty() ? "" : " ", s.name, s.skipped ? "(skipped)" : "");
    return out;
}

using Names = std::vector<std::string>;

} // namespace

TEST_CASE("stages run in order and the outputs are written", "[pipeline]") {
    Ground ground;
    const auto record = ground.run("  - test-load: a.ply\n  - test-cut: 5\n  - test-write: out/b.txt\n");
    CHECK(errors_of(record).empty());
    CHECK(record.exit_code == 0);
    CHECK(ground.file("out/b.txt") == "a 5\n");
    CHECK(record.stages.at(1).before.value().faces == 12);
    CHECK(record.stages.at(1).after.value().faces == 5);
    CHECK(record.stages.at(1).resolved.at(0).given == "1%");
}

TEST_CASE("every branch begins with the scene that entered, which also goes on", "[pipeline]") {
    Ground ground;
    const auto record = ground.run("  - test-load: a.ply\n"
                                   "  - branch:\n"
                                   "      near: [test-cut: 9, test-write: near.txt]\n"
                                   "      far: [test-write: far.txt, test-cut: 2]\n"
                                   "  - foreach: {keep: [3, 4]}\n"
                                   "    do: [{test-cut: \"${keep}\"}, {test-write: \"${keep.index}.txt\"}]\n"
                                   "  - test-write: all.txt\n");
    CHECK(errors_of(record).empty());
    CHECK(ground.file("near.txt") == "a 9\n");
    CHECK(ground.file("far.txt") == "a 12\n");
    CHECK(ground.file("0.txt") == "a 3\n");
    CHECK(ground.file("1.txt") == "a 4\n");
    CHECK(ground.file("all.txt") == "a 12\n");
}

TEST_CASE("join concatenates what the arms made", "[pipeline]") {
    Ground ground;
    const auto record = ground.run("  - test-load: a.ply\n"
                                   "  - foreach: {keep: [3, 4]}\n"
                                   "    do: [test-cut: \"${keep}\"]\n"
                                   "    join: true\n"
                                   "  - test-write: all.txt\n");
    CHECK(errors_of(record).empty());
    CHECK(ground.file("all.txt") == "a 3\na.keep_4 4\n");
}

TEST_CASE("a foreach over parts gives each its own scene, and join puts them back", "[pipeline]") {
    Ground ground;
    test::put(ground.directory / "b.ply", "x");
    const std::string load = "  - test-load: a.ply\n  - test-load: b.ply\n";
    const auto each =
        ground.run(load + "  - foreach: {part: \"*\"}\n    do: [test-write: \"o.${part}.txt\"]\n");
    CHECK(errors_of(each).empty());
    CHECK(ground.file("o.a.txt") == "a 12\n");
    CHECK(ground.file("o.b.txt") == "b 12\n");
    const auto put_back = ground.run(
        load + "  - foreach: {part: b}\n    do: [test-cut: 2]\n    join: true\n  - test-write: all.txt\n");
    CHECK(errors_of(put_back).empty());
    CHECK(ground.file("all.txt") == "a 12\nb 2\n");
}

TEST_CASE("files that collide once the parts are known fail before anything is written", "[pipeline]") {
    Ground ground;
    test::put(ground.directory / "A.ply", "x");
    const auto record = ground.run("  - test-load: a.ply\n  - test-load: A.ply\n  - foreach: {part: \"*\"}\n "
                                   "   do: [test-write: \"${part}.txt\"]\n");
    CHECK(record.exit_code == 2);
    CHECK(errors_of(record).find("are the same file if case is ignored") != std::string::npos);
    CHECK(ground.directory.names() == Names{"A.ply", "a.ply"});
}

TEST_CASE("stages in a foreach or a branch that is skipped are told, too", "[pipeline]") {
    Ground ground;
    const auto record =
        ground.run("  - test-load: a.ply\n"
                   "  - foreach: {n: [5, 4]}\n    when: {closed: false}\n"
                   "    do: [{test-cut: \"${n}\"}]\n"
                   "  - branch: {a: [test-cut: 3, {branch: {b: [test-cut: 2]}}]}\n    when: false\n"
                   "  - test-write: b.txt\n");
    CHECK(errors_of(record).empty());
    CHECK(ran(record) == "test-load n=5/test-cut(skipped) n=4/test-cut(skipped) a/test-cut(skipped) "
                         "a/b/test-cut(skipped) test-write");
    CHECK(ground.file("b.txt") == "a 12\n");
}

TEST_CASE("when skips a stage, and sees the scene at its place", "[pipeline]") {
    Ground ground;
    const auto record = ground.run("  - test-load: a.ply\n"
                                   "  - test-cut: 5\n    when: {closed: false}\n"
                                   "  - test-cut: 4\n    when: {faces: {min: 12}}\n"
                                   "  - test-write: b.txt\n");
    CHECK(ran(record) == "test-load test-cut(skipped) test-cut-2 test-write");
    CHECK(ground.file("b.txt") == "a 4\n");
}

TEST_CASE("a contract on the deviation compares with what entered the stage, or with what was loaded",
          "[pipeline]") {
    Ground ground;
    // A cube loses faces twice: two of twelve, then six.
    const std::string cuts = "  - test-load: a.ply\n  - test-cut: 10\n";
    const auto close = ground.run(cuts + "    ensure: {deviation: 70%}\n");
    CHECK(errors_of(close).empty());
    REQUIRE(close.checks.size() == 1);
    CHECK(close.checks[0].name == "deviation");
    CHECK(close.stages.at(1).result["deviation"]["forward"]["samples"] == 100000);
    const auto far =
        ground.run(cuts + "    ensure: {deviation: {max: 1%, samples: 10}}\n  - test-write: c.txt\n");
    CHECK(far.exit_code == 1);
    CHECK(far.checks.at(0).where.line == 5);
    CHECK(far.outputs.empty());
    const std::string again = cuts + "  - test-cut: 10\n    ensure: {deviation: {max: 1%, from: ";
    CHECK(ground.run(again + "stage}}\n").exit_code == 0);
    CHECK(ground.run(again + "load}}\n").exit_code == 1);
    CHECK(ground.run(cuts + "  - ensure: {deviation: 1%}\n").exit_code == 1);
    CHECK(ground.run(cuts + "  - ensure: {deviation: 70%}\n").exit_code == 0);
}

TEST_CASE("ensure is checked right after its stage, and a failure keeps all outputs back", "[pipeline]") {
    Ground ground;
    test::put(ground.directory / "b.txt", "older");
    const auto record = ground.run("  - test-load: a.ply\n  - test-write: b.txt\n  - test-cut: 5\n    "
                                   "ensure: {closed: true, faces: {max: 5}}\n  - test-write: c.txt\n");
    CHECK(record.exit_code == 1);
    CHECK(errors_of(record) ==
          "p.yaml:6:22: error[E-CHECK]: 'closed' must be true, found false\n      ensure: {closed: true, "
          "faces: {max: 5}}\n                       ^~~~\n  hint: use clean: {weld: near, tolerance: "
          "0.0001%} to join corners that differ by rounding, clean: {holes: minimal} to fill holes, or "
          "orient to make faces consistent");
    CHECK(record.checks.size() == 2);
    CHECK(record.outputs.empty());
    CHECK(ran(record) == "test-load test-write test-cut");
    CHECK(ground.file("b.txt") == "older");
    CHECK(ground.directory.names() == Names{"a.ply", "b.txt"});
}

TEST_CASE("checks in a row all run before a failure ends the branch; other branches go on", "[pipeline]") {
    Ground ground;
    const auto record = ground.run(
        "  - test-load: a.ply\n"
        "  - branch:\n"
        "      one: [test-judge: false, test-judge: {passes: false, called: second}, test-cut: 3]\n"
        "      two: [test-fail: error]\n"
        "      three: [test-judge: true, test-write: o.txt]\n");
    CHECK(ran(record) ==
          "test-load one/test-judge one/test-judge-2 two/test-fail three/test-judge three/test-write");
    CHECK(record.errors.size() == 3);
    CHECK(record.exit_code == 5); // the actual failure determines the code, not the earlier check
    CHECK(ground.directory.names() == Names{"a.ply"});
}

TEST_CASE("whatever a stage throws has a kind, an id and a place", "[pipeline]") {
    Ground ground;
    const auto failing = [&](const char* how) {
        return ground.run(fmt::format("  - test-load: a.ply\n  - test-fail: {}\n", how));
    };
    const auto error = failing("error");
    CHECK(error.exit_code == 5);
    CHECK(errors_of(error) == "p.yaml:4:5: error[E-TEST]: this stage never works\n"
                              "    - test-fail: error\n"
                              "      ^~~~~~~~~\n"
                              "  hint: use another");
    const auto memory = failing("memory");
    CHECK(memory.exit_code == 7);
    CHECK(memory.errors.at(0).message == "not enough memory for 'test-fail'");
    const auto bug = failing("bug");
    CHECK(bug.exit_code == 70);
    CHECK(bug.errors.at(0).message == "'test-fail' failed unexpectedly: index out of range");
}

TEST_CASE("a missing input is found before anything runs", "[pipeline]") {
    Ground ground;
    const auto record = ground.run("  - test-load: aa.ply\n  - test-load: a.ply\n");
    CHECK(record.exit_code == 3);
    CHECK(record.stages.empty());
    REQUIRE(record.errors.size() == 1);
    CHECK(record.errors[0].hint == "did you mean 'a.ply'?");
    CHECK(to_string(record.errors[0].where) == "p.yaml:3:16");
}

TEST_CASE("warnings are forwarded, and strict makes them fail", "[pipeline]") {
    Ground ground;
    const std::string stages =
        "  - test-load: a.ply\n  - test-warn: W-ONE\n  - test-warn: W-TWO\n  - test-write: b.txt\n";
    std::string heard;
    RunSettings settings;
    settings.on_warning = [&](const Diagnostic& d) { heard += d.id + " "; };
    CHECK(ground.run(stages, settings).exit_code == 0);
    CHECK(heard == "W-ONE W-TWO ");
    settings.strict = {"W-OTHER"};
    CHECK(ground.run(stages, settings).exit_code == 0);
    settings.strict = {"W-TWO"};
    const auto record = ground.run(stages, settings);
    CHECK(record.exit_code == 1);
    CHECK(record.errors.size() == 1);
    CHECK(record.errors.at(0).message == "--strict makes W-TWO fail: this is only a test");
    settings.strict = {"*"};
    CHECK(ground.run(stages, settings).errors.size() == 2);
}

TEST_CASE("only that selects nothing is worth a warning", "[pipeline]") {
    Ground ground;
    const auto record =
        ground.run("  - test-load: a.ply\n  - test-cut: 2\n    only: wheel*\n  - test-write: b.txt\n");
    CHECK(ground.file("b.txt") == "a 12\n");
    CHECK(record.stages.at(1).warnings.at(0).id == "W-ONLY");
}

TEST_CASE("reports are always written, and are the same but for what varies", "[pipeline]") {
    Ground ground;
    const std::string stages = "  - test-load: a.ply\n  - test-cut: 5\n  - test-judge: false\n";
    const std::string reports = "report: [r/r.json, r/r.html, r/r.xml, r/r.txt]\n";
    CHECK(ground.run(stages, {}, reports).exit_code == 1);
    auto first = Json::parse(ground.file("r/r.json"));
    CHECK(first["passed"] == false);
    CHECK(first["checks"][0]["where"] == "p.yaml:5:5");
    const std::string junit = ground.file("r/r.xml");
    CHECK(junit.find("<testsuite name=\"p.yaml\" tests=\"1\" failures=\"1\" errors=\"0\">") !=
          std::string::npos);
    CHECK(ground.file("r/r.txt").find(
              "failed: [E-CHECK] 'sound' must be true, found false; no output was written; exit code 1\n") !=
          std::string::npos);
    CHECK(ground.file("r/r.html").find("<h3>test-cut </h3>\n<p>12 &rarr; 5 faces") != std::string::npos);
    CHECK(ground.run(stages, {}, reports).exit_code == 1);
    CHECK(first.dump() == Json::parse(ground.file("r/r.json")).dump());
    CHECK(ground.file("r/r.xml") == junit);
}

TEST_CASE("parameters: types, defaults, -D relative to the working directory", "[pipeline]") {
    const std::string text = "facetmill: 1\n"
                             "params:\n"
                             "  input: {type: path, help: The scan to read}\n"
                             "  keep: {type: ratio, default: 10%, max: 50%}\n"
                             "  method: {type: choice, choices: [fast, exact], default: fast}\n"
                             "  note: {type: text, required: false}\n"
                             "stages:\n"
                             "  - test-load: \"${input}\"\n"
                             "  - test-cut: {ratio: \"${keep}\", method: \"${method}\"}\n"
                             "  - test-write: \"${input.stem}$${x}${input.ext}.${keep}.txt\"\n";
    const auto with = [&](std::vector<std::pair<std::string, std::string>> defines) {
        pipeline::PlanSettings settings;
        settings.defines = std::move(defines);
        settings.working_directory = "/work-dir";
        settings.places.input_base = "/work-dir/pipelines";
        return planned(text, settings);
    };
    const auto good = with({{"input", "scans/a.ply.gz"}, {"keep", "25%"}});
    CHECK(good.problems.empty());
    CHECK(good.plan.steps.at(0).given.text == "../scans/a.ply.gz");
    CHECK(good.plan.steps.at(2).given.text == "a${x}.ply.gz.25%.txt");
    CHECK(good.plan.params.dump() ==
          R"({"input":"scans/a.ply.gz","keep":"25%","method":"fast","note":null})");
    CHECK(with({}).problems == "p.yaml:3:3: error[E-PARAM]: the param 'input' has no value\n"
                               "    input: {type: path, help: The scan to read}\n"
                               "    ^~~~~\n"
                               "  hint: give it with -D input=... (The scan to read)");
    CHECK(with({{"input", "a"}, {"kep", "1%"}}).problems ==
          "-D:1:1: error[E-PARAM]: the pipeline has no param 'kep'\n"
          "  kep=1%\n"
          "  ^~~~~~\n"
          "  hint: did you mean 'keep'?");
    CHECK(with({{"input", "a"}, {"keep", "60%"}}).problems ==
          "-D:1:6: error[E-RANGE]: the param 'keep' must be at most 50%, found '60%'\n"
          "  keep=60%\n"
          "       ^~~");
    CHECK(with({{"input", "a"}, {"method", "slow"}}).problems ==
          "-D:1:8: error[E-CHOICE]: 'method' must be one of fast, exact, found 'slow'\n  method=slow\n       "
          "  ^~~~");
    CHECK(with({{"input", "a"}, {"keep", "lots"}}).problems ==
          "-D:1:6: error[E-TYPE]: expected a ratio (25% or 0.25), found 'lots'\n"
          "  keep=lots\n"
          "       ^~~~");
}

TEST_CASE("check accepts a pipeline whose parameters are not given", "[pipeline]") {
    pipeline::PlanSettings settings;
    settings.parameters_needed = false;
    CHECK(planned("facetmill: 1\nparams: {n: {type: integer}, file: {type: path}}\nstages:\n  - test-load: "
                  "\"${file}\"\n  - test-cut: \"${n}\"\n  - test-write: \"${file.stem}.${n}.x\"\n",
                  settings)
              .problems.empty());
}

TEST_CASE("a report that cannot be written fails the run before its first stage, and the others are written",
          "[pipeline]") {
    Ground ground;
    const auto record =
        ground.run("  - test-load: a.ply\n  - test-write: b.txt\n", {}, "report: [a.ply/r.json, r.txt]\n");
    CHECK(record.exit_code == 4);
    CHECK(record.stages.empty());
    CHECK(record.errors.size() == 1);
    CHECK_FALSE(std::filesystem::exists(ground.directory / "b.txt"));
    CHECK(record.reports == Names{"r.txt"});
    CHECK(ground.file("r.txt").find("no output was written") != std::string::npos);
}

TEST_CASE("a pipeline is read from a file, whose folder its inputs are relative to", "[pipeline]") {
    Ground ground;
    test::put(ground.directory / "p.yaml", "facetmill: 1\nstages:\n  - test-load: a.ply\n");
    Problems problems;
    const auto plan =
        pipeline::plan_source(pipeline::read_pipeline(ground.directory / "p.yaml"), {}, problems);
    CHECK(problems.size() == 0);
    CHECK(planned_inputs(plan) == std::vector<std::filesystem::path>{ground.directory / "a.ply"});
    CHECK_THROWS_AS(pipeline::read_pipeline(ground.directory / "q.yaml"), Error);
}

TEST_CASE("a stage that leaves the range of numbers fails at its place in the pipeline", "[pipeline]") {
    Ground ground;
    test::put(ground.directory / "a.off", "OFF\n3 1 0\n0 0 0\n1e300 0 0\n0 1e300 0\n3 0 1 2\n");
    const auto record = ground.run("  - load: a.off\n  - transform: {scale: 1e10}\n");
    CHECK(record.exit_code == 5);
    REQUIRE(record.errors.size() == 1);
    CHECK(record.errors[0].id == "E-RANGE");
    CHECK(record.errors[0].where.line == 4);
    CHECK(record.errors[0].message == "the box in world space exceeds 1.8e308, the largest number");
}

namespace {

/// The largest step between progress reports. All shares must lie from 0 to 1 and never decrease.
double largest_gap(const std::vector<double>& shares) {
    double gap = 0, last = 0;
    for (const double share : shares) {
        CHECK(share >= 0);
        CHECK(share <= 1);
        CHECK(share >= last);
        gap = std::max(gap, share - last);
        last = std::max(last, share);
    }
    return std::max(gap, 1 - last);
}

} // namespace

TEST_CASE("stages that take long tell how far they are, from beginning to end", "[pipeline]") {
    test::TemporaryDirectory directory;
    pipeline::PlanSettings plan;
    plan.places = {directory.path(), directory.path()};
    plan.extra_reports = {"r.html"};
    const auto make = [&](const std::string& stages) {
        auto result = planned("facetmill: 1\nstages:\n" + stages, plan);
        if (!result.problems.empty()) FAIL(result.problems);
        test::Heard heard;
        RunSettings settings;
        settings.progress = &heard;
        const auto record = pipeline::run_plan(result.plan, settings);
        CHECK(errors_of(record).empty());
        return heard.before;
    };
    const auto first = make("  - generate: {shape: icosphere, subdivisions: 6, noise: 0.1%}\n"
                            "  - write: a.ply\n"
                            "  - {name: text, write: {path: b.ply, ascii: true}}\n"
                            "  - {name: obj, write: c.obj}\n"
                            "  - {name: stl, write: {path: d.stl, ascii: true}}\n"
                            "  - {name: off, write: e.off}\n"
                            "  - {name: draco, write: {path: f.glb, draco: true}}\n"
                            "  - {name: meshopt, write: {path: g.glb, meshopt: true}}\n");
    for (const char* stage : {"write", "text", "obj", "stl", "off", "draco", "meshopt"}) {
        INFO(stage);
        CHECK(largest_gap(first.at(stage)) < 0.45);
    }
    const auto second = make("  - load: [a.ply, b.ply, c.obj, d.stl, e.off, f.glb]\n"
                             "  - split: {passes: 2}\n"
                             "  - simplify: 20%\n"
                             "  - relax: 10\n"
                             "  - {name: limited, simplify: {max_error: 0.2%}}\n"
                             "  - validate: {self_intersections: {max: 100000000}}\n"
                             "  - clean: {self_intersections: local}\n"
                             "  - crumple: {amplitude: 0.1%, self_intersections: avoid}\n"
                             "    ensure: {deviation: 50%}\n"
                             "  - render: p.png\n");
    const std::pair<const char*, double> limits[] = {{"load", 0.2},
                                                     {"split", 0.85},
                                                     {"simplify", 0.25},
                                                     {"relax", 0.25},
                                                     {"limited", 0.3},
                                                     {"validate", 0.3},
                                                     {"clean", 0.55},
                                                     {"crumple", 0.55},
                                                     {"render", 0.4},
                                                     {"ensure of crumple", 0.3},
                                                     {"picture after relax", 0.4}};
    for (const auto& [what, limit] : limits) {
        INFO(what);
        CHECK(largest_gap(second.at(what)) < limit);
    }
    CHECK(second.contains("r.html"));
    CHECK(second.contains("inspection of the result"));
}
