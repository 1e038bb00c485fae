#include "cli/command.hpp"

#include "facetmill_version.hpp"
#include "support/catch.hpp"
#include "support/temporary.hpp"

#include <filesystem>
#include <fstream>

using namespace facetmill;
using namespace facetmill::cli;

namespace {
std::string message(std::vector<std::string> arguments) {
    Console console;
    console.quiet = true;
    // It could not be opened again for the other tests of this process.
    if (!arguments.empty() && (arguments[0] == "render" || arguments[0] == "info"))
        arguments.emplace_back("--no-sandbox");
    try {
        return "exit " + std::to_string(program(std::move(arguments), console));
    } catch (const Error& e) {
        std::string text;
        for (const auto& d : e.diagnostics()) text += render(d) + "\n";
        return text;
    }
}
} // namespace

TEST_CASE("the command line is a text that marks point into", "[cli]") {
    const CommandLine line({"run", "a b.yaml", "--x=1"});
    CHECK(render({Severity::error, "E-X", "no", line.mark(1), {}}) == "command line:1:15: error[E-X]: no\n"
                                                                      "  facetmill run 'a b.yaml' --x=1\n"
                                                                      "                ^~~~~~~~~~");
    CHECK(to_string(line.find("--x")) == "command line:1:26");
}

TEST_CASE("an unknown command is answered with the nearest one", "[cli]") {
    CHECK(message({"rnu", "a.yaml"}) ==
          "command line:1:11: error[E-COMMAND]: command 'rnu' does not exist\n  facetmill rnu a.yaml\n       "
          "     ^~~\n  hint: did you mean 'run'?\n");
}

TEST_CASE("a file or a built-in pipeline in the place of the command is answered with one that takes it",
          "[cli]") {
    for (const char* word : {"scan.ply", "/scans/a"}) {
        CAPTURE(word);
        CHECK(message({word, "a.glb"}).find("hint: use facetmill convert IN OUT to convert a mesh file") !=
              std::string::npos);
    }
    CHECK(message({"repair", "a.stl"})
              .find("hint: use facetmill run repair -D input=FILE to run a pipeline\n") != std::string::npos);
}

TEST_CASE("an unknown option is answered with the nearest one", "[cli]") {
    CHECK(message({"run", "a.yaml", "--ouput-dir=x"}) ==
          "command line:1:22: error[E-OPTION]: 'run' has no option '--ouput-dir'\n"
          "  facetmill run a.yaml --ouput-dir=x\n"
          "                       ^~~~~~~~~~~~~\n"
          "  hint: did you mean '--output-dir'?\n");
    CHECK(message({"pipe", "--sav", "load", "a.stl"}) ==
          "command line:1:16: error[E-OPTION]: 'pipe' has no option '--sav'\n"
          "  facetmill pipe --sav load a.stl\n"
          "                 ^~~~~\n"
          "  hint: did you mean '--save'?\n");
}

TEST_CASE("options before the command are answered with where they go", "[cli]") {
    CHECK(message({"--quiet", "run"}) ==
          "command line:1:11: error[E-OPTION]: facetmill itself has no option '--quiet'\n"
          "  facetmill --quiet run\n"
          "            ^~~~~~~\n"
          "  hint: options come after the command: facetmill run --quiet ...\n");
    CHECK(message({"--no-cache", "pipe", "load", "a.stl"})
              .find("hint: options come after the command: facetmill pipe --no-cache ...\n") !=
          std::string::npos);
    CHECK(message({"-v"}).find("facetmill run -v ...\n") != std::string::npos);
}

TEST_CASE("one JSON document names the release and its libraries", "[cli]") {
    CHECK(version_text(false) == "facetmill " FACETMILL_VERSION "\n");
    CHECK(version_text(true).find("\"CGAL\"") != std::string::npos);
    CHECK(version_text(true).find("unknown") == std::string::npos);
}

TEST_CASE("the value of an option is found after its equals sign, too", "[cli]") {
    const CommandLine line({"run", "--allow=W-X", "--allow", "W-Y"});
    CHECK(to_string(line.value("W-X")) == "command line:1:23");
    CHECK(to_string(line.value("W-Y")) == "command line:1:35");
    CHECK(to_string(line.value("W-Z")) == "command line:1:1");
}

TEST_CASE("an id beside --strict is not taken for a pipeline or a stage", "[cli]") {
    CHECK(message({"run", "--strict", "W-UNITS", "a.yaml"}) ==
          "command line:1:24: error[E-ARGUMENT]: write --strict and the id of a warning as one argument: "
          "--strict=W-UNITS\n  facetmill run --strict W-UNITS a.yaml\n                         ^~~~~~~\n  "
          "hint: --strict alone applies to all warnings\n");
    CHECK(message({"pipe", "--quiet", "W-UNITS", "load", "a.ply"}).find("--quiet=W-UNITS") !=
          std::string::npos);
}

TEST_CASE("a stage is no command", "[cli]") {
    CHECK(message({"relax", "a.ply"}) ==
          "command line:1:11: error[E-COMMAND]: 'relax' is a stage, not a command\n"
          "  facetmill relax a.ply\n"
          "            ^~~~~\n"
          "  hint: facetmill pipe load a.ply ! relax ... ! write OUT; facetmill relax --help lists its "
          "options\n");
}

TEST_CASE("a stage typed as a command is answered with the same words for pipe", "[cli]") {
    const auto meant = [](std::vector<std::string> words) {
        const std::string text = message(std::move(words));
        const auto at = text.find("hint: facetmill pipe "), end = text.find("; facetmill", at);
        return end == std::string::npos ? text : text.substr(at + 21, end - at - 21);
    };
    CHECK(meant({"validate", "--watertight", "part.stl"}) == "load part.stl ! validate --closed");
    CHECK(meant({"simplify", "a.ply", "b c.glb", "--target-faces", "100"}) ==
          "load a.ply ! simplify --faces 100 ! write 'b c.glb'");
    CHECK(meant({"decimate", "a.ply", "-o", "b.glb", "50%"}) == "load a.ply ! simplify 50% ! write b.glb");
    CHECK(meant({"combine", "union", "a.stl", "--with", "b.stl"}) ==
          "load a.stl ! combine union --with b.stl ! write OUT");
    CHECK(meant({"section", "a.stl", "z=0", "o.svg"}) == "load a.stl ! section z=0 --path o.svg");
    CHECK(meant({"generate", "sphere"}) == "generate sphere ! write OUT");
    CHECK(meant({"simplify", "a.ply", "--reduction", "0.9"}) ==
          "load a.ply ! simplify --reduction 0.9 ! write OUT"); // pipe explains the option
    CHECK(meant({"write"}) == "load IN ! write ...");
    CHECK(meant({"write", "a.ply", "b.glb"}) == "load a.ply ! write b.glb");
    CHECK(meant({"load", "a.ply", "b.glb"}) == "load a.ply b.glb ! write OUT");
    CHECK(meant({"generate", "sphere", "a.glb"}) == "generate sphere ! write a.glb");
    CHECK(meant({"combine", "a.ply", "b.ply", "-o", "c.ply"}) ==
          "load a.ply b.ply ! combine ... ! write c.ply");
    CHECK(meant({"validate", "a.ply", "b.ply", "--closed"}) == "load a.ply b.ply ! validate --closed");
    CHECK(meant({"validate", "--junit", "r.xml", "a.ply", "--closed"}) ==
          "--report r.xml load a.ply ! validate --closed");
    CHECK(meant({"smooth", "a.ply", "--help"}) == "load a.ply ! relax ... ! write OUT");
}

TEST_CASE("stages behind a command that takes a pipeline are answered with what makes a file of them",
          "[cli]") {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"batch", "a.obj", "!", "simplify"},
          std::vector<std::string>{"batch", "a.obj", "-o", "out", "!", "simplify", "50%"}}) {
        const std::string said = message(words);
        CHECK(said.find("hint: batch needs a pipeline file, and facetmill new FILE.yaml creates one; to run "
                        "stages") != std::string::npos);
        CHECK(said.find("'batch' does not accept '50%'") == std::string::npos); // once is enough
    }
    const std::string two = message({"batch", "a.yaml", "b.ply", "c.ply", "-o", "out"});
    CHECK(two.find("hint: give meshes after --input: facetmill batch PIPELINE --input b.ply ...") !=
          std::string::npos);
    CHECK(two.find("'batch' does not accept 'c.ply'") == std::string::npos);
}

TEST_CASE("hints for missing arguments and bad numbers fit, and following them leads further", "[cli]") {
    const auto hint = [](const std::vector<std::string>& words) {
        const std::string said = message(words);
        const auto at = said.find("hint: ");
        return at == said.npos ? said : said.substr(at + 6, said.find('\n', at) - at - 6);
    };
    for (const std::vector<std::string>& words : {std::vector<std::string>{"run", "--threads", "0", "web"},
                                                  std::vector<std::string>{"info", "--threads", "0", "web"}})
        CHECK(hint(words) == "give a number from 1 to 4096, or leave out --threads");
    CHECK(hint({"batch", "web", "--input", "a.stl"}) == "add it, for example --output-dir out");
    CHECK(hint({"export", "web", "--input", "a.stl", "-o", "out"}) == "add it, for example --to ninja");
    CHECK(hint({"batch", "--input", "a.stl", "-o", "out"}) ==
          "name a pipeline first: facetmill batch PIPELINE --input FILE ...; facetmill new lists the "
          "built-in ones");
    CHECK(hint({"diff", "a.stl"}) == "facetmill diff A B");
    CHECK(hint({"convert", "a.stl"}) == "facetmill convert IN OUT");
}

TEST_CASE("docs prints each group of topics alone", "[cli]") {
    for (const char* group : {"guides", "pages", "commands"}) CHECK(message({"docs", group}) == "exit 0");
}

TEST_CASE("help of a word is that of docs", "[cli]") {
    CHECK(message({"help", "simplfy"}) ==
          "command line:1:16: error[E-ARGUMENT]: topic 'simplfy' does not exist\n  facetmill help simplfy\n  "
          "               ^~~~~~~\n  hint: did you mean 'simplify'?\n");
}

TEST_CASE("render takes the options of the stage, and says what it needs", "[cli]") {
    const test::TemporaryDirectory folder;
    const std::string mesh = (folder.path() / "a.obj").string(), image = (folder.path() / "a.png").string();
    std::ofstream(mesh) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    CHECK(message({"render"}).find("error[E-ARGUMENT]: render needs a mesh file before its options") !=
          std::string::npos);
    CHECK(message({"render", mesh}).find("error[E-ARGUMENT]: render needs -o FILE.png") != std::string::npos);
    CHECK(message({"render", mesh, "-o", image, "--wiew", "front"}).starts_with("exit 2"));
    CHECK_FALSE(std::filesystem::exists(image));
    CHECK(message({"render", "-j", "1", mesh, "--view", "front", "--output=" + image, "--width", "40"}) ==
          "exit 0");
    CHECK(std::filesystem::file_size(image) > 100);
}

TEST_CASE("info writes a picture, too", "[cli]") {
    const test::TemporaryDirectory folder;
    const std::string mesh = (folder.path() / "a.obj").string(), image = (folder.path() / "a.png").string();
    std::ofstream(mesh) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    CHECK(message({"info", mesh, "--picture", "a.jpg"}).find("E-PICTURE") != std::string::npos);
    const auto before = std::filesystem::file_size(mesh); // the mesh must not be mistaken for the picture
    const std::string forgotten = message({"info", "--picture", mesh});
    CHECK(forgotten.find("error[E-PICTURE]: --picture is followed by the .png file to write, found '" + mesh +
                         "'") != std::string::npos);
    CHECK(forgotten.find("hint: facetmill info --picture picture.png part.stl") != std::string::npos);
    CHECK(std::filesystem::file_size(mesh) == before);
    CHECK(message({"info", mesh, "--picture", "--json"})
              .find("--picture is followed by the .png file to write, found '--json'") != std::string::npos);
    CHECK(message({"diff", mesh, mesh, "--html"}).find("diff: --html is followed by F.html, found nothing") !=
          std::string::npos);
    CHECK(message({"diff", mesh, mesh, "-j"}).find("diff: -j is followed by a value, found nothing") !=
          std::string::npos);
    CHECK(message({"info", mesh, mesh, "--picture", image}) == "exit 0");
    CHECK(std::filesystem::file_size(image) > 100);
}
