// facetmill convert, view and fix: built-in pipelines as commands, with the params as options.

#include "cli/pipeline_options.hpp"
#include "cli/ready_document.hpp"
#include "cli/save_pipeline.hpp"
#include "pipeline/expressions.hpp"
#include "platform/page_opener.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace facetmill::cli {

namespace {

struct DoorOptions {
    std::string input, output, save_to;
    bool no_open = false;
    std::map<std::string, bool> flags{}; ///< params of type bool
    PipelineOptions run;
};

/// Adds the params as options, except the input and the output.
void add_params(const Value& document, Arguments& arguments, const std::shared_ptr<DoorOptions>& options) {
    for (const auto& [name, mark, param] : document.find("params")->entries) {
        if (name == "input" || name == "output") continue;
        if (param.find("type")->text == "bool") {
            arguments.add("--" + name, &options->flags[name], param.find("help")->text);
            continue;
        }
        const auto take = [options, name = name](const std::string& value) {
            options->run.defines.push_back(fmt::format("{}={}", name, value));
        };
        arguments
            .add("--" + name, Argument::Target(take),
                 fmt::format("{} Default: {}.", param.find("help")->text, param.find("default")->text))
            .followed_by(param.find("type")->text)
            .one_of(choices_of(param));
    }
}

/// Writes the pipeline with these values as the defaults of its params, so that run needs none.
void save(Value document, const PipelineOptions& options, const std::string& target) {
    for (const auto& define : options.defines) {
        const auto end = define.find('=');
        document.find("params")
            ->find(define.substr(0, end))
            ->set("default", Value::scalar(define.substr(end + 1)));
    }
    save_pipeline(std::move(document), {}, target);
}

int run_door(const char* pipeline, DoorOptions& options, const CommandLine& line, const Console& console) {
    options.run.defines.push_back("input=" + options.input);
    if (!options.output.empty()) options.run.defines.push_back("output=" + options.output);
    for (const auto& [name, given] : options.flags)
        if (given) options.run.defines.push_back(name + "=true");
    Problems problems;
    auto settings = plan_settings(options.run, line, problems);
    if (!options.save_to.empty()) settings.others.push_back({options.save_to, line.find("--save"), true});
    const auto plan = plan_of(pipeline, settings, problems);
    if (refused({plan}, problems, console)) return static_cast<int>(ErrorKind::usage);
    if (!options.save_to.empty())
        save(document_of(*docs::ready_pipeline(pipeline)), options.run, options.save_to);
    confine_to({plan}, options.run, console);
    return run_with_messages(plan, options.run, console, "");
}

/// Runs the pipeline view, and opens its page.
int view(DoorOptions& options, const CommandLine& line, const Console& console) {
    if (options.output.empty()) options.output = pipeline::stem_of(options.input) + ".html";
    const auto opener = options.no_open ? nullptr : std::make_unique<PageOpener>();
    const int code = run_door("view", options, line, console);
    if (code != 0) return code;
    const auto page = std::filesystem::absolute(options.output).lexically_normal().generic_string();
    if (opener && opener->open(page))
        console.say(fmt::format("opened {}", page));
    else
        console.say(fmt::format("open {} in a browser", page));
    return code;
}

void add_common_options(Arguments& arguments, DoorOptions& options, Console& console) {
    arguments.add("-D", &options.run.defines, "").hidden(); // as hints of stages name it: -D unit=mm
    arguments.add("--save", &options.save_to, "Also saves the pipeline as a file for run. - prints it.");
    add_threads_option(arguments, options.run.threads, "The number of threads. Default: all cores.");
    add_asset_root_option(arguments, options.run.asset_roots);
    add_sandbox_option(arguments, options.run.sandbox);
    add_warning_options(arguments, options.run);
    add_message_options(arguments, console);
}

constexpr const char* convert_examples =
    R"(Runs the built-in pipeline convert. The content of IN and the suffix of OUT give the formats.

Examples
  facetmill convert scan.ply scan.glb
  facetmill convert part.stl part.3mf --unit mm --up z
  facetmill convert lamp.gltf lamp.glb --meshopt --save lamp.yaml   (then: facetmill run lamp.yaml)
)";

constexpr const char* view_examples =
    R"(Runs the built-in pipeline view, and opens the page that it writes into the working directory.

Examples
  facetmill view lamp.glb
  facetmill view part.stl --unit mm --up z -o part-v2.html --no-open
)";

constexpr const char* fix_examples =
    R"(Runs the built-in pipeline repair: fills holes, unites solids, orients faces and checks the result for
printing. If a check fails, the exit code is 1 and no file is written. The report
NAME.repaired.html in the working directory shows where.

Examples
  facetmill fix scan.stl
  facetmill fix scan.obj solid.3mf --unit cm
  facetmill fix scan.stl --save fix.yaml                             (then: facetmill run fix.yaml other.stl)
)";

} // namespace

Command convert_command() {
    return {"convert",
            "Converts a mesh file into another format.",
            convert_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<DoorOptions>();
                arguments.add("IN", &options->input, "The mesh file to read, or -.").required();
                arguments.add("OUT", &options->output, "The file to write.").required();
                add_params(document_of(*docs::ready_pipeline("convert")), arguments, options);
                add_common_options(arguments, *options, console);
                return [=, &console](const Invocation& invocation) {
                    return run_door("convert", *options, invocation.line, console);
                };
            }};
}

Command view_command() {
    return {"view",
            "Shows a mesh file on a page with a 3D view.",
            view_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<DoorOptions>();
                arguments.add("IN", &options->input, "The mesh file to read, or -.").required();
                arguments
                    .add("-o,--output",
                         written_file("--output", ".html", "E-REPORT", "facetmill view part.stl -o part.html",
                                      [=](const std::string& path) { options->output = path; }),
                         "The page to write. Default: the name of the mesh, in the working directory.")
                    .followed_by("FILE.html");
                arguments.add("--no-open", &options->no_open, "Only writes the page.");
                add_params(document_of(*docs::ready_pipeline("view")), arguments, options);
                add_common_options(arguments, *options, console);
                return [=, &console](const Invocation& invocation) {
                    return view(*options, invocation.line, console);
                };
            }};
}

Command fix_command() {
    return {"fix",
            "Repairs a mesh file for printing.",
            fix_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<DoorOptions>();
                arguments.add("IN", &options->input, "The mesh file to read, or -.").required();
                arguments.add("OUT", &options->output,
                              "The file to write. Default: NAME.repaired.stl in the working directory.");
                add_params(document_of(*docs::ready_pipeline("repair")), arguments, options);
                add_common_options(arguments, *options, console);
                return [=, &console](const Invocation& invocation) {
                    const auto& given = options->run.defines;
                    if (!options->output.empty() &&
                        std::any_of(given.begin(), given.end(),
                                    [](const auto& define) { return define.starts_with("format="); }))
                        throw Error(ErrorKind::usage, "E-CONFLICT",
                                    "--format cannot be combined with OUT, whose suffix gives the format",
                                    "remove one of them", invocation.line.find("--format"));
                    return run_door("repair", *options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
