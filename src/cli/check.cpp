// facetmill check: validates pipelines. It reads only the headers of existing inputs.

#include "cli/pipeline_options.hpp"

namespace facetmill::cli {

namespace {

constexpr const char* check_examples =
    R"(The command reports all errors of all files. Params without a value count as valid; use -D to give values. If
inputs exist, their headers are read (format, unit). A pattern must match a file. Exit codes: 2 if a pipeline has
an error, otherwise 6 if an input is malformed, otherwise 3 if a pattern matches nothing.

Examples
  facetmill check pipelines/*.yaml
  facetmill check scan.yaml -D keep=10% --log json
)";

int check(const std::vector<std::string>& pipelines, const PipelineOptions& options, const CommandLine& line,
          const Console& console) {
    confine({.read_all = true}, options.sandbox, console);
    plan_each(pipelines, options, line, console, [&](const std::string& name, const pipeline::Plan& plan) {
        const auto errors = pipeline::input_errors(plan, pipeline::read_headers(plan));
        if (errors.empty()) console.say(name + ": ok");
        if (const auto warning = pipeline::without_effect(plan)) console.diagnostic(*warning);
        settle(errors);
    });
    return 0;
}

} // namespace

Command check_command() {
    return {"check",
            "Checks pipeline files, and the headers of their inputs.",
            check_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<PipelineOptions>();
                auto pipelines = std::make_shared<std::vector<std::string>>();
                arguments.add("PIPELINE", pipelines.get(), "YAML files, - or built-in pipelines.").required();
                add_value_options(arguments, *options);
                add_sandbox_option(arguments, options->sandbox);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    take_input(*pipelines, *options, invocation.line);
                    return check(*pipelines, *options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
