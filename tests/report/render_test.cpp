#include "support/catch.hpp"

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "facetmill_version.hpp"
#include "mesh/shapes.hpp"
#include "report/check_text.hpp"
#include "report/render.hpp"
#include "report/svg.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <cstdlib>
#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::report;

namespace {

Scene cube_scene() {
    Scene scene;
    Part part;
    part.name = "cube";
    part.mesh = shapes::uv_cube();
    scene.parts.push_back(std::move(part));
    scene.materials.resize(1);
    scene.materials[0].name = "steel";
    return scene;
}

/// A record with something everywhere.
RunRecord full_record() {
    RunRecord record;
    record.pipeline = "p.yaml";
    record.about = "Mills <cubes> & more";
    record.params = {{"keep", "10%"}};
    record.inputs = {{"a.ply", 1234, std::string(64, 'a'), {}}};
    record.outputs = {{"b.glb", 56789, std::string(64, 'b'), {{"faces", 12}}}};
    StageRecord cut;
    cut.name = "cut";
    cut.stage = "clip";
    cut.path = "stages[0]";
    cut.before = Brief{.parts = 1, .vertices = 8, .faces = 1200, .bounds = {{0, 0, 0}, {1, 1, 1}}};
    cut.after = Brief{.parts = 1, .vertices = 8, .faces = 12, .bounds = {{0, 0, 0}, {1, 1, 1}}};
    cut.attribute_changes = {
        {"cube", {"NORMAL", Domain::wedge, AttributeChange::Kind::dropped, "the format has none"}}};
    cut.warnings = {{Severity::warning, "W-CAP", "one loop stays open", file_mark("p.yaml"), "close it"}};
    cut.resolved = {{"depth", "1%", 0.01}};
    cut.options = {{"plane", {{"normal", {0, 0, 1}}}}, {"cap", true}};
    cut.result = {{"area", 2.5}, {"caps", {{{"loops", 1234}}, {{"open", "<b>"}}}}};
    cut.said = {"1 cap & no more"};
    cut.seconds = 0.25;
    StageRecord skipped;
    skipped.name = skipped.stage = "relax";
    skipped.path = "stages[1]";
    skipped.skipped = true;
    record.stages = {cut, skipped};
    record.checks = {
        {.name = "closed", .stage = "validate", .expected = "true", .found = true},
        {.name = "euler",
         .stage = "validate",
         .passed = false,
         .expected = "2",
         .found = 0,
         .hint = "clean fills holes",
         .part = "cube",
         .evidence =
             CheckEvidence{{.of = EvidenceEntry::Of::part, .name = "cube", .at = Vec3{1, 2.5, 3}, .face = 3}},
         .where = file_mark("p.yaml")},
        {.name = "area",
         .stage = "validate",
         .passed = false,
         .severity = Severity::warning,
         .expected = "at most 5",
         .found = 6},
        {.name = "oriented",
         .stage = "validate",
         .expected = "true",
         .found = false,
         .part = "cube",
         .evidence =
             CheckEvidence{{.of = EvidenceEntry::Of::part, .name = "cube", .at = Vec3{0, 0, 1}, .face = 4}},
         .locations = 12,
         .waived = true}};
    record.errors = {
        {{Severity::error, "E-CHECK", "'euler' must be 2, found 0", file_mark("p.yaml"), ""}, true},
        {{Severity::error, "E-WRITE", "the disk is full", {}, "make room"}}};
    record.exit_code = 4;
    record.seconds = 1.5;
    record.peak_memory = 123456789;
    record.threads = 2;
    const Scene scene = cube_scene();
    record.final_properties = scene_json(scene, inspect(scene));
    return record;
}

/// Validates documents by schemas with python's jsonschema. If it is missing, the test says so, and fails if
/// it is required.
void validate(const std::vector<std::pair<Json, Json>>& schemas_and_documents) {
    if (std::system("python3 -c 'import jsonschema' 2>/dev/null") != 0) {
        if (std::getenv("FACETMILL_REQUIRE_VALIDATOR")) FAIL("python3 has no jsonschema");
        WARN("skipped: python3 has no jsonschema");
        return;
    }
    test::TemporaryDirectory directory;
    Json pairs = Json::array();
    for (const auto& [schema, document] : schemas_and_documents) pairs.push_back({schema, document});
    test::put(directory / "pairs.json", pairs.dump());
    test::put(directory / "validate.py", "import json, jsonschema, sys\n"
                                         "for schema, document in json.load(open(sys.argv[1])):\n"
                                         "    jsonschema.Draft202012Validator.check_schema(schema)\n"
                                         "    jsonschema.Draft202012Validator(schema).validate(document)\n");
    const auto command = fmt::format("python3 '{}' '{}'", (directory / "validate.py").string(),
                                     (directory / "pairs.json").string());
    CHECK(std::system(command.c_str()) == 0);
}

} // namespace

TEST_CASE("reports and info are valid by their published schemas", "[report]") {
    const Scene scene = cube_scene();
    const auto info = [](const Scene& shown) {
        Json json = {{"file", "a.ply"}, {"error", nullptr}};
        json.update(scene_json(shown, inspect(shown)));
        return json;
    };
    const Json unreadable = {{"file", "a.ply"},
                             {"error", {{"id", "E-PLY"}, {"message", "no"}, {"exit_code", 6}}}};
    validate({{schema(), to_json(full_record())},
              {schema(), to_json(RunRecord{})},
              {info_schema(), info(scene)},
              {info_schema(), info(Scene{})},
              {info_schema(), unreadable}});
}

TEST_CASE("the schema names every key of a report, and nothing else", "[report]") {
    const auto keys = [](const Json& object) {
        std::vector<std::string> names;
        for (const auto& [name, value] : object.items()) names.push_back(name);
        std::sort(names.begin(), names.end());
        return names;
    };
    const Json document = to_json(full_record()), published = schema();
    CHECK(keys(published["properties"]) == keys(document));
    CHECK(keys(published["$defs"]["stage"]["properties"]) == keys(document["stages"][0]));
    CHECK(keys(published["$defs"]["check"]["properties"]) == keys(document["checks"][0]));
    // Quality properties are present only if a check needs them, so the schema does not require them.
    const Json& scene = published["$defs"]["scene"];
    auto always = scene["required"].get<std::vector<std::string>>();
    std::sort(always.begin(), always.end());
    CHECK(always == keys(document["properties"]));
    for (const auto& property : property_table())
        CHECK(scene["properties"].contains(std::string(property.name)));
    CHECK(published["additionalProperties"] == false);
}

TEST_CASE("what varies from run to run is in no report", "[report]") {
    RunRecord slow = full_record();
    slow.seconds = 99;
    slow.peak_memory = 1;
    slow.threads = 64;
    slow.stages[0].seconds = 7;
    for (const char* path : {"r.json", "r.html", "r.xml", "r.txt"})
        CHECK(render_for(path, slow) == render_for(path, full_record()));
    CHECK(render_for("r.html", slow).find("<code>--timings page.html</code> adds") != std::string::npos);
    CHECK(timings_json(slow) != timings_json(full_record()));
    CHECK(timings_json(slow)["stages"][0]["seconds"] == 7);
}

TEST_CASE("the text for people", "[report]") {
    CHECK(to_text(full_record()) ==
          "p.yaml: Mills <cubes> & more\n"
          "  cut       1,200 -> 12 faces\n"
          "              1 cap & no more\n"
          "            warning[W-CAP]: one loop stays open\n"
          "            hint: close it\n"
          "  relax     skipped\n"
          "checks: 1 passed, 1 known, 2 failed\n"
          "  failed euler (validate, part cube): expected 2, found 0; first: face 3 of 'cube' at 1 2.5 3\n"
          "  warned area (validate): expected at most 5, found 6\n"
          "  known oriented (validate, part cube): expected true, found false; 12 locations, first: face "
          "4 of 'cube' at 0 0 1\n"
          "wrote b.glb (56.8 kB)\n"
          "failed: [E-CHECK] 'euler' must be 2, found 0 (and 1 more); exit code 4\n");
    RunRecord good;
    good.pipeline = "p.yaml";
    CHECK(to_text(good) == "p.yaml\nok\n");
}

TEST_CASE("many files of a folder are one line", "[report]") {
    RunRecord record;
    record.pipeline = "p.yaml";
    const auto text = [&](int tiles) {
        record.outputs = {{"out/tileset.json", 2000, "", nullptr}};
        for (int i = 0; i < tiles; ++i)
            record.outputs.push_back({fmt::format("out/tileset/r{}.glb", i), 1000, "", nullptr});
        record.outputs.push_back({"last.glb", 500, "", nullptr});
        return to_text(record);
    };
    CHECK(text(1200) == "p.yaml\n"
                        "wrote out/tileset.json (2.0 kB)\n"
                        "wrote 1,200 files in out/tileset/: r0.glb ... (1.2 MB)\n"
                        "wrote last.glb (500 bytes)\n"
                        "ok\n");
    CHECK(text(3).find("wrote out/tileset/r0.glb (1.0 kB)\n"
                       "wrote out/tileset/r1.glb (1.0 kB)\n"
                       "wrote out/tileset/r2.glb (1.0 kB)\n") != std::string::npos);
}

TEST_CASE("a terminal is not told again of what was told as it arose", "[report]") {
    RunRecord record = full_record();
    record.reports = {"out/r.json"};
    CHECK(to_terminal(record, false).text() ==
          "p.yaml: Mills <cubes> & more\n"
          "  cut       1,200 -> 12 faces                     0.25 s\n"
          "              1 cap & no more\n"
          "  relax     skipped\n"
          "checks: 1 passed, 1 known, 2 failed\n"
          "  known oriented (validate, part cube): expected true, found false; 12 locations, first: face "
          "4 of 'cube' at 0 0 1\n"
          "wrote b.glb (56.8 kB)\n"
          "report out/r.json\n"
          "failed; exit code 4\n");
    RunRecord good;
    good.pipeline = "p.yaml";
    good.seconds = 0.5;
    good.peak_memory = 2'000'000;
    CHECK(to_terminal(good, true).text() ==
          "\033[1mp.yaml\033[0m\n\033[1;32mok\033[0m in 0.50 s, peak memory 2.0 MB\n");
}

TEST_CASE("what stands around in names is no command to a terminal, and colours are", "[report]") {
    RunRecord record = full_record();
    record.pipeline = "\x1b[2Jp.yaml";
    record.about = "mills \x1b]0;title\x07";
    record.reports = {"out/\x1b[8mr.json"};
    record.outputs = {{"\x1b[1Ab.glb", 500, "", {}}};
    record.checks[0].name += "\x1b[31m";
    record.errors = {{Severity::error, "E-X", "of '\x1b[5m'", {}, "", false}};
    for (const std::string& text : {to_terminal(record, false).text(), to_text(record)}) {
        CHECK(text.find('\x1b') == std::string::npos);
        CHECK(text.find('\x07') == std::string::npos);
        CHECK(text.find("wrote ?[1Ab.glb (500 bytes)\n") != std::string::npos);
    }
    const std::string painted = to_terminal(record, true).text();
    CHECK(painted.starts_with("\033[1m?[2Jp.yaml\033[0m: mills ?]0;title?\n"));
    CHECK(painted.find("report out/?[8mr.json\n\033[1;31mfailed\033[0m") != std::string::npos);
}

TEST_CASE("of the lines of a stage one alone is not left out", "[report]") {
    RunRecord record;
    auto& stage = record.stages.emplace_back();
    stage.name = "cut";
    for (int i = 1; i <= 21; ++i) stage.said.push_back(fmt::format("line {}.", i));
    CHECK(to_terminal(record, false).text().find("line 21.\n") != std::string::npos);
    stage.said.push_back("line 22.");
    const std::string text = to_terminal(record, false).text();
    CHECK(text.find("line 20.\n") != std::string::npos);
    CHECK(text.find("line 21.") == std::string::npos);
    CHECK(text.find("and 2 more lines (--report run.txt lists all)\n") != std::string::npos);
}

TEST_CASE("numbers below a chart do not run into each other", "[report]") {
    const auto texts = [](std::vector<std::pair<double, std::string>> ticks) {
        const std::string svg =
            svg_of({.id = "a", .title = "t", .heights = {1, 2}, .ticks = std::move(ticks)});
        std::string all;
        for (auto at = svg.find("<text"); at != svg.npos; at = svg.find("<text", at + 1))
            all += svg.substr(svg.find('>', at) + 1, svg.find("</text>", at) - svg.find('>', at) - 1) + " ";
        return all;
    };
    CHECK(texts({{0, "0.00657"}, {0.5, "0.0156"}, {1, "0.0442"}}) == "0.00657 0.0156 0.0442 ");
    CHECK(texts({{0, "0.00657"}, {0.18, "0.00929"}, {0.45, "0.0156"}, {1, "0.0442"}}) ==
          "0.00657 0.0156 0.0442 ");
    CHECK(texts({{0, "1"}, {0.86, "0.00929"}, {1, "0.0442"}}) == "1 0.0442 "); // that at the end is kept
    CHECK(texts({}).empty());
}

TEST_CASE("JUnit: checks and errors are cases", "[report]") {
    CHECK(to_junit(full_record()) == "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                                     "<testsuites>\n"
                                     "  <testsuite name=\"p.yaml\" tests=\"5\" failures=\"1\" errors=\"1\">\n"
                                     "    <testcase classname=\"validate\" name=\"closed\"/>\n"
                                     "    <testcase classname=\"validate\" name=\"euler [cube]\">\n"
                                     "      <failure message=\"expected 2, found 0; first: face 3 of "
                                     "&#39;cube&#39; at 1 2.5 3\">p.yaml</failure>\n"
                                     "    </testcase>\n"
                                     "    <testcase classname=\"validate\" name=\"area\">\n"
                                     "      <system-out>warning: expected at most 5, found 6</system-out>\n"
                                     "    </testcase>\n"
                                     "    <testcase classname=\"validate\" name=\"oriented [cube]\">\n"
                                     "      <system-out>known: expected true, found false; 12 locations, "
                                     "first: face 4 of &#39;cube&#39; at 0 0 1</system-out>\n"
                                     "    </testcase>\n"
                                     "    <testcase classname=\"run\" name=\"E-WRITE\">\n"
                                     "      <error message=\"the disk is full\"></error>\n"
                                     "    </testcase>\n"
                                     "  </testsuite>\n"
                                     "</testsuites>\n");
}

TEST_CASE("Markdown for the description of a change", "[report]") {
    CHECK(to_markdown(full_record()) ==
          "## p.yaml\n\nMills &lt;cubes&gt; &amp; more\n\n"
          "**failed with exit code 4**, 2 of 4 checks passed\n\n"
          "### At a glance\n\n|  | inputs | outputs | ratio |\n| --- | --- | --- | --- |\n"
          "| faces | 12 | 12 | 100 % |\n| bytes | 1.2 kB | 56.8 kB | 4,600 % |\n\n"
          "### Errors and warnings\n\n"
          "| kind | id | message | hint |\n| --- | --- | --- | --- |\n"
          "| error | E-WRITE | the disk is full | make room |\n"
          "| warning | W-CAP | one loop stays open | close it |\n\n"
          "### Failed checks\n\n"
          "| outcome | property | expected | found | locations | hint |\n"
          "| --- | --- | --- | --- | --- | --- |\n"
          "| failed | euler | 2 | 0 | first: face 3 of &#39;cube&#39; at 1 2.5 3 "
          "| clean fills holes |\n"
          "| warned | area | at most 5 | 6 |  |  |\n"
          "| known | oriented | true | false | 12 locations, first: face 4 of "
          "&#39;cube&#39; at 0 0 1 |  |\n\n"
          "### Stages\n\n| stage | faces before | faces after | notes |\n"
          "| --- | --- | --- | --- |\n"
          "| cut | 1,200 | 12 | 1 cap &amp; no more |\n"
          "| relax |  |  | skipped |\n\n"
          "### Outputs\n\n| file | size | SHA-256 |\n| --- | --- | --- |\n"
          "| b.glb | 56.8 kB | bbbbbbbbbbbb |\n\nfacetmill " FACETMILL_VERSION "\n");
}

TEST_CASE("HTML is one page that escapes what others wrote", "[report]") {
    const std::string html = to_html(full_record());
    CHECK(html.starts_with("<!DOCTYPE html>"));
    CHECK(html.find("Mills &lt;cubes&gt; &amp; more") != std::string::npos);
    CHECK(html.find("<cubes>") == std::string::npos);
    CHECK(html.find("src=") == std::string::npos); // nothing is fetched
    auto record = full_record();
    record.stages[0].picture = "iVBORw0KGgo=";
    const std::string shown = to_html(record);
    CHECK(shown.find("<img alt=\"" + record.stages[0].name + ": ") != std::string::npos);
    CHECK(shown.find("src=\"data:image/png;base64,iVBORw0KGgo=\"") == shown.find("src="));
    CHECK(html.find("href=") == std::string::npos);
    CHECK(html.find("prefers-color-scheme: dark") != std::string::npos);
}

TEST_CASE("the page tells what the terminal tells of a stage, its options and its result", "[report]") {
    const std::string html = to_html(full_record());
    CHECK(html.find("<h3>cut <code>clip</code></h3>\n<p>1,200 &rarr; 12 faces (1 %), 8 vertices</p>") !=
          std::string::npos);
    CHECK(html.find("<p>1 cap &amp; no more</p>") != std::string::npos);
    CHECK(html.find("<tr><td><code>plane.normal</code></td><td>[0, 0, 1]</td></tr>") != std::string::npos);
    CHECK(html.find("<tr><td><code>depth</code></td><td>1% = 0.01</td></tr>") != std::string::npos);
    CHECK(html.find("<tr><td><code>area</code></td><td>2.5</td></tr>") != std::string::npos);
    CHECK(html.find("<tr><th>loops</th><th>open</th></tr>\n<tr><td>1,234</td><td></td></tr>\n"
                    "<tr><td></td><td>&lt;b&gt;</td></tr>") != std::string::npos);
    CHECK(html.find("<h3>relax </h3>\n<p>skipped") != std::string::npos);
}

TEST_CASE("pictures that one camera took are compared by a slider", "[report]") {
    RunRecord record;
    for (const char* name : {"load", "clip", "transform"}) {
        auto& stage = record.stages.emplace_back();
        stage.name = stage.stage = name;
        stage.picture = "iVBORw0KGgo=";
        stage.camera = 1;
    }
    record.stages[2].camera = 2;
    const std::string html = to_html(record);
    CHECK(html.find("data-of=\"picture-0\"") != std::string::npos);
    CHECK(html.find("data-of=\"picture-1\"") == std::string::npos);
    CHECK(html.find("clip: 0 faces; left of the slider: after load") != std::string::npos);
}

TEST_CASE("a check that did not hold has its picture, its places and commands", "[report]") {
    RunRecord record;
    record.inputs = {{"a b.ply", 1, "", {}}};
    record.command = "facetmill run 'my pipe.yaml'";
    auto& check = record.checks.emplace_back();
    check.name = "closed";
    check.stage = "validate";
    check.expected = "true";
    check.picture = "iVBORw0KGgo=";
    check.evidence = CheckEvidence{{.of = EvidenceEntry::Of::part, .name = "a", .at = Vec3{1, 2.5, -3}},
                                   {.of = EvidenceEntry::Of::part, .name = "b", .amount = 2}};
    CHECK(failing_locations(check).empty());
    CHECK(to_html(record).find("Failed checks") == std::string::npos);
    check.passed = false;
    CHECK(failing_locations(check) == std::vector<Vec3>{{1, 2.5, -3}});
    CHECK(to_html(record).find("<dt>try</dt>") == std::string::npos); // there is no hint
    check.hint = "clean fills holes";
    CHECK(to_html(record).find("all locations where &#39;closed&#39; fails") != std::string::npos);
    check.locations = 1234;
    const std::string html = to_html(record);
    CHECK(html.find("<dt>try</dt>") != std::string::npos);
    CHECK(html.find("the first 1 of 1,234 locations where &#39;closed&#39; fails") != std::string::npos);
    CHECK(html.find("<li>and 1,232 more</li>") != std::string::npos);
    CHECK(html.find(
              "facetmill pipe load &#39;a b.ply&#39; ! clean --holes minimal ! orient ! validate --closed "
              "true</pre>") != std::string::npos);
    CHECK(html.find("facetmill run &#39;my pipe.yaml&#39;</pre>") != std::string::npos);
    CHECK(html.find("<li>part &#39;b&#39; 2</li>") != std::string::npos);
}

TEST_CASE("the margin of a check says on which side of the limit the value is", "[report]") {
    Check check{.found = std::int64_t{3}, .max = 5};
    CHECK(margin_text(check) == "2 below the limit (by 40 %)");
    check.found = std::int64_t{9};
    CHECK(margin_text(check) == "4 too many (80 % above the limit)");
    check.found = std::int64_t{1234567};
    CHECK(margin_text(check) == "1,234,562 too many"); // a percentage beyond 999 is left out
    check.found = std::int64_t{9};
    check.min = check.max = 10;
    CHECK(margin_text(check) == "1 too few (10 % below the limit)");
    check.found = 0.5;
    CHECK(margin_text(check) == "9.5 too little (95 % below the limit)");
    check.max = 0.25;
    check.min = {};
    CHECK(margin_text(check) == "0.25 too much (100 % above the limit)");
    check.found = 0.25;
    CHECK(margin_text(check) == "exactly at the limit");
    check = {.found = std::int64_t{3624}, .min = 1};
    CHECK(margin_text(check) == "3,623 above the limit");
    check.max = 3634;
    CHECK(margin_text(check).starts_with("10 below the limit (by "));
    check.found = true;
    CHECK(margin_text(check).empty());
}

TEST_CASE("a page says what was left out of it, and times only when asked", "[report]") {
    RunRecord record = full_record();
    record.pictures_left_out = 2;
    record.text = "stages:\n  - load: <x>";
    std::string html = to_html(record);
    CHECK(html.find("2 pictures are left out") != std::string::npos);
    CHECK(html.find("load: &lt;x&gt;") != std::string::npos);
    CHECK(html.find("Time and memory") == std::string::npos);
    record.stages[0].peak_memory = 5000000;
    html = to_html_with_times(record);
    CHECK(html.find("<td>cut</td><td class=\"number\">0.25 s</td><td class=\"number\">16.7 %</td>") !=
          std::string::npos);
    CHECK(html.find("5.0 MB") != std::string::npos);
}

TEST_CASE("a report's suffix chooses its form", "[report]") {
    CHECK(Json::parse(render_for("a/b.json", {}))["format"] == 1);
    CHECK(render_for("b.xml", {}).starts_with("<?xml"));
    CHECK(test::failure([] { render_for("b.pdf", {}); }) ==
          "usage [E-REPORT] a report is .json, .html, .md, .xml (JUnit) or .txt, found 'b.pdf' | give it a "
          "suffix: b.html");
}

TEST_CASE("bytes that are no UTF-8 do not break a report", "[report]") {
    RunRecord record;
    record.about = "\xFF";
    CHECK_NOTHROW(render_for("r.json", record));
}

TEST_CASE("numbers for people", "[report]") {
    CHECK(grouped(0) == "0");
    CHECK(grouped(1234567) == "1,234,567");
    CHECK(grouped(999) == "999");
    CHECK(sized(999) == "999 bytes");
    CHECK(sized(999'990) == "1.0 MB");
    CHECK(sized(12'345) == "12.3 kB");
    CHECK(timed(0.1234) == "0.12 s");
    CHECK(timed(125) == "2 min 05 s");
    CHECK(escaped("<a b='c'>&\x01") == "&lt;a b=&#39;c&#39;&gt;&amp;\xEF\xBF\xBD");
}
