// facetmill check: are the pipelines right? Of the inputs that exist it reads the headers, no more.

#include "cli/pipeline_options.hpp"

namespace facetmill::cli {

namespace {

constexpr const char* check_examples =
    R"(All errors of all files are reported. Params without a value stand for any value unless -D gives one. Inputs that
exist are looked into, as far as their headers go: format, unit. Exit code 2 when a pipeline is wrong, 6 when only
an input is malformed.

Examples
  facetmill check pipelines/*.yaml
  facetmill check scan.yaml -D keep=10% --log json
)";

int check(const std::vector<std::string>& pipelines, const PipelineOptions& options, const CommandLine& line,
          const Console& console) {
    Problems problems;
    auto settings = plan_settings(options, line, problems);
    settings.parameters_needed = false;
    std::vector<Error> of_inputs;
    for (const auto& pipeline : pipelines) {
        Problems of_this;
        try {
            const auto plan = plan_of(pipeline, settings, of_this);
            const auto headers = of_this.any_errors() ? facetmill::pipeline::Headers{}
                                                      : facetmill::pipeline::read_headers(plan);
            of_inputs.insert(of_inputs.end(), headers.errors.begin(), headers.errors.end());
            if (!of_this.any_errors() && headers.errors.empty()) console.say(pipeline + ": ok");
            if (const auto warning = facetmill::pipeline::without_effect(plan);
                warning && !of_this.any_errors())
                console.diagnostic(*warning);
        } catch (const Error& unreadable) { // the others are checked all the same
            of_inputs.push_back(unreadable);
        }
        if (of_this.size() > 0) problems.add(Error(ErrorKind::usage, of_this.all()));
    }
    if (problems.any_errors())
        for (const auto& error : of_inputs) problems.add(error);
    settle(problems, console);
    settle(of_inputs);
    return 0;
}

} // namespace

Command check_command() {
    return {"check", "Checks pipeline files, and the headers of their inputs.", check_examples, false,
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<PipelineOptions>();
                auto pipelines = std::make_shared<std::vector<std::string>>();
                arguments.add("PIPELINE", pipelines.get(), "YAML files, - or ready pipelines.").required();
                add_value_options(arguments, *options);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    return check(*pipelines, *options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
