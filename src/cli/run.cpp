// facetmill run: the pipelines in order, all planned before the first one starts.

#include "base/words.hpp"
#include "cli/pipeline_options.hpp"
#include "cli/watch.hpp"

#include <algorithm>
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
  facetmill run scan.yaml -D input=scan.ply --watch (again whenever scan.yaml or scan.ply changes)
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

/// Files that a plan reads; with errors only what needs no look into them.
std::vector<std::filesystem::path> inputs_of(const pipeline::Plan& plan, bool with_errors) {
    return with_errors ? pipeline::planned_inputs(plan)
                       : pipeline::planned_inputs(plan, pipeline::read_headers(plan));
}

/// watch: gets what the pipelines read before it is read; or null.
int run(const std::vector<std::string>& pipelines, const PipelineOptions& options, const CommandLine& line,
        const Console& console, Watch* watch) {
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
    if (watch)
        for (const auto& plan : plans)
            for (const auto& input : inputs_of(plan, problems.any_errors())) watch->add(input);
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

/// Runs, and again whenever something that is read changes. A signal ends it, as it ends any run.
[[noreturn]] void run_and_watch(const std::vector<std::string>& pipelines, const PipelineOptions& options,
                                const CommandLine& line, const Console& console) {
    if (std::find(pipelines.begin(), pipelines.end(), "-") != pipelines.end())
        throw Error(ErrorKind::usage, "E-ARGUMENT",
                    "--watch cannot read a pipeline from standard input again", "give it as a file",
                    line.find("--watch"));
    for (std::size_t number = 1;; ++number) {
        Watch watch;
        for (const auto& pipeline : pipelines) watch.add(pipeline);
        for (const auto& preset : options.presets) watch.add(preset);
        int code = 0;
        try {
            code = run(pipelines, options, line, console, &watch);
        } catch (const Error& e) { // a pipeline that is gone; it may come back
            console.diagnostics(e);
            code = static_cast<int>(e.kind());
        }
        console.event({{"level", "info"}, {"event", "watch"}, {"number", number}, {"exit_code", code}});
        if (!console.json)
            console.say(
                fmt::format("exit code {}; watching {}, Ctrl-C ends", code, counted(watch.size(), "file")));
        const auto changed = watch.wait();
        console.say(fmt::format("{} has changed", changed.string()));
    }
}

} // namespace

Command run_command() {
    return {"run", "Runs pipelines.", run_examples, false, [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<PipelineOptions>();
                auto pipelines = std::make_shared<std::vector<std::string>>();
                arguments.add("PIPELINE", pipelines.get(), "YAML files, - or ready pipelines.").required();
                auto watch = std::make_shared<bool>(false);
                arguments.add("--watch", watch.get(),
                              "Run again whenever a pipeline or a file that it reads changes; Ctrl-C ends.");
                add_value_options(arguments, *options);
                add_run_options(arguments, *options);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    if (*watch) run_and_watch(*pipelines, *options, invocation.line, console);
                    return run(*pipelines, *options, invocation.line, console, nullptr);
                };
            }};
}

} // namespace facetmill::cli
