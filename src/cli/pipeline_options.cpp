#include "cli/pipeline_options.hpp"

#include "base/fast_json.hpp"
#include "base/lazy.hpp"
#include "base/math/numbers.hpp"
#include "base/message_ids.hpp"
#include "base/text/markup.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "cli/depfile.hpp"
#include "cli/warning_limiter.hpp"
#include "docs/ready.hpp"
#include "io/codec.hpp"
#include "io/other_formats.hpp"
#include "io/outputs/output_files.hpp"
#include "io/outputs/outputs.hpp"
#include "options/byte_count.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"
#include "report/render.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::cli {

namespace fs = std::filesystem;

void add_message_options(Arguments& arguments, Console& console) {
    arguments.add("-q,--quiet", &console.quiet, "Prints only warnings and errors.").under("Messages");
    arguments
        .add("-v,--verbose", &console.verbose,
             "Also prints each stage when it starts, and the resolved values.")
        .under("Messages");
    arguments
        .add(
            "--log", [&console](const std::string& form) { console.json = form == "json"; },
            "The format of messages: text, or json (one object per line).")
        .one_of({"text", "json"})
        .under("Messages");
}

void add_param_options(Arguments& arguments, PipelineOptions& options) {
    arguments.add("-D,--define", &options.defines, "A param of the pipeline: -D name=value.");
    arguments.add(
        "-p,--preset", &options.presets,
        "A YAML file of params (keep: 10%). Paths in it are relative to the file. -D overrides it.");
    arguments.add("--set", &options.sets, "An option of a stage: --set simplify.ratio=10%.");
    add_asset_root_option(arguments, options.asset_roots);
}

void add_value_options(Arguments& arguments, PipelineOptions& options) {
    add_param_options(arguments, options);
    arguments.add("--update-baseline", &options.update_baseline,
                  "Writes the current failures to the baselines of stages, so that they pass.");
}

void add_warning_options(Arguments& arguments, PipelineOptions& options) {
    arguments.add("--strict", &options.strict,
                  "Turns warnings into errors: --strict for all, --strict=ID for one.");
    arguments
        .add("--allow", &options.allowed,
             "The id of a warning to hide. It does not fail under --strict. Also: --quiet=ID.")
        .suggests(warning_ids);
    arguments.add("--check-invariants", &options.check_invariants, "Checks every mesh after every stage.")
        .hidden();
}

void add_sync_option(Arguments& arguments, PipelineOptions& options) {
    arguments.add("--no-sync", &options.no_sync,
                  "Does not wait until outputs are on the disk. After a power failure they may be empty.");
}

std::uint64_t memory_bytes(const std::string& text, const CommandLine& line) {
    if (text.empty()) return 0;
    const Value value = Value::scalar(text, line.value(text));
    Problems problems;
    std::optional<double> bytes;
    if (!text.ends_with('%'))
        bytes = read_byte_count(value, problems);
    else if (const auto share = parse_real(std::string_view(text).substr(0, text.size() - 1)))
        bytes = static_cast<double>(memory_there()) * std::min(*share, 100.0) / 100;
    if (bytes && *bytes > 0) return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(*bytes));
    const std::string hint = problems.all().empty() ? "" : problems.all().front().hint;
    throw Error(ErrorKind::usage, "E-ARGUMENT", fmt::format("--memory needs a size, found '{}'", text),
                hint.empty() ? "for example 8GB (1000000000 bytes each), 8GiB or 8G (1073741824), or 50%"
                             : hint,
                value.mark);
}

void add_partition_option(Arguments& arguments, PipelineOptions& options) {
    arguments
        .add(
            "--partition", &options.partition,
            "When the first stages work on cells on disk: auto (if --memory is too small),\nalways or never.")
        .one_of({"auto", "always", "never"});
}

void add_cell_options(Arguments& arguments, PipelineOptions& options) {
    arguments.add("--memory", &options.memory,
                  "The memory for the run: 2G, 500MB, or 50% of the available memory. Larger meshes\nare "
                  "processed in cells on disk (see --partition). Default: no limit.");
    add_partition_option(arguments, options);
    arguments.add("--scratch", &options.scratch,
                  "The folder for temporary data of cells. Default: the folder of --keep-cells, or "
                  "the\noutput folder.");
    arguments.add("--keep-cells", &options.kept_cells,
                  "Keeps cells in the folder DIR. An interrupted run, or another run with the same\ninputs, "
                  "continues with these cells.");
}

namespace {

/// "cells", or "3/16": the third of 16 jobs. Throws a usage error (E-ARGUMENT).
cells::CellJob cell_job(const std::string& text, const CommandLine& line) {
    cells::CellJob job;
    if (text == "cells") return job;
    const auto slash = text.find('/');
    const auto number = parse_integer(std::string_view(text).substr(0, slash));
    const auto of =
        slash == text.npos ? std::nullopt : parse_integer(std::string_view(text).substr(slash + 1));
    constexpr std::int64_t most = 100000;
    if (!number || !of || *number < 1 || *of < *number || *of > most)
        throw Error(ErrorKind::usage, "E-ARGUMENT", fmt::format("--cells-job needs a job, found '{}'", text),
                    "give cells, or for example 3/16 for the third job of 16", line.value(text));
    return {static_cast<std::size_t>(*number), static_cast<std::size_t>(*of)};
}

} // namespace

pipeline::CellSettings cell_settings(const PipelineOptions& options, const CommandLine& line) {
    using When = pipeline::CellSettings::When;
    pipeline::CellSettings settings;
    settings.when = options.partition == "always"  ? When::always
                    : options.partition == "never" ? When::never
                                                   : When::automatic;
    settings.memory = memory_bytes(options.memory, line);
    set_memory_limit(settings.memory);
    settings.kept = options.kept_cells;
    if (!settings.kept.empty() && settings.memory == 0 && settings.when == When::automatic)
        throw Error(ErrorKind::usage, "E-ARGUMENT", "--keep-cells needs a run in cells",
                    "set the memory with --memory 2G, or use --partition always",
                    line.value(options.kept_cells));
    if (!options.cells_job.empty()) settings.job = cell_job(options.cells_job, line);
    if (settings.job && (settings.kept.empty() || settings.when == When::never))
        throw Error(ErrorKind::usage, "E-ARGUMENT", "--cells-job needs a run that keeps its cells",
                    "give the folder: --keep-cells DIR", line.value(options.cells_job));
    if (settings.job)
        for (const auto& [option, is_given] : {std::pair{"--report", !options.reports.empty()},
                                               {"--timings", !options.timings.empty()},
                                               {"--depfile", !options.depfile.empty()}})
            if (is_given)
                throw Error(ErrorKind::usage, "E-CONFLICT",
                            fmt::format("--cells-job only writes cells, so {} cannot be used", option),
                            "use it in the last run, which continues with the cells", line.find(option));
    settings.scratch = !options.scratch.empty() ? options.scratch : options.kept_cells;
    if (settings.scratch.empty()) settings.scratch = options.output_dir;
    if (settings.scratch.empty()) settings.scratch = ".";
    return settings;
}

void add_run_options(Arguments& arguments, PipelineOptions& options) {
    add_threads_option(arguments, options.threads,
                       "The number of threads. It does not change the result. Default: all cores.");
    arguments.add("-o,--output-dir", &options.output_dir,
                  "The folder for relative paths of outputs. Default: the working directory.");
    arguments.add("--report", &options.reports,
                  "Also writes a report into the output folder: F.json, F.html, F.md, F.xml (JUnit) or "
                  "F.txt.\n- writes "
                  "JSON to standard output.");
    arguments.add("--timings", &options.timings,
                  "Writes times, memory and threads to F.json, or a report page with them to F.html.\nOther "
                  "reports omit them so that they are reproducible.");
    arguments.add("--depfile", &options.depfile, "Writes the input and output files as a Make rule.");
    arguments.add("--depfile-target", &options.depfile_target,
                  "The target of that rule. Default: the first output file.");
    arguments.add("--restat", &options.restat,
                  "Keeps the times of unchanged outputs and reports, for Ninja's restat.");
    add_sync_option(arguments, options);
    add_cell_options(arguments, options);
    arguments.add("--cells-job", &options.cells_job,
                  "Runs one of several jobs that share --keep-cells: cells makes the cells, and 3/16\nis the "
                  "third of 16 jobs that simplify. It has no outputs.\nfacetmill export writes such jobs.");
    add_cache_options(arguments, options.cache);
    arguments.add("--explain", &options.explain,
                  "Prints for each stage why it ran again, or that its result is from the cache.");
    add_sandbox_option(arguments, options.sandbox);
    add_warning_options(arguments, options);
}

namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

Pairs split_pairs(const std::vector<std::string>& texts, const char* option, const CommandLine& line,
                  Problems& problems) {
    Pairs pairs;
    for (const auto& text : texts) {
        const auto at = text.find('=');
        if (at != text.npos && at > 0) {
            pairs.emplace_back(text.substr(0, at), text.substr(at + 1));
            continue;
        }
        problems.add(line.find(text), "E-ARGUMENT",
                     fmt::format("{} needs name=value, found '{}'", option, text));
    }
    return pairs;
}

/// The path of a report or of times relative to --output-dir: "checked/r.json" with -o checked is "r.json".
std::string below_output_dir(const std::string& path, const std::string& folder) {
    if (folder.empty() || path == "-" || fs::path(path).is_absolute()) return path;
    const fs::path below = fs::absolute(path).lexically_normal().lexically_relative(
        (fs::absolute(folder) / "").lexically_normal());
    return below.empty() || *below.begin() == ".." ? path : below.generic_string();
}

std::string timings_of(const PipelineOptions& options) {
    return below_output_dir(options.timings, options.output_dir);
}

/// A misspelled id would silently disable a gate.
void check_ids(const std::vector<std::string>& given, const std::string& option, const CommandLine& line,
               Problems& problems) {
    const auto ids = warning_ids();
    for (const auto& id : given)
        if (std::find(ids.begin(), ids.end(), id) == ids.end())
            problems.add(line.value(id), "E-STRICT",
                         fmt::format("{}: warning '{}' does not exist", option, id),
                         did_you_mean(id, ids, "facetmill explain lists the warnings"));
}

} // namespace

pipeline::PlanSettings plan_settings(const PipelineOptions& options, const CommandLine& line,
                                     Problems& problems) {
    pipeline::PlanSettings settings;
    settings.defines = split_pairs(options.defines, "-D", line, problems);
    settings.sets = split_pairs(options.sets, "--set", line, problems);
    settings.update_baselines = options.update_baseline;
    settings.places.output_base = options.output_dir;
    settings.places.asset_roots.assign(options.asset_roots.begin(), options.asset_roots.end());
    auto strict = options.strict;
    std::erase(strict, "*"); // --strict alone
    check_ids(strict, "--strict", line, problems);
    check_ids(options.allowed, "--allow", line, problems);
    settings.allowed = options.allowed;
    settings.working_directory = fs::current_path();
    for (const auto& report : options.reports)
        settings.extra_reports.push_back(below_output_dir(report, options.output_dir));
    for (auto file = options.presets.rbegin(); file != options.presets.rend(); ++file) {
        try {
            pipeline::add_preset(*file, settings, problems);
        } catch (Error& e) {
            throw e.at(line.value(*file));
        }
    }
    if (!options.timings.empty())
        settings.others.push_back(
            {settings.places.output(timings_of(options)), line.find("--timings"), true});
    if (!options.depfile.empty()) settings.others.push_back({options.depfile, line.find("--depfile"), true});
    return settings;
}

namespace {

[[noreturn]] void refuse_unknown(const std::string& pipeline) {
    const auto names = docs::ready_names();
    const std::string near = nearest(pipeline, names);
    throw Error(ErrorKind::missing, "E-FILE", fmt::format("pipeline '{}' does not exist", pipeline),
                near.empty()
                    ? fmt::format("give a YAML file, or a built-in pipeline: {}", fmt::join(names, ", "))
                    : fmt::format("did you mean the built-in pipeline '{}'?", near));
}

/// Whether a file with an unknown suffix has the contents of a mesh: a GLB named avatar.vrm.
bool is_mesh_by_bytes(const std::string& name) {
    std::error_code trouble;
    if (!fs::is_regular_file(name, trouble)) return false;
    const auto* codec = io::sure_codec(io::Input::open(name));
    return codec && codec->read && codec->name != "gltf";
}

} // namespace

void take_input(std::vector<std::string>& pipelines, PipelineOptions& options, const CommandLine& line) {
    const auto is_pipeline = [](const std::string& name) {
        const auto* codec = io::codec_for(name);
        const bool is_yaml = name.ends_with(".yaml") || name.ends_with(".yml");
        return is_yaml ||
               (!(codec && codec->read) && io::hint_for_reading(name).empty() && !is_mesh_by_bytes(name));
    };
    const auto first = std::stable_partition(pipelines.begin(), pipelines.end(), is_pipeline);
    if (first == pipelines.end()) return;
    const std::string mesh = *first;
    if (first == pipelines.begin())
        throw Error(
            ErrorKind::usage, "E-ARGUMENT", fmt::format("'{}' is a mesh, not a pipeline", mesh),
            fmt::format("facetmill run web {0} makes a GLB of it; facetmill info {0} shows its properties",
                        for_shell(mesh)),
            line.value(mesh));
    if (pipelines.end() - first > 1) {
        std::string batch = fmt::format("facetmill batch {}", for_shell(pipelines.front()));
        for (auto one = first; one != pipelines.end(); ++one) batch += " --input " + for_shell(*one);
        throw Error(ErrorKind::usage, "E-ARGUMENT",
                    fmt::format("a run takes one mesh, found {}", pipelines.end() - first), batch + " -o out",
                    line.value(*(first + 1)));
    }
    options.defines.push_back("input=" + mesh);
    pipelines.erase(first, pipelines.end());
}

bool is_pipeline_file(const std::string& pipeline) {
    if (pipeline == "-") return false;
    std::error_code trouble;
    if (docs::ready_pipeline(pipeline))
        return fs::exists(pipeline, trouble) && !fs::is_directory(pipeline, trouble);
    return fs::exists(pipeline, trouble) || trouble;
}

std::pair<pipeline::PipelineSource, std::string> source_of(const std::string& pipeline) {
    const bool is_file = pipeline == "-" || is_pipeline_file(pipeline);
    const auto* ready = is_file ? nullptr : docs::ready_pipeline(pipeline);
    if (!is_file && !ready) refuse_unknown(pipeline);
    if (ready) return {{std::string(ready->text), {}}, pipeline};
    return {pipeline::read_pipeline(pipeline), ""};
}

namespace {

/// The command line that runs it with the same values; empty if a preset sets any.
std::string command_for(const std::string& pipeline, const pipeline::PlanSettings& settings) {
    if (!settings.defined_at.empty()) return {};
    std::string line = "facetmill run " + for_shell(pipeline);
    for (const auto& [name, value] : settings.defines)
        line += fmt::format(" -D {}", for_shell(fmt::format("{}={}", name, value)));
    for (const auto& [option, value] : settings.sets)
        line += fmt::format(" --set {}", for_shell(fmt::format("{}={}", option, value)));
    for (const auto& folder : settings.places.asset_roots)
        line += fmt::format(" --asset-root {}", for_shell(folder.generic_string()));
    return line;
}

} // namespace

pipeline::Plan plan_of(const std::string& pipeline, pipeline::PlanSettings settings, Problems& problems) {
    settings.command = command_for(pipeline, settings);
    auto [source, name] = source_of(pipeline);
    settings.name = name;
    return pipeline::plan_source(source, std::move(settings), problems);
}

namespace {

/// The record with the paths of outputs and reports relative to the working directory.
report::RunRecord located(report::RunRecord record, const Folders& places) {
    for (auto& file : record.outputs) file.path = places.output(file.path).generic_string();
    for (auto& report : record.reports) report = places.output(report).generic_string();
    return record;
}

/// Prints the result, as text or as an object. Warnings and errors were already printed.
void summarise(const report::RunRecord& record, const Console& console) {
    Json outputs = Json::array();
    for (const auto& file : record.outputs) outputs.push_back(file.path);
    console.event({{"level", "info"},
                   {"event", "end"},
                   {"pipeline", record.pipeline},
                   {"exit_code", record.exit_code},
                   {"outputs", outputs},
                   {"reports", record.reports},
                   {"seconds", record.seconds}});
    if (!console.json) console.say(report::to_terminal(record, console.colour()));
}

} // namespace

void tell_resolved(const report::StageRecord& stage, const Console& console) {
    for (const auto& [option, given, is] : stage.resolved)
        console.say(
            fmt::format("  {}: {} {} is {} in scene units", stage.name, option, given, Json(is).dump()));
}

void tell_stage(const report::StageRecord& stage, const std::string& asset, const Console& console) {
    const auto faces = [](const std::optional<report::Brief>& brief) {
        return brief ? Json(brief->faces) : Json();
    };
    Json event = {{"level", "info"},
                  {"event", "stage"},
                  {"name", stage.name},
                  {"stage", stage.stage},
                  {"seconds", stage.seconds},
                  {"faces_before", faces(stage.before)},
                  {"done", stage.after.has_value()},
                  {"faces_after", faces(stage.after)}};
    if (!asset.empty()) event["asset"] = asset;
    console.event(event);
}

namespace {

/// The outputs except files that are also inputs.
std::vector<fs::path> newly_written(const report::RunRecord& record) {
    std::set<fs::path> inputs;
    for (const auto& input : record.inputs) inputs.insert(io::identity(input.path));
    std::vector<fs::path> written;
    for (const auto& output : record.outputs)
        if (!inputs.contains(io::identity(output.path))) written.emplace_back(output.path);
    return written;
}

/// Reports results from the cache, which explain stages that took no time.
void tell_recalled(const pipeline::Trace& trace, const Console& console) {
    const auto recalled = std::count_if(trace.begin(), trace.end(), [](const pipeline::TracedStep& step) {
        return step.way == pipeline::TracedStep::Way::recalled;
    });
    if (recalled > 0 && !console.json)
        console.say(fmt::format("{} of {} from the cache (--explain lists them, --no-cache runs all)",
                                recalled, counted(trace.size(), "stage")));
}

} // namespace

void confine_to(const std::vector<pipeline::Plan>& plans, const PipelineOptions& options,
                const Console& console) {
    AllowedFiles allowed;
    for (const auto& plan : plans) {
        start_programs(plan);
        allow_plan(allowed, plan);
    }
    if (const auto folder = cache_folder(options.cache)) allowed.written.push_back(*folder);
    if (options.cells.when != pipeline::CellSettings::When::never &&
        (options.cells.memory > 0 || options.cells.when == pipeline::CellSettings::When::always))
        for (const auto& folder : {options.cells.scratch, options.cells.kept})
            if (!folder.empty()) allowed.written.push_back(folder);
    confine(allowed, options.sandbox, console);
}

int run_with_messages(const pipeline::Plan& plan, const PipelineOptions& options, const Console& console,
                      const std::string& pipeline_file, std::vector<std::filesystem::path>* written) {
    if (!options.depfile.empty()) require_spellable(options.depfile_target, plan);
    set_threads(options.threads);
    const auto progress = console.progress();
    pipeline::RunSettings settings;
    settings.progress = progress.get();
    settings.strict = options.strict;
    settings.cells = options.cells;
    settings.on_kept_cells = [&](const std::string& what) { console.say(what); };
    settings.check_invariants = options.check_invariants;
    const Lazy<std::vector<std::filesystem::path>> inputs([&] { return pipeline::inputs_of_steps(plan); });
    WarningLimiter few(console);
    const auto tell = [&](const Diagnostic& d) { few.tell(pipeline::about_input(*inputs, d)); };
    settings.on_warning = tell;
    settings.on_stage = [&](const report::StageRecord& stage) {
        tell_stage(stage, "", console);
        if (console.verbose) tell_resolved(stage, console);
    };
    const auto store = store_for(options.cache, plan.allowed, console, options.explain || console.verbose);
    settings.store = store.get();
    settings.commit = {.keep_unchanged = options.restat, .sync = !options.no_sync};
    Json view; // view of the page with times
    if (options.timings.ends_with(".html")) settings.on_view = [&](const Json& shown) { view = shown; };
    if (options.explain && !store)
        console.say("--explain has nothing to compare with because no cache is used (--no-cache, "
                    "FACETMILL_CACHE=off, CI=true without --cache, or no HOME)");
    pipeline::Trace trace;
    if (store)
        settings.on_trace = [&](const pipeline::Trace& all) {
            trace = all;
            if (options.explain)
                for (const auto& line : pipeline::explained(trace, plan, pipeline_file, *store))
                    console.say(line);
        };
    auto record = located(pipeline::run_plan(plan, settings), plan.places);
    if (written) *written = newly_written(record);
    if (store) pipeline::remember(trace, plan, pipeline_file, record.exit_code == 0, *store);
    if (progress) progress->done();
    for (const auto& error : record.errors) tell(error);
    few.finish();
    summarise(record, console);
    if (!options.explain) tell_recalled(trace, console);
    const bool writable =
        record.exit_code != static_cast<int>(ErrorKind::output); // output errors are already reported
    if (!options.timings.empty() && writable) {
        const std::string text = options.timings.ends_with(".html")
                                     ? report::to_html_with_times(record, view)
                                     : report::timings_json(record).dump(2) + "\n";
        io::write_now(plan.places.output(timings_of(options)), std::as_bytes(std::span(text)));
    }
    if (record.exit_code == 0 && !options.depfile.empty())
        write_depfile(options.depfile, options.depfile_target, pipeline_file, plan, record);
    for (auto& stage : record.stages) destroy(stage.result); // large for scenes of many parts
    return record.exit_code;
}

bool refused(const std::vector<pipeline::Plan>& plans, const Problems& problems, const Console& console) {
    if (!problems.any_errors()) return false; // warnings come with the run
    for (const auto& problem : problems.all()) console.diagnostic(problem);
    const auto collides = [](const pipeline::Plan& plan) { return plan.files_collide; };
    if (std::any_of(plans.begin(), plans.end(), collides)) return true; // a report might replace an input
    for (const auto& plan : plans)
        for (const auto& report : pipeline::report_refusal(plan, problems))
            console.say(fmt::format("report {}", plan.places.output(report).generic_string()));
    return true;
}

void settle(const Problems& problems, const Console& console) {
    if (problems.any_errors()) {
        problems.throw_if_any(ErrorKind::usage);
        return;
    }
    for (const auto& warning : problems.all()) console.diagnostic(warning);
}

void settle(const std::vector<Error>& errors) {
    std::vector<Diagnostic> all;
    for (const auto& error : errors)
        all.insert(all.end(), error.diagnostics().begin(), error.diagnostics().end());
    if (!all.empty()) throw Error(errors.front().kind(), std::move(all));
}

void plan_each(const std::vector<std::string>& pipelines, const PipelineOptions& options,
               const CommandLine& line, const Console& console,
               const std::function<void(const std::string& pipeline, const pipeline::Plan&)>& look) {
    Problems problems;
    auto settings = plan_settings(options, line, problems);
    settings.parameters_needed = false;
    std::vector<Error> of_inputs;
    for (const auto& pipeline : pipelines) {
        Problems of_this;
        try {
            const auto plan = plan_of(pipeline, settings, of_this);
            if (!of_this.any_errors()) look(pipeline, plan);
        } catch (const Error& error) { // the others are still checked
            of_inputs.push_back(error);
        }
        if (of_this.size() > 0) problems.add(Error(ErrorKind::usage, of_this.all()));
    }
    if (problems.any_errors())
        for (const auto& error : of_inputs) problems.add(error);
    settle(problems, console);
    settle(of_inputs);
}

} // namespace facetmill::cli
