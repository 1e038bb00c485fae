// facetmill new: writes a starter pipeline.

#include "base/text/spelling.hpp"
#include "cli/command.hpp"
#include "cli/ready_document.hpp"
#include "io/outputs/outputs.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* new_examples =
    R"(Without FILE, it lists the built-in pipelines with their params. With --from, it lists only that pipeline.

Examples
  facetmill new
  facetmill new --from web
  facetmill new scan.yaml
  facetmill run scan.yaml -D input=scan.ply --output-dir out
  facetmill new web.yaml --from web
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

/// A param in one line: "  keep       ratio    10%      The ratio of triangles that remain."
std::string param_line(const std::string& name, const Value& param) {
    const auto text = [&](const char* key) {
        const Value* value = param.find(key);
        return value && value->is_scalar() ? value->text : std::string();
    };
    const std::string type = param.is_scalar() ? param.text : text("type");
    std::string help = text("help");
    if (param.find("choices")) help += fmt::format(" ({})", fmt::join(choices_of(param), ", "));
    const std::string value = param.find("default") ? text("default") : "needed";
    return fmt::format("  {:<12}  {:<7}  {:<8}  {}\n", name, type, value, help);
}

/// The purpose of a built-in pipeline, and its params with their types and defaults.
std::string described(const docs::ReadyPipeline& ready) {
    const Value document = document_of(ready);
    const Value* about = document.find("about");
    std::string text = fmt::format("{}: {}\n", ready.name, about ? about->text : "");
    if (const Value* params = document.find("params"))
        for (const auto& param : params->entries) text += param_line(param.key, param.value);
    return text + fmt::format("  facetmill run {} MESH\n", ready.name);
}

const docs::ReadyPipeline& ready_named(const NewOptions& options, const CommandLine& line) {
    if (const auto* ready = docs::ready_pipeline(options.from)) return *ready;
    const auto names = docs::ready_names();
    throw Error(ErrorKind::usage, "E-ARGUMENT",
                fmt::format("built-in pipeline '{}' does not exist", options.from),
                did_you_mean(options.from, names, fmt::format("{}", fmt::join(names, ", "))),
                line.value(options.from));
}

/// The named built-in pipeline, or all.
std::string list_of(const NewOptions& options, const CommandLine& line) {
    if (!options.from.empty()) return described(ready_named(options, line));
    std::string text = "The built-in pipelines. Give params after -D: -D keep=10%.\n";
    for (const auto& ready : docs::ready_pipelines()) text += "\n" + described(ready);
    return text;
}

int write_new(const NewOptions& options, const CommandLine& line, const Console& console) {
    if (options.file.empty()) {
        show(list_of(options, line));
        return 0;
    }
    const std::string text = options.from.empty() ? starter : std::string(ready_named(options, line).text);
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
            "Writes a pipeline as a starting point, or lists the ready ones.",
            new_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<NewOptions>();
                arguments.add("FILE", &options->file, "The file to write. - prints it.");
                arguments.add("--from", &options->from, "The built-in pipeline to start from.")
                    .suggests(docs::ready_names);
                return [=, &console](const Invocation& invocation) {
                    return write_new(*options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
