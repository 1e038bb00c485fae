#include "support/catch.hpp"

#include "pipeline/params.hpp"
#include "support/planning.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

using namespace facetmill;
using pipeline::PlanSettings;

namespace {

/// The names of the steps and their options, in order.
std::string stages_in(const pipeline::Steps& steps) {
    std::string out;
    for (const auto& step : steps) out += step.name + " " + pipeline::emit_flow(step.given) + "; ";
    return out;
}

std::string problems_in(const test::TemporaryDirectory& folder, const std::string& items) {
    PlanSettings settings;
    settings.places.input_base = folder.path();
    std::string found = planned_stages(items, settings).problems;
    const std::string place = folder.path().string() + "/";
    for (auto at = found.find(place); at != found.npos; at = found.find(place)) found.erase(at, place.size());
    return found;
}

} // namespace

TEST_CASE("include puts the stages of another file in its place", "[pipeline]") {
    const test::TemporaryDirectory folder;
    std::filesystem::create_directories(folder / "parts/deeper");
    test::put(folder / "parts/finish.yaml", "facetmill: 1\nparams:\n  faces: {type: integer, default: 3}\n"
                                            "  mask: {type: path, default: mask.ply}\nstages:\n"
                                            "  - test-cut: {faces: \"${faces}\"}\n  - test-load: other.ply\n"
                                            "  - test-load: \"${mask}\"\n  - include: deeper/last.yaml\n");
    test::put(folder / "parts/deeper/last.yaml", "facetmill: 1\nstages: [{test-load: deep.ply}]\n");
    PlanSettings settings;
    settings.places.input_base = folder.path();
    const auto result =
        planned("facetmill: 1\nparams: {n: {type: integer, default: 7}}\nstages:\n  - test-load: a.ply\n"
                "  - include: parts/finish.yaml\n    with: {faces: \"${n}\"}\n"
                "  - include: parts/finish.yaml\n    with: {mask: near.ply}\n",
                settings);
    CHECK(result.problems == "");
    CHECK(stages_in(result.plan.steps) ==
          "test-load a.ply; finish/test-cut {faces: 7}; finish/test-load parts/other.ply; "
          "finish/test-load-2 parts/mask.ply; finish/last/test-load parts/deeper/deep.ply; "
          "finish-2/test-cut {faces: 3}; finish-2/test-load parts/other.ply; finish-2/test-load-2 near.ply; "
          "finish-2/last/test-load parts/deeper/deep.ply; ");
    CHECK(result.plan.steps[1].path == "stages[1].include[0]");
    std::vector<std::filesystem::path> read;
    for (const auto& file : result.plan.others) read.push_back(file.path);
    CHECK(read == std::vector<std::filesystem::path>{folder / "parts/finish.yaml",
                                                     folder / "parts/deeper/last.yaml"});
}

TEST_CASE("a file in the working directory includes its neighbour", "[pipeline]") {
    const test::TemporaryDirectory folder;
    const auto here = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    test::put("near.yaml", "facetmill: 1\nstages: [{test-load: b.ply}]\n");
    const auto result = planned_stages("  - include: near.yaml\n"); // its folder has no name
    std::filesystem::current_path(here);
    CHECK(result.problems == "");
    CHECK(stages_in(result.plan.steps) == "near/test-load b.ply; ");
    CHECK(pipeline::planned_inputs(result.plan).size() == 2);
    CHECK(pipeline::inputs_of_steps(result.plan).size() == 1); // messages are about b.ply alone
}

TEST_CASE("what is wrong with an include is said at its place", "[pipeline]") {
    const test::TemporaryDirectory folder;
    test::put(folder / "a.yaml", "facetmill: 1\nstages: [{include: b.yaml}]\n");
    test::put(folder / "b.yaml", "facetmill: 1\nstages: [{include: a.yaml}]\n");
    test::put(folder / "report.yaml", "facetmill: 1\nstages: [test-cut]\nreport: x.json\n");
    test::put(folder / "needs.yaml", "facetmill: 1\nparams: {k: {type: ratio}}\nstages: [test-cut]\n");
    test::put(folder / "list.yaml", "- test-cut\n");
    test::put(folder / "broken.yaml", "facetmill: 1\nstages: [\n");
    const auto has = [&](const std::string& items, const std::string& text) {
        const std::string found = problems_in(folder, "  - test-load: a.ply\n" + items);
        INFO(found);
        CHECK(found.find(text) != found.npos);
    };
    has("  - include: a.yaml\n", "b.yaml:2:20: error[E-INCLUDE]: 'a.yaml' includes itself");
    has("  - include: a.yaml\n", "hint: a.yaml -> b.yaml -> a.yaml");
    // 33 files one through the other, of which 32 are between the pipeline and the last.
    for (int i = 0; i < 33; ++i)
        test::put(folder / fmt::format("deep{}.yaml", i),
                  fmt::format("facetmill: 1\nstages: [{{include: deep{}.yaml}}]\n", i + 1));
    test::put(folder / "deep33.yaml", "facetmill: 1\nstages: [test-cut]\n");
    has("  - include: deep0.yaml\n",
        "deep31.yaml:2:20: error[E-INCLUDE]: 'deep32.yaml' is included through more than 32");
    CHECK(problems_in(folder, "  - test-load: a.ply\n  - include: deep2.yaml\n").find("E-INCLUDE") ==
          std::string::npos);
    // The pipeline is the first of a chain of includes. Unknown contents do not cause errors in later steps.
    test::put(folder / "first.yaml", "facetmill: 1\nstages: [{include: second.yaml}, {test-write: o.glb}]\n");
    test::put(folder / "second.yaml", "facetmill: 1\nstages: [{include: first.yaml}]\n");
    Problems problems;
    pipeline::plan_source(pipeline::read_pipeline(folder / "first.yaml"), {}, problems);
    REQUIRE(problems.all().size() == 1);
    CHECK(problems.all()[0].id == "E-INCLUDE");
    CHECK(problems.all()[0].hint.find("first.yaml -> ") != std::string::npos);
    has("  - include: report.yaml\n", "error[E-KEY]: an included file cannot have 'report'");
    has("  - include: needs.yaml\n", "needs.yaml:2:10: error[E-PARAM]: the param 'k' has no value");
    has("  - include: needs.yaml\n", "with: {k: ...}");
    has("  - include: needs.yaml\n    with: {k: 2}\n", "error[E-TYPE]");
    has("  - include: needs.yaml\n    with: {k: 10%, kk: 1}\n", "the included file has no param 'kk'");
    has("  - include: list.yaml\n", "list.yaml:1:1: error[E-TYPE]");
    has("  - include: broken.yaml\n", "broken.yaml:");
    has("  - include: needs.yaml\n    when: true\n", "'when' is not a key of an item");
    has("  - include: needs.yaml\n    when: true\n",
        "hint: it applies to a single stage: add it to the stages of include");
    CHECK_THROWS_AS(problems_in(folder, "  - include: gone.yaml\n"), Error);
}

TEST_CASE("lists of a preset keep their places, and their paths its folder", "[pipeline]") {
    const test::TemporaryDirectory folder;
    std::filesystem::create_directories(folder / "web");
    test::put(folder / "web/preset.yaml",
              "cuts: [5, 12]\nfiles:\n  - a.ply\n  - \"b, c.ply\"\nkeep: [1, 2]\n");
    PlanSettings settings;
    settings.working_directory = folder.path();
    settings.places.input_base = folder.path();
    Problems problems;
    pipeline::add_preset(folder / "web/preset.yaml", settings, problems);
    CHECK(problems.size() == 0);
    const auto result =
        planned("facetmill: 1\nparams:\n  cuts: {type: list, of: integer, max: 9}\n"
                "  files: {type: list, of: path}\n  keep: integer\n"
                "stages:\n  - foreach: {file: \"${files}\"}\n    do: [{test-load: \"${file}\"}]\n",
                settings);
    CHECK(result.problems.find("preset.yaml:1:11: error[E-RANGE]") != std::string::npos);
    CHECK(result.problems.find("preset.yaml:5:7: error[E-TYPE]: expected an integer, found a list of 2") !=
          std::string::npos);
    CHECK(stages_in(*result.plan.steps.at(0).arms.at(1).steps) ==
          "file=web/b, c.ply/test-load \"web/b, c.ply\"; ");
}

TEST_CASE("a preset gives params that the command line does not", "[pipeline]") {
    const test::TemporaryDirectory folder;
    std::filesystem::create_directories(folder / "web");
    test::put(folder / "web/preset.yaml", "input: scan.ply\nkeep: 20%\n");
    PlanSettings settings;
    settings.working_directory = folder.path();
    settings.places.input_base = folder.path();
    settings.defines = {{"keep", "30%"}};
    Problems problems;
    pipeline::add_preset(folder / "web/preset.yaml", settings, problems);
    CHECK(problems.size() == 0);
    const std::string text =
        "facetmill: 1\nparams: {input: path, keep: ratio}\nstages:\n  - test-load: \"${input}\"\n"
        "  - test-warn: \"${keep}\"\n";
    const auto result = planned(text, settings);
    CHECK(result.problems == "");
    CHECK(stages_in(result.plan.steps) == "test-load web/scan.ply; test-warn 30%; ");

    test::put(folder / "web/wrong.yaml", "keep: 200\nkep: 1\nlist: {a: 1}\n");
    PlanSettings wrong;
    pipeline::add_preset(folder / "web/wrong.yaml", wrong, problems);
    CHECK(render(problems.all().at(0))
              .find("wrong.yaml:3:7: error[E-TYPE]: a param is a value or a list of them") !=
          std::string::npos);
    const std::string found = planned(text, wrong).problems;
    CHECK(found.find("wrong.yaml:2:6: error[E-PARAM]: the pipeline has no param 'kep'") != found.npos);
}
