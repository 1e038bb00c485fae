#include "support/catch.hpp"

#include "facetmill_version.hpp"
#include "pipeline/expressions.hpp"
#include "pipeline/planner.hpp"
#include "support/planning.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

using namespace facetmill;
using pipeline::PlanSettings;
using pipeline::Step;
using pipeline::Steps;

namespace {

/// "name=stage: options" of every stage, arms in parentheses.
std::string outline(const Steps& steps) {
    std::string out;
    for (const auto& step : steps) {
        out += out.empty() ? "" : "; ";
        if (step.kind == Step::Kind::stage) {
            out += step.name + (step.given.is_null() ? "" : " " + pipeline::emit_flow(step.given));
            continue;
        }
        for (const auto& arm : step.arms) out += "(" + arm.name + ": " + outline(*arm.steps) + ")";
    }
    return out;
}

std::string outline_of(const std::string& text, PlanSettings settings = {}) {
    const Planned result = planned(text, std::move(settings));
    return result.problems.empty() ? outline(result.plan.steps) : result.problems;
}

std::string stages(const std::string& items) {
    return "facetmill: 1\nstages:\n  - test-load: a.ply\n" + items;
}

} // namespace

TEST_CASE("what is wrong with a pipeline is said with its place and a hint", "[pipeline]") {
    struct Case {
        std::string text, problem;
    };
    const Case cases[] = {
        {"stages:\n  - test-load: a.ply\n",
         "p.yaml:1:1: error[E-FORMAT-VERSION]: the pipeline does not state its format\n"
         "  stages:\n"
         "  ^\n"
         "  hint: begin with: facetmill: 1"},
        {"facetmill: 2\nstages: [test-load: a]\n",
         "p.yaml:1:12: error[E-FORMAT-VERSION]: facetmill " FACETMILL_VERSION " reads format 1, found '2'\n"
         "  facetmill: 2\n"
         "             ^\n"
         "  hint: a newer facetmill may read it"},
        {"facetmill: 1\nrequires: \">=99\"\nstages: [test-load: a]\n",
         "p.yaml:2:11: error[E-REQUIRES]: the pipeline requires facetmill >=99, this is " FACETMILL_VERSION
         "\n"
         "  requires: \">=99\"\n"
         "            ^~~~~~"},
        {"facetmill: 1\nstage: []\nstages: [test-load: a]\n",
         "p.yaml:2:1: error[E-KEY]: a pipeline has no key 'stage'\n"
         "  stage: []\n"
         "  ^~~~~\n"
         "  hint: did you mean 'stages'?; names of your own keys begin with x-"},
        {"- a\n",
         "p.yaml:1:1: error[E-TYPE]: a pipeline is a map with facetmill and stages, found a list of 1\n"
         "  - a\n"
         "  ^\n"
         "  hint: facetmill: 1\n    stages:\n      - load: scan.ply"},
        {stages("  - test-cot: 3\n"), "p.yaml:4:5: error[E-STAGE]: there is no stage 'test-cot'\n"
                                      "    - test-cot: 3\n"
                                      "      ^~~~~~~~\n"
                                      "  hint: did you mean 'test-cut'?"},
        {stages("  - write a.glb\n"), "p.yaml:4:5: error[E-STAGE]: there is no stage 'write a.glb'\n"
                                      "    - write a.glb\n"
                                      "      ^~~~~~~~~~~\n"
                                      "  hint: write a colon and a space after the name: write: a.glb"},
        {stages("  - test-cut:10%\n"), "p.yaml:4:5: error[E-STAGE]: there is no stage 'test-cut:10%'\n"
                                       "    - test-cut:10%\n"
                                       "      ^~~~~~~~~~~~\n"
                                       "  hint: write a colon and a space after the name: test-cut: 10%"},
        {stages("  - decimate: 3\n"),
         "p.yaml:4:5: error[E-STAGE]: there is no stage 'decimate'\n"
         "    - decimate: 3\n"
         "      ^~~~~~~~\n"
         "  hint: 'decimate' is done by simplify here: facetmill stages simplify"},
        {stages("  - orient:\n    if: true\n"), "p.yaml:5:5: error[E-KEY]: 'if' is not a key of an item\n"
                                                "      if: true\n"
                                                "      ^~\n"
                                                "  hint: a condition is written when: ..."},
        {stages("  - write: \"${ out }.ply\"\n"),
         "p.yaml:4:13: error[E-EXPRESSION]: expected ${name} or ${name.property}, found ${ out }\n"
         "    - write: \"${ out }.ply\"\n"
         "              ^~~~~~~~\n"
         "  hint: write ${out}, without blanks"},
        {stages("  - write: \"${a + 1}.ply\"\n"),
         "p.yaml:4:13: error[E-EXPRESSION]: expected ${name} or ${name.property}, found ${a + 1}\n"
         "    - write: \"${a + 1}.ply\"\n"
         "              ^~~~~~~~\n"
         "  hint: an expression cannot calculate: give the result as another param"},
        {stages("  - a.ply: 3\n"), "p.yaml:4:5: error[E-STAGE]: there is no stage 'a.ply'\n"
                                   "    - a.ply: 3\n"
                                   "      ^~~~~\n"
                                   "  hint: load: a.ply reads a file, write: a.ply writes one"},
        {stages("  - test-cut: {faces: 3, capp: true}\n"),
         "p.yaml:4:26: error[E-KEY]: test-cut has no option 'capp'\n"
         "    - test-cut: {faces: 3, capp: true}\n"
         "                           ^~~~\n"
         "  hint: did you mean 'cap'?"},
        {stages("  - test-cut: 3\n    test-warn: W-A\n"),
         "p.yaml:5:5: error[E-STAGE]: two stages in one item: 'test-cut' and 'test-warn'\n"
         "      test-warn: W-A\n"
         "      ^~~~~~~~~\n"
         "  hint: make it two items:\n"
         "    - test-cut: ...\n"
         "    - test-warn: ..."},
        {stages("  - test-cut:\n    cap: true\n"),
         "p.yaml:5:5: error[E-KEY]: 'cap' is not a key of an item\n"
         "      cap: true\n"
         "      ^~~\n"
         "  hint: it is an option of test-cut: write test-cut: {cap: ...}, or indent it more"},
        {stages("  - test-cut: 3\n    ony: a\n"), "p.yaml:5:5: error[E-KEY]: 'ony' is not a key of an item\n"
                                                  "      ony: a\n"
                                                  "      ^~~\n"
                                                  "  hint: did you mean 'only'?"},
        {stages("  - test-cut: three\n"), "p.yaml:4:15: error[E-TYPE]: expected an integer, found 'three'\n"
                                          "    - test-cut: three\n"
                                          "                ^~~~~"},
        {stages("  - test-cut: 101\n"),
         "p.yaml:4:15: error[E-RANGE]: 'faces' must be in the range 1 <= x <= 100, found '101'\n"
         "    - test-cut: 101\n"
         "                ^~~"},
        {stages("  - test-cut: {faces: 3, ratio: 10%}\n"),
         "p.yaml:4:33: error[E-CONFLICT]: test-cut: only one of faces, ratio may be given, found faces and "
         "ratio\n    - test-cut: {faces: 3, ratio: 10%}\n                                  ^~~"},
        {stages("  - test-cut: {depth: 3parsec}\n"),
         "p.yaml:4:23: error[E-TYPE]: expected a length (2, 2mm, 0.5%, 0.5% of part), found '3parsec'\n"
         "    - test-cut: {depth: 3parsec}\n"
         "                        ^~~~~~~\n"
         "  hint: units: um, mm, cm, m, km, in, ft, or %"},
        {stages("  - test-cut: \"${fces}\"\n"),
         "p.yaml:4:16: error[E-VARIABLE]: there is no variable 'fces'\n"
         "    - test-cut: \"${fces}\"\n"
         "                 ^~~~~~~\n"
         "  hint: declare it under params"},
        {stages("  - test-cut: 3\n    name: x\n  - test-cut: 4\n    name: x\n"),
         "p.yaml:7:11: error[E-NAME]: two stages have the name 'x'\n"
         "      name: x\n"
         "            ^\n"
         "  hint: names are unique, so that --set and the report can use them"},
        {stages("  - test-cut: 3\n    ensure: {closd: true}\n"),
         "p.yaml:5:14: error[E-KEY]: ensure has no property 'closd'\n      ensure: {closd: true}\n           "
         "    ^~~~~\n  hint: did you mean 'closed'?"},
        {stages("  - test-cut: 3\n    when: perhaps\n"),
         "p.yaml:5:11: error[E-WHEN]: expected true, false, a comparison or properties, found 'perhaps'\n"
         "      when: perhaps\n"
         "            ^~~~~~~\n"
         "  hint: when: \"${flag}\", when: ${quality} == high, or when: {closed: false}"},
        {"facetmill: 1\nstages:\n  - test-cut: 3\n",
         "p.yaml:3:5: error[E-ORDER]: 'test-cut' needs a scene, but nothing has been loaded before it\n"
         "    - test-cut: 3\n"
         "      ^~~~~~~~\n"
         "  hint: begin with load: FILE"},
        {stages("  - test-write: o.glb\n  - branch:\n      far: [test-write: ./O.glb]\n"),
         "p.yaml:6:25: error[E-DUPLICATE-OUTPUT]: 'o.glb' and 'O.glb' are the same file if case is ignored\n"
         "        far: [test-write: ./O.glb]\n"
         "                          ^~~~~~~\n"
         "  hint: the first is at p.yaml:4:17"},
        {stages("  - foreach: {a: [1, 2], b: [1, 2], c: [1, 2]}\n"
                "    do: [test-write: \"o.${c.index}.glb\"]\n"),
         "p.yaml:5:22: error[E-DUPLICATE-OUTPUT]: 'o.0.glb' is written twice\n"
         "      do: [test-write: \"o.${c.index}.glb\"]\n"
         "                       ^~~~~~~~~~~~~~~~~~\n"
         "  hint: foreach writes it for every value: o.${c.index}.${a.index}.${b.index}.glb"},
        {stages("  - test-write: x/../a.ply\n"),
         "p.yaml:4:17: error[E-OVERWRITE]: 'a.ply' would overwrite an input\n"
         "    - test-write: x/../a.ply\n"
         "                  ^~~~~~~~~~\n"
         "  hint: it is read at p.yaml:3:16; give the output another name"},
        {stages("  - foreach: {lod: [50%, 25%]}\n    do: [test-write: o.glb]\n"),
         "p.yaml:5:22: error[E-DUPLICATE-OUTPUT]: 'o.glb' is written twice\n"
         "      do: [test-write: o.glb]\n"
         "                       ^~~~~\n"
         "  hint: foreach writes it for every value: o.${lod.index}.glb"},
        {stages("  - foreach: {a: [1, 2], b: [1, 2, 3]}\n    do: [test-write: \"out/${a}.glb\"]\n"),
         "p.yaml:5:22: error[E-DUPLICATE-OUTPUT]: 'out/1.glb' is written twice\n"
         "      do: [test-write: \"out/${a}.glb\"]\n"
         "                       ^~~~~~~~~~~~~~\n"
         "  hint: foreach writes it for every value: out/${a}.${b.index}.glb"},
        {stages("  - foreach: {keep: [3, 4, 5]}\n    do: [test-cut: {faces: \"${keep}\", cap: Yes}]\n"),
         "p.yaml:5:44: error[E-TYPE]: expected true or false, found 'Yes'\n"
         "      do: [test-cut: {faces: \"${keep}\", cap: Yes}]\n"
         "                                             ^~~\n"
         "  hint: write true"},
        {stages("  - test-cut: 2k\n"), "p.yaml:4:15: error[E-TYPE]: expected an integer, found '2k'\n"
                                       "    - test-cut: 2k\n"
                                       "                ^~\n"
                                       "  hint: write 2000"},
        {stages("  - test-load: \"-\"\n  - test-load: \"-\"\n"),
         "p.yaml:5:16: error[E-DUPLICATE-INPUT]: standard input can be read only once\n"
         "    - test-load: \"-\"\n"
         "                 ^~~\n"
         "  hint: the first is at p.yaml:4:16"},
        {stages("  - foreach: {lod: [50%]}\n"),
         "p.yaml:4:5: error[E-MISSING]: foreach needs 'do', the stages for each value\n"
         "    - foreach: {lod: [50%]}\n"
         "      ^~~~~~~\n"
         "  hint: - foreach: {lod: [50%, 25%]}\n"
         "      do: [{simplify: \"${lod}\"}]"},
        {stages("  - branch: [a]\n"),
         "p.yaml:4:13: error[E-TYPE]: branch is a map of names to lists of stages, found a list of 1\n"
         "    - branch: [a]\n"
         "              ^\n"
         "  hint: branch: {near: [write: a.glb], far: [simplify: 10%, write: b.glb]}"},
        {"facetmill: 1\nstages: [test-load: a]\nreport: a.pdf\n",
         "p.yaml:3:9: error[E-REPORT]: a report is .json, .html, .md, .xml (JUnit) or .txt, found 'a.pdf'\n"
         "  report: a.pdf\n"
         "          ^~~~~\n"
         "  hint: give it a suffix: a.html"},
    };
    for (const auto& c : cases) CHECK(planned(c.text).problems == c.problem);
}

TEST_CASE("a mesh in the place of a pipeline is told from one", "[pipeline]") {
    for (const std::string text : {"solid a\nfacet normal 0 0 1\n", "glTF\x02"})
        CHECK(planned(text, {}, "a.stl")
                  .problems.ends_with("hint: is this a mesh? facetmill info a.stl shows its contents, "
                                      "facetmill pipe load a.stl ! ... works on it"));
}

TEST_CASE("all errors are reported at once", "[pipeline]") {
    const auto problems =
        planned(stages("  - test-cot\n  - test-cut: {capp: 1, faces: x}\n  - test-cut: three\n    ony: a\n"
                       "  - test-write\n"))
            .problems;
    for (const char* id :
         {"[E-STAGE]: there is no stage 'test-cot'", "[E-KEY]: test-cut has no option 'capp'",
          "[E-TYPE]: expected an integer, found 'x'", "[E-TYPE]: expected an integer, found 'three'",
          "[E-KEY]: 'ony' is not a key of an item", "[E-MISSING]: test-write: 'path' is needed"})
        CHECK(problems.find(id) != std::string::npos);
}

TEST_CASE("shorthand: bare names, bare values, maps", "[pipeline]") {
    CHECK(outline_of(stages("  - test-cut\n  - test-cut: 5\n  - test-cut: {faces: 7}\n    name: last\n")) ==
          "test-load a.ply; test-cut; test-cut-2 5; last {faces: 7}");
    CHECK(outline_of(stages("  - ensure: {closed: true}\n    name: sound\n")) ==
          "test-load a.ply; sound {closed: true}");
}

TEST_CASE("branch and foreach become arms with names of their own", "[pipeline]") {
    CHECK(
        outline_of(stages(
            "  - branch:\n      near: [test-write: a.glb]\n      far: [test-cut: 2, test-write: b.glb]\n")) ==
        "test-load a.ply; (near: near/test-write a.glb)(far: far/test-cut 2; far/test-write b.glb)");
    CHECK(outline_of(stages("  - foreach: {lod: [50%, 25%], cap: [true, false]}\n"
                            "    do: [{test-cut: {ratio: \"${lod}\", cap: \"${cap}\"}}, {test-write: "
                            "\"o.${lod.index}.${cap}\"}]\n")) ==
          "test-load a.ply; "
          "(lod=50%,cap=true: lod=50%,cap=true/test-cut {ratio: 50%, cap: true}; lod=50%,cap=true/test-write "
          "o.0.true)"
          "(lod=50%,cap=false: lod=50%,cap=false/test-cut {ratio: 50%, cap: false}; "
          "lod=50%,cap=false/test-write o.0.false)"
          "(lod=25%,cap=true: lod=25%,cap=true/test-cut {ratio: 25%, cap: true}; lod=25%,cap=true/test-write "
          "o.1.true)"
          "(lod=25%,cap=false: lod=25%,cap=false/test-cut {ratio: 25%, cap: false}; "
          "lod=25%,cap=false/test-write o.1.false)");
}

TEST_CASE("a foreach over parts is checked before the parts are known, and planned when they are",
          "[pipeline]") {
    const auto result =
        planned(stages("  - foreach: {part: \"*\"}\n    do: [{test-write: \"o/${part}.glb\"}]\n"));
    REQUIRE(result.problems.empty());
    REQUIRE(result.plan.steps.at(1).arms_of_parts);
    Problems problems;
    const auto arms = result.plan.steps[1].arms_of_parts({"left wheel", "a/b"}, problems);
    REQUIRE(arms.size() == 2);
    CHECK(outline(*arms[0].steps) == "part=left_wheel/test-write o/left_wheel.glb");
    CHECK(outline(*arms[1].steps) == "part=a_b/test-write o/a_b.glb");
    CHECK(planned(stages("  - foreach: {part: \"*\"}\n    do: [{test-wite: \"${part}.glb\"}]\n"))
              .problems.find("did you mean 'test-write'?") != std::string::npos);
}

TEST_CASE("when is decided at plan time where it can be", "[pipeline]") {
    const auto known = [](const std::string& when) {
        const auto result = planned("facetmill: 1\nparams:\n  q: {type: text, default: high}\n  n: {type: "
                                    "integer, default: 9}\n  on: {type: bool, default: true}\n"
                                    "stages:\n  - test-load: a.ply\n  - test-cut:\n    when: " +
                                    when + "\n");
        INFO(result.problems);
        REQUIRE(result.plan.steps.size() == 2);
        return result.plan.steps[1].when->known;
    };
    CHECK(known("\"${on}\"") == true);
    CHECK(known("false") == false);
    CHECK(known("${q} == high") == true);
    CHECK(known("${q} != high") == false);
    CHECK(known("${n} < 10") == true);
    CHECK(known("${n} >= 9") == true);
    CHECK(known("{closed: true}") == std::nullopt);
}

TEST_CASE("versions in ranges", "[pipeline]") {
    CHECK(pipeline::satisfies("0.3.0", ">=0.3,<2") == true);
    CHECK(pipeline::satisfies("0.10.1", ">=0.9") == true);
    CHECK(pipeline::satisfies("2.0", "<2") == false);
    CHECK(pipeline::satisfies("1.2.3", "1.2.3") == true);
    CHECK(pipeline::satisfies("1.2.3", "=1.2") == false);
    CHECK(pipeline::satisfies("1.2.3", "new") == std::nullopt);
    CHECK(pipeline::satisfies("1.2.3", "") == std::nullopt);
}

TEST_CASE("options are changed with --set, by the name of a step or of a stage", "[pipeline]") {
    const std::string text = stages("  - test-cut: 5\n    name: first\n  - test-cut: {plane: {offset: 1}}\n");
    const auto with = [&](std::vector<std::pair<std::string, std::string>> sets) {
        PlanSettings settings;
        settings.sets = std::move(sets);
        return outline_of(text, settings);
    };
    CHECK(with({{"first.faces", "7"}}) == "test-load a.ply; first {faces: 7}; test-cut {plane: {offset: 1}}");
    CHECK(with({{"test-cut.cap", "true"}}) ==
          "test-load a.ply; first {faces: 5, cap: true}; test-cut {plane: {offset: 1}, cap: true}");
    CHECK(with({{"test-cut.plane.normal", "[1, 0, 0]"}}) ==
          "test-load a.ply; first {faces: 5, plane: {normal: [1, 0, 0]}}; test-cut {plane: {offset: 1, "
          "normal: [1, 0, 0]}}");
    CHECK(with({{"frst.faces", "7"}}) == "--set:1:1: error[E-SET]: the pipeline has no stage 'frst'\n"
                                         "  frst.faces=7\n"
                                         "  ^~~~~~~~~~~~\n"
                                         "  hint: did you mean 'first'?");
    CHECK(with({{"first.face", "7"}}) == "--set:1:1: error[E-KEY]: test-cut has no option 'face'\n"
                                         "  first.face=7\n"
                                         "  ^~~~~~~~~~~~\n"
                                         "  hint: did you mean 'faces'?");
    CHECK(with({{"first.faces", "x"}}) == "--set:1:13: error[E-TYPE]: expected an integer, found 'x'\n"
                                          "  first.faces=x\n"
                                          "              ^");
}

TEST_CASE("inputs that are missing are named at their place", "[pipeline]") {
    const auto result = planned(stages("  - test-load: \"scans/*.ply\"\n"));
    REQUIRE(result.problems.empty());
    const auto missing = missing_inputs(result.plan);
    REQUIRE(missing.size() == 2);
    CHECK(render(missing[0]).starts_with("p.yaml:3:16: error[E-FILE]: there is no file 'a.ply'"));
    CHECK(render(missing[1]) == "p.yaml:4:16: error[E-FILE]: no file matches 'scans/*.ply'\n"
                                "    - test-load: \"scans/*.ply\"\n"
                                "                 ^~~~~~~~~~~~~");
}

TEST_CASE("what a parameter is compared with is read by its type", "[pipeline]") {
    const auto when = [](const std::string& params, const std::string& condition) {
        auto result = planned("facetmill: 1\nparams: {" + params + "}\nstages:\n  - test-load: a.ply\n" +
                              "  - test-cut:\n    when: \"" + condition + "\"\n");
        if (!result.problems.empty()) return result.problems.substr(result.problems.find("error"));
        return std::string(*result.plan.steps[1].when->known ? "true" : "false");
    };
    const std::string choice = "q: {type: choice, choices: [low, high], default: low}";
    CHECK(when(choice, "${q} == low") == "true");
    CHECK(when(choice, "high != ${q}") == "true");
    CHECK(when(choice, "${q} == lo") ==
          "error[E-CHOICE]: 'q' must be one of low, high, found 'lo'\n      when: \"${q} == lo\"\n           "
          "          ^~\n  hint: did you mean 'low'?");
    CHECK(when("n: {type: integer, default: 3}", "${n} == three").find("error[E-TYPE]") == 0);
    for (const char* other : {"${n} => 2", "${n} =< 2"})
        CHECK(when("n: {type: integer, default: 3}", other)
                  .find("hint: the operators are ==, !=, <, <=, > and >=") != std::string::npos);
    CHECK(when("l: {type: length, default: 2mm}", "${l} == 0.2cm") == "true");
    CHECK(
        when("l: {type: length, default: 2mm}", "${l} < 1%").find("error[E-WHEN]: '2mm' is in metres and") ==
        0);
    CHECK(when("r: {type: ratio, default: 50%}", "${r} >= 0.5") == "true");
}

TEST_CASE("a mesh that is missing is not taken for a file of another kind", "[pipeline]") {
    const test::TemporaryDirectory folder;
    const auto hint_of = [&](const std::string& name) {
        const auto missing =
            missing_inputs(planned_stages("  - test-load: " + (folder / name).string() + "\n").plan);
        return missing.at(0).hint;
    };
    test::put(folder / "part.html", "");
    CHECK(hint_of("part.stl").empty());
    CHECK(hint_of("part.step").find("export a mesh") != std::string::npos);
    test::put(folder / "part.stl", "");
    CHECK(hint_of("part.ply") == "did you mean 'part.stl'?");
    CHECK(hint_of("part.step") == "did you mean 'part.stl'?");
    CHECK(hint_of("part.hml") == "did you mean 'part.html'?");
}

TEST_CASE("a condition on a property or a variable as other languages have it says what to write",
          "[pipeline]") {
    const auto hint_of = [](const std::string& condition) {
        const auto result =
            planned("facetmill: 1\nparams: {q: {type: choice, choices: [low, high], default: low}}\n"
                    "stages:\n  - test-load: a.ply\n  - test-cut:\n    when: '" +
                    condition + "'\n");
        const auto at = result.problems.find("hint: ");
        return result.problems.find("E-WHEN") == std::string::npos || at == std::string::npos
                   ? result.problems
                   : result.problems.substr(at + 6);
    };
    CHECK(hint_of("faces > 1000") == "write when: {faces: {min: 1001}}");
    CHECK(hint_of("faces >= 1000") == "write when: {faces: {min: 1000}}");
    CHECK(hint_of("1000 > faces") == "write when: {faces: {max: 999}}");
    CHECK(hint_of("faces == 12") == "write when: {faces: 12}");
    CHECK(hint_of("faces != 12") == "write when: {faces: {min: ..., max: ...}}");
    CHECK(hint_of("area < 2.5") == "write when: {area: {max: 2.5}}");
    CHECK(hint_of("max_extent < 20cm") == "write when: {max_extent: {max: 20cm}}");
    CHECK(hint_of("watertight == false") == "write when: {closed: false}");
    CHECK(hint_of("closed != true") == "write when: {closed: false}");
    CHECK(hint_of("unit == mm") == "write when: {unit: mm}");
    CHECK(hint_of("not closed") == "write when: {closed: false}");
    CHECK(hint_of("closed") == "write when: {closed: true}");
    CHECK(hint_of("faces>1000 && closed==true") ==
          "write when: {faces: {min: 1001}, closed: true}, all of which must hold");
    CHECK(hint_of("faces > 10 and 100 > faces and not closed") ==
          "write when: {faces: {min: 11, max: 99}, closed: false}, all of which must hold");
    CHECK(hint_of("faces > 10 || closed") ==
          "write when: {faces: {min: 11}, closed: true} where all must hold; there is no 'or'");
    CHECK(hint_of("q == high") == "write ${q} == high");
    CHECK(hint_of("${q} == faces").find("E-CHOICE") != std::string::npos); // it is compared as it was
    CHECK(hint_of("1 == 1").empty());
    // Words that only others call properties by may be mere words; and no bound is made up that is refused.
    CHECK(hint_of("points == points").empty());
    CHECK(hint_of("solid != shell").empty());
    CHECK(hint_of("inside_out == true").empty()); // no property has this name
    CHECK(hint_of("points > 10") == "write when: {vertices: {min: 11}}");
    CHECK(hint_of("faces > 1000.5") == "write when: {faces: {min: ..., max: ...}}");
    CHECK(hint_of("max_extent > large") == "write when: {max_extent: {min: ..., max: ...}}");
}

TEST_CASE("a file to write whose name has what other programs replace is warned of", "[pipeline]") {
    const auto warnings = [](const std::string& name) {
        return planned("facetmill: 1\nparams: {scan: {type: path, default: a.ply}}\nstages:\n  - test-load: "
                       "a.ply\n"
                       "  - test-write: \"" +
                       name + "\"\n")
            .problems;
    };
    CHECK(warnings("x-{scan.stem}.glb") == "p.yaml:5:20: warning[W-PLACEHOLDER]: '{scan.stem}' is not an "
                                           "expression, so the file name contains it unchanged\n"
                                           "    - test-write: \"x-{scan.stem}.glb\"\n"
                                           "                     ^~~~~~~~~~~\n"
                                           "  hint: write ${scan.stem}");
    CHECK(warnings("$scan.glb").find("hint: write ${scan}") != std::string::npos);
    CHECK(warnings("@{scan}.glb").find("'@{scan}' is not an expression") != std::string::npos);
    CHECK(
        warnings("{input.stem}.glb")
            .find("hint: an expression is written ${input.stem}, where input is a param or the variable of a "
                  "foreach") != std::string::npos);
    for (const char* name :
         {"${scan.stem}.glb", "{3F25-9a}.glb", "{model}.glb", "a{}.glb", "$5.glb", "a@b.glb", "{"})
        CHECK(warnings(name).empty());
    const auto missing = missing_inputs(planned_stages("  - test-load: \"{input}\"\n").plan);
    CHECK(missing.at(0).hint == "for the value of a param or variable write ${input}");
}

TEST_CASE("plan shows everything resolved", "[pipeline]") {
    const auto result = planned("facetmill: 1\nabout: A test\nparams: {keep: {type: ratio, default: "
                                "10%}}\nstages:\n  - test-load: a.ply\n"
                                "  - test-cut: {ratio: \"${keep}\"}\n    ensure: {closed: true}\n  - branch: "
                                "{near: [test-write: b.glb]}\nreport: r.json\n");
    REQUIRE(result.problems.empty());
    CHECK(describe(result.plan) == "p.yaml: A test\n"
                                   "  keep = 10%\n"
                                   "stages:\n"
                                   "  test-load        test-load: a.ply\n"
                                   "  test-cut         test-cut: {ratio: 10%}  ensure {closed: true}\n"
                                   "  branch\n"
                                   "    near:\n"
                                   "      near/test-write  test-write: b.glb\n"
                                   "reads:\n"
                                   "  a.ply\n"
                                   "writes:\n"
                                   "  b.glb\n"
                                   "  r.json\n");
    const Json json = describe_json(result.plan);
    CHECK(json["stages"][1]["options"].dump() ==
          R"({"ratio":"10%","depth":"1%","cap":false,"method":"fast"})");
    CHECK(json["outputs"].dump() == R"(["b.glb","r.json"])");
    CHECK(json["reports"].dump() == R"(["r.json"])");
}

TEST_CASE("a path given with -D is found from a pipeline that is named without a folder", "[pipeline]") {
    PlanSettings settings;
    settings.defines = {{"input", "x.ply"}};
    settings.working_directory = std::filesystem::current_path();
    CHECK(outline_of("facetmill: 1\nparams: {input: path}\nstages:\n  - test-load: \"${input}\"\n",
                     settings) == "test-load x.ply");
}

TEST_CASE("a param without a value stands for any value, as an option too", "[pipeline]") {
    PlanSettings settings;
    settings.parameters_needed = false;
    CHECK(planned("facetmill: 1\nparams: {input: path}\nstages:\n  - test-load: {file: \"${input}\"}\n",
                  settings)
              .problems.empty());
}

TEST_CASE("a report that the pipeline and the command line ask for is written once", "[pipeline]") {
    PlanSettings settings;
    settings.extra_reports = {"./r.json", "r.html"};
    const auto result =
        planned("facetmill: 1\nstages:\n  - test-load: a.ply\nreport: [r.json, r.txt]\n", settings);
    CHECK(result.problems.empty());
    CHECK(result.plan.reports == std::vector<std::string>{"r.json", "r.txt", "r.html"});
}

TEST_CASE("nested foreach end at a bound", "[pipeline]") {
    std::string items = "  - test-load: a.ply\n", indent = "  ";
    for (int depth = 0; depth < 20; ++depth) {
        items += fmt::format("{}- foreach: {{v{}: [1, 2]}}\n{}  do:\n", indent, depth, indent);
        indent += "    ";
    }
    items += indent + "- test-cut: 3\n";
    const auto result = planned_stages(items);
    CHECK(result.problems.find("E-FOREACH") != std::string::npos);
    CHECK(result.problems.find("more than 50000 stages") != std::string::npos);
    CHECK(result.problems.find("E-FOREACH", result.problems.find("E-FOREACH") + 1) == std::string::npos);
}

TEST_CASE("limits that a param's type does not have, or that nothing meets, are refused", "[pipeline]") {
    const auto problem = [](const std::string& param) {
        const std::string all =
            planned("facetmill: 1\nparams: {q: " + param + "}\nstages:\n  - test-load: a.ply\n").problems;
        return all.substr(0, all.find('\n'));
    };
    CHECK(problem("{type: number, choices: [1, 2], default: 1}") ==
          "p.yaml:2:28: error[E-PARAM]: 'q' has choices, but its type is not choice");
    CHECK(problem("{type: text, min: 2, default: a}") ==
          "p.yaml:2:26: error[E-PARAM]: values of 'q' have no order, so min cannot limit them");
    CHECK(problem("{type: integer, min: 5, max: 2, default: 3}") ==
          "p.yaml:2:29: error[E-PARAM]: no value of 'q' is between 5 and 2");
    CHECK(problem("{type: integer, min: 2, max: 5, default: 3}") == "");
}

TEST_CASE("limits of written files need a write before them", "[pipeline]") {
    const auto problem = [](const std::string& stages) {
        const std::string all = planned("facetmill: 1\nstages:\n  - load: a.ply\n" + stages).problems;
        return all.substr(0, all.find('\n'));
    };
    const std::string check = "  - validate: {closed: true, limits: {bytes: 1kB}}\n",
                      refusal =
                          "error[E-LIMITS]: validate: 'limits.bytes' limits written files, and no file is "
                          "written before it";
    CHECK(problem(check) == "p.yaml:4:46: " + refusal);
    CHECK(problem("  - write: b.ply\n" + check) == "");
    CHECK(problem("  - validate: {limits: {parts: 1}}\n") == "");
    CHECK(problem("  - write: b.ply\n    when: false\n" + check) == "p.yaml:6:46: " + refusal);
    CHECK(problem("  - branch: {near: [{write: b.ply}], far: [{simplify: 10%}]}\n" + check) == "");
    CHECK(problem("  - branch: {near: [{write: b.ply}], far: [{validate: {limits: {bytes: 1kB}}}]}\n")
              .find(refusal) != std::string::npos);
    CHECK(problem("  - foreach: {lod: [50%]}\n    do: [{simplify: \"${lod}\"}, {write: b.ply}, {validate: "
                  "{limits: {draw_calls: 1}}}]\n") == "");
}

TEST_CASE("items and keys that say nothing are refused with their place", "[pipeline]") {
    CHECK(planned("facetmill: 1\nstages:\n  - test-load: a.ply\n  -\n")
              .problems.find("p.yaml:4:3: error[E-TYPE]") == 0);
    CHECK(planned(stages("  - test-cut: 3\n    only: []\n")).problems.find("p.yaml:5:11: error[E-MISSING]") ==
          0);
    const auto problems = planned(stages("  - branch: {a: [test-cut: 3]}\n    joined: true\n")).problems;
    CHECK(problems.find("did you mean 'join'?") != std::string::npos);
}

TEST_CASE("a parameter is given once", "[pipeline]") {
    PlanSettings settings;
    settings.defines = {{"keep", "2"}, {"keep", "3"}};
    const auto result = planned("facetmill: 1\nparams: {keep: integer}\n"
                                "stages: [{test-load: a.ply}, {test-cut: \"${keep}\"}]\n",
                                settings);
    CHECK(result.problems == "-D:1:1: error[E-PARAM]: the param 'keep' is given twice\n"
                             "  keep=3\n"
                             "  ^~~~~~\n"
                             "  hint: it was '2' before; leave one out");
}

TEST_CASE("a plan that leaves nothing behind is known", "[pipeline]") {
    const auto warned = [](const std::string& text) {
        return pipeline::without_effect(planned(text).plan).has_value();
    };
    CHECK(warned(stages("  - test-cut: 5\n")));
    CHECK(warned(stages("  - branch: {a: [test-cut: 5]}\n")));
    CHECK_FALSE(warned(stages("  - branch: {a: [test-cut: 5, test-write: b.ply]}\n")));
    CHECK_FALSE(warned(stages("  - test-cut: 5\n    ensure: {closed: true}\n")));
    CHECK_FALSE(warned(stages("  - ensure: {closed: true}\n")));
    CHECK_FALSE(warned(stages("  - test-cut: 5\nreport: r.json\n")));
    CHECK_FALSE(warned(stages("  - test-cut: 5\nallow: W-NOTHING\n")));
}

TEST_CASE("a diagnostic names the input unless it does already", "[pipeline]") {
    const auto told = [](const std::string& text, const std::string& message) {
        return pipeline::about_input(pipeline::inputs_of_steps(planned(text).plan),
                                     {Severity::warning, "W-X", message, {}, {}})
            .message;
    };
    CHECK(told(stages(""), "flat") == "a.ply: flat");
    CHECK(told(stages(""), "'a.ply' is flat") == "'a.ply' is flat");
    CHECK(told(stages("  - test-load: b.ply\n"), "flat") == "a.ply and 1 more: flat");
    CHECK(told(stages("  - test-load: b.ply\n"), "b.ply: flat") == "b.ply: flat");
    CHECK(told("facetmill: 1\nstages: [{test-load: \"-\"}]\n", "flat") == "standard input: flat");
    const auto placed = [](const std::string& file) {
        return pipeline::about_input({"scan"}, {Severity::error, "E-X", "flat", file_mark(file), {}}).message;
    };
    CHECK(placed("scan") == "flat");
    CHECK(placed("scan.yaml") == "scan: flat");
}

namespace {

/// The arms of a foreach over the param `lods`, or the error.
std::string arms_of(const std::string& param, PlanSettings settings = {}) {
    return outline_of(
        "facetmill: 1\nparams: {lods: " + param +
            "}\nstages:\n  - test-load: a.ply\n  - foreach: {lod: \"${lods}\"}\n    do: [test-cut: "
            "\"${lod}\"]\n",
        std::move(settings));
}

PlanSettings defining(std::string text) {
    PlanSettings settings;
    settings.defines = {{"lods", std::move(text)}};
    return settings;
}

} // namespace

TEST_CASE("a param may be a list, which foreach runs over", "[pipeline]") {
    const std::string wanted = "test-load a.ply; (lod=5: lod=5/test-cut 5)(lod=3: lod=3/test-cut 3)";
    CHECK(arms_of("{type: list, of: integer, default: [5, 3]}") == wanted);
    for (const char* text : {"5,3", "5, 3", "[5, 3]", "[ 5,3 ]"}) {
        CAPTURE(text);
        CHECK(arms_of("{type: list, default: [1]}", defining(text)) == wanted);
    }
    CHECK(arms_of("{type: list, of: integer, default: 5}") == "test-load a.ply; (lod=5: lod=5/test-cut 5)");
    CHECK(
        outline_of("facetmill: 1\nparams: {only: {type: list, default: [\"tree*\", \"!tree_9\"]}}\nstages:\n"
                   "  - test-load: a.ply\n  - test-cut: 3\n    only: \"${only}\"\n") ==
        "test-load a.ply; test-cut 3");
}

TEST_CASE("each value of a list has a type, and its own place in messages", "[pipeline]") {
    const auto problem = [](const std::string& param, PlanSettings settings = {}) {
        const std::string all = arms_of(param, std::move(settings));
        return all.substr(0, all.find("\n  hint"));
    };
    CHECK(problem("{type: list, of: integer, max: 9, default: 1}", defining("5,12")) ==
          "-D:1:8: error[E-RANGE]: the param 'lods' must be at most 9, found '12'\n"
          "  lods=5,12\n"
          "         ^~");
    for (const auto& [text, place] :
         {std::pair("12,2", "-D:1:9: "), {"[12, 2]", "-D:1:11: "}, {"12,  2", "-D:1:11: "}})
        CHECK(problem("{type: list, of: integer, min: 3, default: 5}", defining(text)).starts_with(place));
    CHECK(problem("{type: list, of: integer, default: [5, x]}") ==
          "p.yaml:2:55: error[E-TYPE]: expected an integer, found 'x'\n"
          "  params: {lods: {type: list, of: integer, default: [5, x]}}\n"
          "                                                        ^");
    CHECK(problem("{type: list, of: choice, choices: [5, 3], default: [5]}", defining("5,4"))
              .find("E-CHOICE]: 'lods' must be one of 5, 3, found '4'") != std::string::npos);
    CHECK(problem("{type: integer, of: ratio, default: 5}").find("E-PARAM") != std::string::npos);
    CHECK(problem("{type: list, of: text, default: 5}").find("expected an integer, found the text \"5\"") !=
          std::string::npos);
    CHECK(problem("{type: list, min: 2, default: 5}").find("have no order, so min cannot limit them") !=
          std::string::npos);
    CHECK(problem("{type: list, of: list, default: 5}").find("E-CHOICE") != std::string::npos);
    CHECK(problem("{type: list, default: {a: 1}}").find("expected a list ([a, b]), found a map") !=
          std::string::npos);
    CHECK(problem("{type: list, default: [[1]]}").find("E-TYPE") != std::string::npos);
    CHECK(problem("{type: list, default: 5}", defining("[1, ${x}]")).find("error[E-UNQUOTED]") !=
          std::string::npos);
    CHECK(problem("{type: list, default: []}").find("E-FOREACH") != std::string::npos);
}

TEST_CASE("a list is not compared, and stands in no text", "[pipeline]") {
    const auto with = [](const std::string& items) {
        return planned(
                   "facetmill: 1\nparams: {a: {type: list, default: [1]}}\nstages:\n  - test-load: a.ply\n" +
                   items)
            .problems;
    };
    const std::string compared = with("  - test-cut: 3\n    when: ${a} == 1\n");
    CHECK(compared.find("E-WHEN]: 'a' is a list, which cannot be compared") != std::string::npos);
    CHECK(compared.find("error[", compared.find("error[") + 1) == std::string::npos);
    CHECK(with("  - test-write: \"${a}.ply\"\n").find("cannot be used inside a text") != std::string::npos);
}
