// facetmill run: the pipelines in order, all planned before the first one starts.

#include "cli/pipeline_options.hpp"

#include <fmt/format.h>
#include <set>

namespace facetmill::cli {

namespace {

constexpr const char* run_examples =
    R"(A PIPELINE is a YAML file, "-" for standard input, or the name of a ready pipeline (quickstart, scan-to-web,
lod-chain).

Examples
  facetmill run scan.yaml
  facetmill run scan-to-web -D input=scan.ply -D keep=10% --output-dir web
  facetmill run scan.yaml --set simplify.ratio=5% --report scan.html --strict
  facetmill run scan.yaml --depfile scan.d          (for Make and Ninja)
)";

/// Two pipelines of one run must not write the same file: the second would replace what the first one made.
void refuse_common_outputs(std::vector<pipeline::Plan>& plans, Problems& problems) {
    std::set<std::filesystem::path> seen;
    for (auto& plan : plans) {
        for (const auto& output : pipeline::planned_outputs(plan))
            if (output != "-" && !seen.insert(output.lexically_normal()).second) {
                plan.files_collide = true;
                problems.add({}, "E-DUPLICATE-OUTPUT",
                             fmt::format("{}: '{}' is written by another pipeline of this run too", plan.name,
                                         output.string()));
            }
    }
}

int run(const std::vector<std::string>& pipelines, const PipelineOptions& options, const CommandLine& line,
        const Console& console) {
    Problems problems;
    const auto settings = plan_settings(options, line, problems);
    const std::pair<const char*, bool> of_one[] = {{"--depfile", !options.depfile.empty()},
                                                   {"--report", !options.reports.empty()},
                                                   {"--timings", !options.timings.empty()}};
    for (const auto& [option, is_given] : of_one)
        if (pipelines.size() > 1 && is_given)
            problems.add(line.find(option), "E-ARGUMENT",
                         fmt::format("{} takes one pipeline, found {}", option, pipelines.size()),
                         "run them one by one");
    std::vector<pipeline::Plan> plans;
    plans.reserve(pipelines.size());
    for (const auto& pipeline : pipelines) plans.push_back(plan_of(pipeline, settings, problems));
    if (!problems.any_errors() && plans.size() > 1) refuse_common_outputs(plans, problems);
    if (refused(plans, problems, console)) return static_cast<int>(ErrorKind::usage);
    int worst = 0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const bool file = pipelines[i] != "-" && std::filesystem::exists(pipelines[i]);
        const int code = run_with_messages(plans[i], options, console, file ? pipelines[i] : "");
        if (worst == 0) worst = code;
    }
    return worst;
}

} // namespace

Command run_command() {
    return {"run", "Runs pipelines.", run_examples, false, [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<PipelineOptions>();
                auto pipelines = std::make_shared<std::vector<std::string>>();
                arguments.add("PIPELINE", pipelines.get(), "YAML files, - or ready pipelines.").required();
                add_value_options(arguments, *options);
                add_run_options(arguments, *options);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    return run(*pipelines, *options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
