#include "cli/pipe_syntax.hpp"

#include "pipeline/document.hpp"
#include "support/catch.hpp"

using namespace facetmill;

namespace {

/// The YAML for a one-liner, or its error messages.
std::string yaml(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "pipe");
    const cli::CommandLine line(std::move(arguments));
    Problems problems;
    const Value document = cli::parse_pipe(line, 1, problems);
    if (problems.size() == 0) return pipeline::emit_yaml(*document.find("stages"));
    std::string text;
    for (const auto& d : problems.all()) text += render(d) + "\n";
    return text;
}

/// The same from a line without quotes.
std::string yaml(const std::string& line) {
    std::vector<std::string> arguments;
    std::istringstream words(line);
    for (std::string word; words >> word;) arguments.push_back(word);
    return yaml(arguments);
}

/// Whether the one-liner and the YAML are the same stages.
bool same_stages(const std::string& line, const std::string& text) {
    std::vector<std::string> arguments{"pipe"};
    std::istringstream words(line);
    for (std::string word; words >> word;) arguments.push_back(word);
    const cli::CommandLine command(arguments);
    Problems problems;
    const Value document = cli::parse_pipe(command, 1, problems);
    const Value expected =
        pipeline::parse_yaml(std::make_shared<const SourceText>(SourceText{"expected", text}), problems);
    for (const auto& d : problems.all()) UNSCOPED_INFO(render(d));
    UNSCOPED_INFO(pipeline::emit_yaml(*document.find("stages")));
    return problems.size() == 0 && same_content(*document.find("stages"), expected);
}

} // namespace

TEST_CASE("bare values, options and separators become steps", "[cli]") {
    CHECK(same_stages("load a.stl ! relax 3 ! write a.glb", "[{load: a.stl}, {relax: 3}, {write: a.glb}]"));
    CHECK(same_stages("load a.stl + relax", "[{load: a.stl}, {relax: null}]"));
    CHECK(same_stages("relax 3 --lambda 0.5", "[{relax: {lambda: 0.5, iterations: 3}}]"));
    CHECK(same_stages("relax --lambda=0.5", "[{relax: {lambda: 0.5}}]"));
}

TEST_CASE("values may begin with a dash", "[cli]") {
    CHECK(same_stages("load - ! relax --lambda -0.5", "[{load: '-'}, {relax: {lambda: -0.5}}]"));
    CHECK(same_stages("thicken -- -2mm ! load -- --a.stl",
                      "[{thicken: -2mm}, {load: '--a.stl'}]")); // as in a shell
    CHECK(same_stages("transform --translate -- -1,2,3 --centre",
                      "[{transform: {translate: [-1, 2, 3], centre: true}}]"));
    CHECK(same_stages("load --path -- --a.stl", "[{load: {path: '--a.stl'}}]"));
    CHECK(yaml("transform --translate -- ! orient")
              .starts_with("command line:1:41: error[E-PIPE]: a value is missing after '--'"));
    CHECK(yaml("relax -- ! orient").starts_with("command line:1:25: error[E-PIPE]: a value is missing"));
}

TEST_CASE("dotted keys nest, vectors and lists are split at commas", "[cli]") {
    CHECK(same_stages("simplify --lods [50%,10%]", "[{simplify: {lods: [50%, 10%]}}]"));
    CHECK(same_stages("simplify --lods 50%,10%", "[{simplify: {lods: [50%, 10%]}}]"));
    CHECK(same_stages("clip --plane.normal=0,0,1 --plane.offset 2",
                      "[{clip: {plane: {normal: [0, 0, 1], offset: 2}}}]"));
    CHECK(same_stages("relax --only head,arm* --only !hand", "[{relax: null, only: [head, arm*, '!hand']}]"));
}

TEST_CASE("flags of truths take a value only when it is one", "[cli]") {
    CHECK(same_stages("clip z=0 --cap ! relax", "[{clip: {cap: true, plane: z=0}}, {relax: null}]"));
    CHECK(same_stages("clip z=0 --cap false", "[{clip: {cap: false, plane: z=0}}]"));
    CHECK(same_stages("clip z=0 --no-cap", "[{clip: {cap: false, plane: z=0}}]"));
}

TEST_CASE("common keys stand beside the stage", "[cli]") {
    CHECK(same_stages(
        "relax 3 --name soft --ensure.closed --ensure.faces.max 500 --when.closed false",
        "[{relax: 3, name: soft, ensure: {closed: true, faces: {max: 500}}, when: {closed: false}}]"));
}

TEST_CASE("an at sign stands for the dollar, pct for the percent sign", "[cli]") {
    CHECK(same_stages("simplify 25pct ! write o.@{x.index}.glb ! write @@{x}",
                      "[{simplify: 25%}, {write: '${x}'}, {write: '@{x}'}]") == false);
    CHECK(same_stages("simplify 25pct ! write o.@{x.index}.glb ! write @@{x}",
                      "[{simplify: 25%}, {write: 'o.${x.index}.glb'}, {write: '@{x}'}]"));
}

TEST_CASE("foreach and branch nest in brackets", "[cli]") {
    CHECK(same_stages("load a ! foreach lod=50%,10pct [ simplify @{lod} ! write o.@{lod.index}.glb ]",
                      "[{load: a}, {foreach: {lod: [50%, 10%]}, do: [{simplify: '${lod}'}, {write: "
                      "'o.${lod.index}.glb'}]}]"));
    CHECK(same_stages("foreach part=* [ write @{part}.stl ]",
                      "[{foreach: {part: '*'}, do: [{write: '${part}.stl'}]}]"));
    CHECK(same_stages("foreach a=1 b=x,y [ relax @{a} ] --join",
                      "[{foreach: {a: [1], b: [x, y]}, do: [{relax: '${a}'}], join: true}]"));
    CHECK(
        same_stages("load a ! branch near [ write n.glb ] far [ simplify 10% ! write f.glb ] ! relax",
                    "[{load: a}, {branch: {near: [{write: n.glb}], far: [{simplify: 10%}, {write: f.glb}]}}, "
                    "{relax: null}]"));
}

TEST_CASE("a group takes a bare value and its options beside it, in either order", "[cli]") {
    for (const char* line :
         {"clean --holes planar --holes.edges 9", "clean --holes.edges 9 --holes planar"}) {
        const std::string text = yaml(line);
        CHECK(text.find("method: planar") != std::string::npos);
        CHECK(text.find("edges: 9") != std::string::npos);
    }
    CHECK(yaml("clean --holes planar --holes.method minimal").find("'--method' is given twice") !=
          std::string::npos);
}

TEST_CASE("mistakes in a one-liner are pointed out in it", "[cli]") {
    CHECK(yaml("load a ! ! write b") == "command line:1:25: error[E-PIPE]: a stage is missing here\n"
                                        "  facetmill pipe load a ! ! write b\n"
                                        "                          ^\n"
                                        "  hint: load a.stl ! relax 3 ! write a.glb\n");
    CHECK(yaml("foreach lod [ relax ]") ==
          "command line:1:24: error[E-PIPE]: foreach needs variable=value,value, found 'lod'\n  facetmill "
          "pipe foreach lod [ relax ]\n                         ^~~\n");
    CHECK(yaml("branch near [ relax")
              .starts_with("command line:1:28: error[E-PIPE]: this '[' is not closed\n"));
    CHECK(yaml("relax ]").starts_with("command line:1:22: error[E-PIPE]: ']' without '['\n"));
    CHECK(yaml("relax --lambda 1 --lambda 2")
              .starts_with("command line:1:33: error[E-PIPE]: '--lambda' is given twice\n"));
    CHECK(same_stages("clean --self_intersections ! orient",
                      "[{clean: {self_intersections: true}}, {orient: null}]"));
    CHECK(yaml("section z=1 outline.svg").find("hint: give its output file with --path outline.svg\n") !=
          std::string::npos);
    CHECK(yaml("section z=1 z=2").find("hint: separate stages with ! or +\n") != std::string::npos);
    CHECK(yaml("relax --lambda").starts_with("command line:1:22: error[E-PIPE]: '--lambda' needs a value\n"));
}

TEST_CASE("brackets and keys are nested twenty levels deep at most", "[cli]") {
    const auto brackets = [](int depth) {
        std::string line = "load a ! relax";
        for (int i = 0; i < depth; ++i) line = "branch b [ " + line + " ]";
        return yaml(line);
    };
    const auto key = [](int dots) {
        std::string line = "relax --a";
        for (int i = 0; i < dots; ++i) line += ".a";
        return yaml(line + "=1");
    };
    const std::string too_deep = "error[E-PIPE]: brackets are nested more than 20 levels deep";
    CHECK(brackets(20).find("error[") == std::string::npos);
    for (const int depth : {21, 1'000}) {
        const std::string told = brackets(depth);
        CHECK(told.find(too_deep) != std::string::npos);
        CHECK(told.find("error[", told.find(too_deep) + 1) == std::string::npos); // and nothing else
    }
    const std::string too_long = "error[E-PIPE]: a key has more than 21 parts";
    CHECK(key(20).find(too_long) == std::string::npos);
    for (const int dots : {21, 30'000}) CHECK(key(dots).find(too_long) != std::string::npos);
}

TEST_CASE("include takes a file and values for its params", "[cli]") {
    CHECK(same_stages("load a ! include b.yaml --with.keep=10pct --with.name x ! write c",
                      "[{load: a}, {include: b.yaml, with: {keep: 10%, name: x}}, {write: c}]"));
    CHECK(same_stages("load a ! include b.yaml", "[{load: a}, {include: b.yaml}]"));
    CHECK(yaml("load a ! include b.yaml c.yaml").find("include needs one file, found 'c.yaml'") !=
          std::string::npos);
    CHECK(yaml("load a ! include b.yaml --keep 1").find("include has no option '--keep'") !=
          std::string::npos);
}

TEST_CASE("a stage among the values of another lacks its separator", "[cli]") {
    CHECK(yaml("load a.ply simplify 25% ! write o.glb") ==
          "command line:1:27: error[E-PIPE]: 'simplify' is a stage, found among the values of 'load'\n  "
          "facetmill pipe load a.ply simplify 25% ! write o.glb\n                            ^~~~~~~~\n  "
          "hint: add ! before simplify if it is a stage\n");
    CHECK(yaml("load a.ply ! clip z=0 --cap relax 3 foreach n=1 [ write @{n}.ply ]")
              .find("add ! before foreach if it is a stage") != std::string::npos);
    CHECK(same_stages("load a.ply b.ply", "[{load: [a.ply, b.ply]}]"));
    CHECK(same_stages("load simplify", "[{load: simplify}]")); // a file may have that name
}

TEST_CASE("options of pipe itself come before the first stage", "[cli]") {
    cli::Arguments own;
    bool quiet = false;
    std::string report;
    own.add("-q,--quiet", &quiet, "");
    own.add("--report", &report, "");
    const auto problems = [&](const std::string& text, std::size_t first = 1) {
        std::vector<std::string> words{"pipe"};
        std::istringstream split(text);
        for (std::string word; split >> word;) words.push_back(word);
        const cli::CommandLine line(words);
        Problems problems;
        const Value document = cli::parse_pipe(line, first, problems, &own);
        std::string all = pipeline::emit_yaml(*document.find("stages"));
        for (const auto& d : problems.all()) all += render(d) + "\n";
        return all;
    };
    CHECK(problems("load a ! write b.glb --report r.json") ==
          "- load: a\n- write: b.glb\ncommand line:1:37: error[E-PIPE]: '--report' is an option of pipe, "
          "found after the stage 'write'\n  facetmill pipe load a ! write b.glb --report r.json\n            "
          "                          ^~~~~~~~\n  hint: put it before the first stage: facetmill pipe "
          "--report ... load ...\n");
    CHECK(problems("load a -u mm ! relax 1") ==
          "- load: a\n- relax: 1\n"
          "command line:1:23: error[E-PIPE]: 'load' has no option '-u': options of stages have long names\n"
          "  facetmill pipe load a -u mm ! relax 1\n"
          "                        ^~\n"
          "  hint: did you mean '--unit'?\n");
    CHECK(problems("transform --translate -1,2,3") == "- transform: {translate: [-1, 2, 3]}\n");
    CHECK(problems("--report load a.stl ! relax 1", 3)
              .find("command line:1:25: error[E-PIPE]: '--report' needs a value, but found the stage name "
                    "'load'") != std::string::npos);
    CHECK(problems("--report load load a.stl ! relax 1", 3) == "- load: a.stl\n- relax: 1\n");
    CHECK(
        problems("load a -q ! relax").find("command line:1:23: error[E-PIPE]: '-q' is an option of pipe,") !=
        std::string::npos);
}

TEST_CASE("options as other programs have them are answered with two dashes", "[cli]") {
    const auto hint = [](const std::string& line) {
        const std::string text = yaml(line);
        const auto at = text.find("  hint: ");
        return text.find("an option of a stage starts with two dashes") == std::string::npos
                   ? text
                   : text.substr(at + 8);
    };
    CHECK(yaml("load a ! combine operation=union") ==
          "command line:1:33: error[E-PIPE]: an option of a stage starts with two dashes, found "
          "'operation=union'\n  facetmill pipe load a ! combine operation=union\n                            "
          "      ^~~~~~~~~~~~~~~\n  hint: write --operation union\n");
    CHECK(hint("simplify ratio:10%") == "write --ratio 10%\n");
    CHECK(hint("simplify -faces 100") == "write --faces 100\n");
    CHECK(hint("write a.glb draco=true") == "write --draco true\n");
    CHECK(yaml("write a.glb draco").find("hint: did you mean '--draco'?") != std::string::npos);
    CHECK(same_stages("clip z=0", "[{clip: z=0}]")); // an equation, because no option has the name z
    CHECK(same_stages("load a=b.stl", "[{load: a=b.stl}]"));
    // Files may have the form of an option and its value.
    CHECK(same_stages("write draco=1.glb", "[{write: draco=1.glb}]"));
    CHECK(same_stages("load unit=mm.stl", "[{load: unit=mm.stl}]"));
    CHECK(hint("write path=a.glb") == "write --path a.glb\n");
    CHECK(hint("write unit=mm a.glb") == "write --unit mm\n");
}

TEST_CASE("no line of brackets, separators and options crashes the parser", "[cli][property]") {
    const std::vector<std::string> words{"[",      "]",   "!",     "relax",  "foreach",
                                         "branch", "a=1", "--cap", "--join", "3"};
    for (std::size_t n = 0; n < 20000; ++n) {
        std::vector<std::string> arguments{"pipe"};
        for (std::size_t rest = n * 2654435761U % 1000000007U; arguments.size() < 8; rest /= 10)
            arguments.push_back(words[rest % 10]);
        const cli::CommandLine line(arguments);
        Problems problems;
        cli::parse_pipe(line, 1, problems);
    }
    SUCCEED();
}

TEST_CASE("a group that true switches on is a flag", "[cli]") {
    CHECK(same_stages("write --draco a.glb", "[{write: {draco: true, path: a.glb}}]"));
    CHECK(same_stages("write a.glb --draco --ascii false",
                      "[{write: {draco: true, ascii: false, path: a.glb}}]"));
    CHECK(same_stages("write a.glb --draco.position_bits 12",
                      "[{write: {draco: {position_bits: 12}, path: a.glb}}]"));
}

TEST_CASE("a group that true gives its defaults is a flag, with options beside it", "[cli]") {
    CHECK(same_stages("clean --holes", "[{clean: {holes: true}}]"));
    CHECK(same_stages("clean --holes --holes.max_edges 9", "[{clean: {holes: {max_edges: 9}}}]"));
    CHECK(same_stages("clean --holes planar", "[{clean: {holes: planar}}]"));
}

TEST_CASE("what a file can say in braces and brackets, a one-liner can", "[cli]") {
    const auto same_as = [](std::vector<std::string> arguments, const std::string& text) {
        return yaml(std::move(arguments)) ==
               pipeline::emit_yaml(
                   pipeline::parse_yaml(std::make_shared<const SourceText>(SourceText{"expected", text}),
                                        *std::make_unique<Problems>()));
    };
    const std::string both = "[{clip: {planes: [[1, 0, 0, -0.25], [0, 0, 1, -0.5]]}}]";
    CHECK(same_as({"clip", "--planes", "[[1,0,0,-0.25],[0,0,1,-0.5]]"}, both));
    CHECK(same_as({"clip", "--planes", "[1,0,0,-0.25]", "--planes", "0,0,1,-0.5"}, both));
    CHECK(same_as({"clip", "--planes", "z=0,x=10pct"}, "[{clip: {planes: [z=0, x=10pct]}}]"));
    CHECK(same_as({"clip", "--planes", "{normal: [0, 0, 1], through: centre}", "--planes", "x=0"},
                  "[{clip: {planes: [{normal: [0, 0, 1], through: centre}, x=0]}}]"));
    CHECK(same_as({"clip", "--plane", "[1,0,0,-0.25]", "--plane", "[0,0,1,-0.5]"}, both));
    CHECK(
        same_as({"clip", "--plane", "{normal: [0, 0, 1], through: centre}", "--plane=x=0", "--plane", "y=1"},
                "[{clip: {planes: [{normal: [0, 0, 1], through: centre}, x=0, y=1]}}]"));
    CHECK(same_as({"clip", "--planes", "z=0,x=10pct", "--plane", "y=1"},
                  "[{clip: {planes: [z=0, x=10pct, y=1]}}]"));
    CHECK(yaml({"simplify", "--ratio", "50pct", "--ratio", "20pct"})
              .find("error[E-PIPE]: '--ratio' is given "
                    "twice") != std::string::npos);
    CHECK(same_as({"clip", "--plane", "{normal: [0, 0, 1], through: 20pct}"},
                  "[{clip: {plane: {normal: [0, 0, 1], through: 20%}}}]"));
    CHECK(same_as({"relax", "--ensure", "{closed: true, faces: {max: 9}}"},
                  "[{relax: null, ensure: {closed: true, faces: {max: 9}}}]"));
    CHECK(same_as({"load", "{a}.stl", "[b].stl"}, "[{load: ['{a}.stl', '[b].stl']}]"));
    CHECK(yaml({"clip", "--plane", "{normal: [0, 0}"}).find("error[E-YAML]: in '{normal: [0, 0}'") !=
          std::string::npos);
}

TEST_CASE("a word of another language behind a switch gets a hint", "[cli]") {
    CHECK(same_stages("write b.glb --draco true", "[{write: {draco: true, path: b.glb}}]"));
    for (const char* word : {"yes", "no", "on", "off"}) {
        CAPTURE(word);
        CHECK(yaml(std::string("write b.glb --draco ") + word)
                  .find("hint: switch options with true and false: --draco, --draco=false") !=
              std::string::npos);
    }
}
