// facetmill new: writes a starter pipeline.

#include "base/text/spelling.hpp"
#include "cli/command.hpp"
#include "docs/ready.hpp"
#include "io/outputs/outputs.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* new_examples = R"(Examples
  facetmill new scan.yaml
  facetmill run scan.yaml -D input=scan.ply --output-dir out
  facetmill new web.yaml --from scan-to-web
)";

constexpr const char* starter =
    R"(# A pipeline is a list of stages that run in order. All of it is checked before the first stage starts.
#
#   facetmill check FILE                          reports all errors, with positions and hints
#   facetmill plan FILE -D input=scan.ply         shows all values and files, without running it
#   facetmill run FILE -D input=scan.ply --output-dir out
#   facetmill batch FILE --input 'scans/**/*.ply' --output-dir out
#
# facetmill stages lists all stages, and facetmill stages simplify describes one.
# facetmill schema pipeline prints a JSON Schema, with which editors complete and check this file.
facetmill: 1
about: Makes a checked file for the web.

params:                            # set them with -D keep=10%, or in a YAML file: -p phone.yaml
  input: {type: path, help: The mesh to read}
  unit: {type: choice, default: auto, choices: [auto, mm, cm, m], help: "The unit. auto: the unit of the file"}
  up: {type: choice, default: auto, choices: [auto, y, z], help: "The up axis. auto: the axis of the file"}
  keep: {type: ratio, default: 25%, help: The share of the triangles to keep}

stages:
  # Paths are relative to this file, but paths after -D are relative to the working directory.
  - load: {path: "${input}", unit: "${unit}", up: "${up}"}
  - clean                          # merges vertices at the same position, removes degenerate and duplicate faces
  - simplify: "${keep}"
    ensure: {deviation: 2%}        # checked right after the stage; the exit code is 1 if it fails
  - write: "${input.stem}.glb"     # appears only if the whole run succeeds

report: "${input.stem}.html"       # the steps, and whether the result is sound
)";

struct NewOptions {
    std::string file, from;
};

std::string text_of(const NewOptions& options, const CommandLine& line) {
    if (options.from.empty()) return starter;
    if (const auto* ready = docs::ready_pipeline(options.from)) return std::string(ready->text);
    const auto names = docs::ready_names();
    throw Error(ErrorKind::usage, "E-ARGUMENT",
                fmt::format("built-in pipeline '{}' does not exist", options.from),
                did_you_mean(options.from, names, fmt::format("{}", fmt::join(names, ", "))),
                line.value(options.from));
}

int write_new(const NewOptions& options, const CommandLine& line, const Console& console) {
    const std::string text = text_of(options, line);
    if (options.file == "-") {
        print(text);
        return 0;
    }
    std::error_code ignored;
    if (std::filesystem::exists(std::filesystem::symlink_status(options.file, ignored)))
        throw Error(ErrorKind::usage, "E-EXISTS", fmt::format("'{}' already exists", options.file),
                    "give another name, or - to print it", line.value(options.file));
    io::write_now(options.file, std::as_bytes(std::span(text)));
    console.say(fmt::format("wrote {0}; next: facetmill plan {0} -D input=FILE", options.file));
    return 0;
}

} // namespace

Command new_command() {
    return {"new",
            "Writes a commented pipeline as a starting point.",
            new_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<NewOptions>();
                arguments.add("FILE", &options->file, "The file to write. - prints it.").required();
                arguments.add("--from", &options->from, "The built-in pipeline to start from.")
                    .suggests(docs::ready_names);
                return [=, &console](const Invocation& invocation) {
                    return write_new(*options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
