// facetmill run: runs pipelines in order, after planning all of them.

#include "base/text/words.hpp"
#include "cli/pipeline_options.hpp"
#include "cli/watch.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <optional>
#include <set>

namespace facetmill::cli {

namespace {

constexpr const char* run_examples =
    R"(A PIPELINE is a YAML file, "-" for standard input, or the name of a built-in pipeline: facetmill new lists them
with their params. A mesh file after it is the value of its param input.

Examples
  facetmill run scan.yaml
  facetmill run web lamp.obj
  facetmill run scan-to-web -D input=scan.ply -D keep=10% --output-dir web
  facetmill run scan.yaml --set simplify.ratio=5% --report scan.html --strict
  facetmill run scan.yaml --depfile scan.d          (for Make and Ninja)
  facetmill run scan.yaml -D input=scan.ply --watch (again whenever scan.yaml or scan.ply changes)
)";

/// Two pipelines of a run must not write the same file, because the second would replace the first's output.
void refuse_common_outputs(std::vector<pipeline::Plan>& plans, Problems& problems) {
    std::set<std::filesystem::path> seen;
    for (auto& plan : plans) {
        for (const auto& output : pipeline::planned_outputs(plan))
            if (output != "-" && !seen.insert(output.lexically_normal()).second) {
                plan.files_collide = true;
                problems.add({}, "E-DUPLICATE-OUTPUT",
                             fmt::format("{}: another pipeline of this run also writes '{}'", plan.name,
                                         output.generic_string()));
            }
    }
}

/// Options that name a single file need a single pipeline.
void check_single(const std::vector<std::string>& pipelines, const PipelineOptions& options,
                  const CommandLine& line, Problems& problems) {
    const std::pair<const char*, bool> of_one[] = {{"--depfile", !options.depfile.empty()},
                                                   {"--report", !options.reports.empty()},
                                                   {"--timings", !options.timings.empty()}};
    for (const auto& [option, is_given] : of_one)
        if (pipelines.size() > 1 && is_given)
            problems.add(line.find(option), "E-ARGUMENT",
                         fmt::format("{} accepts one pipeline, found {}", option, pipelines.size()),
                         "run them separately");
}

struct Planned {
    std::vector<pipeline::Plan> plans; ///< plans of the pipelines
    Problems problems;
};

/// on_include: see PlanSettings.
Planned plan_all(const std::vector<std::string>& pipelines, const PipelineOptions& options,
                 const CommandLine& line, std::function<void(const std::filesystem::path&)> on_include) {
    Planned all;
    auto settings = plan_settings(options, line, all.problems);
    settings.on_include = std::move(on_include);
    check_single(pipelines, options, line, all.problems);
    all.plans.reserve(pipelines.size());
    for (const auto& pipeline : pipelines) all.plans.push_back(plan_of(pipeline, settings, all.problems));
    if (!all.problems.any_errors() && all.plans.size() > 1) refuse_common_outputs(all.plans, all.problems);
    return all;
}

/// on_written: receives the written files of each run if others follow, otherwise empty.
int run_all(const std::vector<std::string>& pipelines, const Planned& all, const PipelineOptions& options,
            const Console& console, const std::function<void(const std::filesystem::path&)>& on_written) {
    if (refused(all.plans, all.problems, console)) return static_cast<int>(ErrorKind::usage);
    if (!on_written) confine_to(all.plans, options, console);
    int worst = 0;
    for (std::size_t i = 0; i < all.plans.size(); ++i) {
        std::vector<std::filesystem::path> written;
        const int code = run_with_messages(all.plans[i], options, console,
                                           is_pipeline_file(pipelines[i]) ? pipelines[i] : "",
                                           on_written ? &written : nullptr);
        for (const auto& path : written) on_written(path);
        if (worst == 0) worst = code;
    }
    return worst;
}

/// Watches the inputs of the plans, except files that this run writes, because a run would otherwise trigger
/// the next. With errors, only inputs that need no access to files.
void watch_inputs(const Planned& all, Watch& watch) {
    std::vector<pipeline::Headers> headers(all.plans.size());
    for (std::size_t i = 0; i < all.plans.size(); ++i) {
        const auto& plan = all.plans[i];
        if (!all.problems.any_errors()) headers[i] = pipeline::read_headers(plan);
        for (const auto& output : pipeline::planned_outputs(plan, headers[i])) watch.leave_out(output);
        for (const auto& file : plan.others)
            if (file.written) watch.leave_out(file.path);
    }
    for (std::size_t i = 0; i < all.plans.size(); ++i) {
        for (const auto& input : pipeline::planned_inputs(all.plans[i], headers[i])) watch.add(input);
        for (const auto& pattern : pipeline::planned_patterns(all.plans[i])) watch.add_pattern(pattern);
    }
}

[[noreturn]] void refuse_stream(const char* what, const Mark& where) {
    throw Error(ErrorKind::usage, "E-ARGUMENT",
                fmt::format("--watch cannot read {} from standard input again", what), "use a file instead",
                where);
}

void refuse_streams(const std::vector<pipeline::Plan>& plans) {
    for (const auto& plan : plans)
        for (const auto& file : pipeline::planned_files(plan.steps, plan.places))
            if (!file.written && file.path == "-") refuse_stream("an input", file.where);
}

/// The exit code of body. An Error, for example of a missing file, is printed, because the file may come
/// back.
template <class Body>
int code_of(const Console& console, Body&& body) {
    try {
        return body();
    } catch (const Error& e) {
        console.diagnostics(e);
        return static_cast<int>(e.kind());
    }
}

/// Runs, and runs again whenever an input changes. A signal ends it like any run.
[[noreturn]] void run_and_watch(const std::vector<std::string>& pipelines, const PipelineOptions& options,
                                const CommandLine& line, const Console& console) {
    if (std::find(pipelines.begin(), pipelines.end(), "-") != pipelines.end())
        refuse_stream("a pipeline", line.find("--watch"));
    confine_calls_only(options.sandbox); // the files of the next plan are not yet known
    Watch last;
    for (std::size_t number = 1;; ++number) {
        Watch watch;
        for (const auto& pipeline : pipelines)
            if (is_pipeline_file(pipeline)) watch.add(pipeline);
        for (const auto& preset : options.presets) watch.add(preset);
        std::optional<Planned> planned;
        int code = code_of(console, [&] {
            planned = plan_all(pipelines, options, line, [&](const auto& file) { watch.add(file); });
            return 0;
        });
        if (planned) {
            refuse_streams(planned->plans);
            watch_inputs(*planned, watch);
        }
        // The inputs of a failed plan are unknown, so the last plan's inputs are watched.
        if (!planned || planned->problems.any_errors()) watch.add_all(last);
        // Some names of outputs are known only now.
        const auto on_written = [&](const auto& file) { watch.leave_out(file); };
        if (planned)
            code =
                code_of(console, [&] { return run_all(pipelines, *planned, options, console, on_written); });
        console.event({{"level", "info"}, {"event", "watch"}, {"number", number}, {"exit_code", code}});
        if (!console.json)
            console.say(fmt::format("exit code {}; watching {}; press Ctrl-C to stop", code,
                                    counted(watch.size(), "file")));
        const auto changed = watch.wait();
        console.say(fmt::format("{} has changed", changed.generic_string()));
        last = std::move(watch);
    }
}

} // namespace

Command run_command() {
    return {"run", "Runs pipelines.", run_examples, {}, [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<PipelineOptions>();
                auto pipelines = std::make_shared<std::vector<std::string>>();
                arguments
                    .add("PIPELINE", pipelines.get(),
                         "YAML files, - or built-in pipelines, and possibly a mesh.")
                    .required();
                auto watch = std::make_shared<bool>(false);
                arguments.add("--watch", watch.get(),
                              "Runs again whenever a pipeline or an input changes. Ctrl-C ends it.");
                add_value_options(arguments, *options);
                add_run_options(arguments, *options);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    take_input(*pipelines, *options, invocation.line);
                    options->cells = cell_settings(*options, invocation.line);
                    if (*watch) run_and_watch(*pipelines, *options, invocation.line, console);
                    return run_all(*pipelines, plan_all(*pipelines, *options, invocation.line, {}), *options,
                                   console, {});
                };
            }};
}

} // namespace facetmill::cli
