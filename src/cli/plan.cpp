// facetmill plan: resolves everything and runs nothing.

#include "cli/pipeline_options.hpp"
#include "pipeline/rehearsal.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* plan_examples = R"(Examples
  facetmill plan scan.yaml -D input=scan.ply
  facetmill plan scan.yaml --inputs       (the files it reads, one per line)
  facetmill plan scan.yaml --json
)";

struct PlanOptions {
    PipelineOptions common;
    std::vector<std::string> pipelines; ///< one, after the mesh is taken
    bool inputs = false, outputs = false, json = false;
};

std::string lines(const std::vector<std::filesystem::path>& paths) {
    std::string text;
    for (const auto& path : paths) text += path.generic_string() + "\n";
    return text;
}

int plan(PlanOptions& options, const CommandLine& line, const Console& console) {
    take_input(options.pipelines, options.common, line);
    if (options.pipelines.size() > 1)
        throw Error(ErrorKind::usage, "E-ARGUMENT",
                    fmt::format("plan takes one pipeline, found {}", options.pipelines.size()),
                    "plan them one by one", line.value(options.pipelines[1]));
    Problems problems;
    const auto plan =
        plan_of(options.pipelines.front(), plan_settings(options.common, line, problems), problems);
    settle(problems, console);
    const bool files_only = options.inputs || options.outputs;
    start_programs(plan);
    confine({.read_all = true}, options.common.sandbox, console);
    // Names of inputs need no run of the stages.
    const auto headers =
        options.inputs && !options.outputs ? pipeline::read_headers(plan) : pipeline::rehearsed_headers(plan);
    if (!files_only) settle(pipeline::input_errors(plan, headers)); // names are known even with errors
    if (const auto warning = pipeline::without_effect(plan); warning && !files_only)
        console.diagnostic(*warning);
    const auto cells = pipeline::plan_cells(plan, cell_settings(options.common, line));
    std::string text;
    if (options.inputs) text += lines(pipeline::planned_inputs(plan, headers));
    if (options.inputs && options.outputs) text += "\n";
    if (options.outputs) text += lines(pipeline::planned_outputs(plan, headers));
    if (options.json) text = pipeline::describe_json(plan, headers).dump(2) + "\n";
    if (!files_only && !options.json) text = pipeline::describe(plan, headers);
    if (!cells.why.empty() && !files_only && !options.json) text += fmt::format("\nmemory: {}\n", cells.why);
    files_only || options.json ? print(text) : show(text); // file names are for programs
    return 0;
}

} // namespace

Command plan_command() {
    return {"plan",
            "Shows the resolved steps of a pipeline without running it.",
            plan_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<PlanOptions>();
                arguments
                    .add("PIPELINE", &options->pipelines,
                         "A YAML file, - or a built-in pipeline, and possibly a mesh.")
                    .required();
                arguments.add("--inputs", &options->inputs,
                              "Prints only the files that the pipeline reads, one per line.");
                arguments.add(
                    "--outputs", &options->outputs,
                    "Prints only the files that the pipeline writes, one per line. With --inputs, an\n"
                    "empty line separates the two lists.");
                arguments.add("--json", &options->json, "Prints JSON.");
                arguments.add("-o,--output-dir", &options->common.output_dir,
                              "The folder for relative paths of outputs. Default: the working directory.");
                add_value_options(arguments, options->common);
                add_cell_options(arguments, options->common);
                add_sandbox_option(arguments, options->common.sandbox);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    return plan(*options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
