// facetmill export: the runs of many assets as a workflow for Ninja, Make or Snakemake.

#include "cells/partition/kept_partition.hpp"
#include "cli/assets.hpp"
#include "cli/workflow.hpp"
#include "platform/confined_program.hpp"
#include "platform/cores.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* export_examples =
    R"(Writes one job per asset, or per shard of several assets. Each job lists its known inputs and outputs, the number
of threads and an estimate of the memory. Snakemake uses threads and memory for scheduling. Ninja gets pools, so
that parallel jobs fit into the cores of this machine and into --memory. Make supports neither, so the Makefile
recommends a suitable -j.

Each job also depends on the executable. For Make and Ninja, a depfile in .facetmill-depfiles adds the files that the
run read. Ninja gets no depfile with --shard, or for names that contain characters such as ' " &.

The assets of a shard run one after the other. If one fails, the others still run, and the job fails with the exit
code of the last failure. Snakemake then removes all outputs of the job. Make and Ninja keep them and run the
whole shard again. Paths are relative to the working directory, so run the workflow there. The outputs are byte
for byte the same as with `facetmill batch` and the same options.

--keep-cells divides a single run that simplifies a mesh larger than memory. The first job makes the cells,
--cell-jobs jobs simplify some cells each, and the last job is the run itself. Its outputs are byte for byte the
same as with `facetmill run` and the same --memory. Killed jobs continue where they stopped.

Examples
  facetmill export --to ninja scan-to-web --input 'scans/**/*.ply' -o web > build.ninja && ninja
  facetmill export --to make scan.yaml --table params.csv -o web > assets.mk && make -f assets.mk -j4
  facetmill export --to snakemake scan.yaml --input 'scans/**/*.ply' -o web > Snakefile
  snakemake -j4                        (here; on a cluster by a profile: snakemake --profile slurm)
  facetmill export --to snakemake scan.yaml --table params.csv -o web --shard 100 > Snakefile
  facetmill export --to ninja huge.yaml --memory 2G --keep-cells cells -o web > build.ninja && ninja
)";

struct ExportOptions : AssetOptions {
    std::string engine;
    int shard = 1;
    int cell_jobs = 0; ///< 0: chosen by the size of the input
};

/// The command line of a run.
std::vector<std::string> arguments_of(const ExportOptions& options, const pipeline::PlanSettings& own) {
    std::vector<std::string> arguments{"run", options.pipeline};
    const auto give = [&](const char* option, const std::string& name, const std::string& value) {
        arguments.emplace_back(option);
        arguments.push_back(fmt::format("{}={}", name, value));
    };
    for (const auto& preset : options.common.presets) {
        arguments.emplace_back("--preset");
        arguments.push_back(preset);
    }
    for (const auto& [name, value] : own.defines)
        if (!own.defined_in.contains(name)) give("-D", name, value); // otherwise the preset defines it
    for (const auto& [name, value] : own.sets) give("--set", name, value);
    for (const auto& id : options.common.strict)
        arguments.push_back(id == "*" ? "--strict" : "--strict=" + id);
    for (const auto& id : options.common.allowed) {
        arguments.emplace_back("--allow");
        arguments.push_back(id);
    }
    for (const auto& folder : options.common.asset_roots) {
        arguments.emplace_back("--asset-root");
        arguments.push_back(folder);
    }
    const std::string threads = std::to_string(options.common.threads);
    for (const std::string& argument : {std::string("--output-dir"), own.places.output_base.generic_string(),
                                        std::string("--threads"), threads, std::string("--quiet")})
        arguments.push_back(argument);
    return arguments;
}

/// The pipeline, if it is a file that still exists when the jobs run.
std::vector<std::string> pipeline_as_input(const ExportOptions& options) {
    std::error_code ignored; // a shell's pipe is gone when the job runs
    if (is_pipeline_file(options.pipeline) && !std::filesystem::is_fifo(options.pipeline, ignored))
        return {options.pipeline};
    return {};
}

/// The run of an asset.
Job job_of(const batch::Work& work, const ExportOptions& options, const pipeline::PlanSettings& of_all) {
    const auto own = settings_for(work.asset, of_all);
    Job job{work.asset.name, {arguments_of(options, own)}, pipeline_as_input(options), {}, work.memory};
    for (const auto& input : work.inputs) {
        std::error_code unknown; // a missing .mtl or image stops no run, but would stop Ninja and Make
        const bool exists = std::filesystem::exists(input, unknown) || unknown;
        (exists ? job.inputs : job.absent).push_back(input.generic_string());
    }
    for (const auto& output : work.outputs) job.outputs.push_back(output.generic_string());
    if (!job.outputs.empty()) job.targets = {job.outputs.front()};
    return job;
}

/// Divides a run into jobs that share --keep-cells: a job that makes the cells, the simplifying jobs, and
/// the run itself. Each job writes the files that it declares, and no other job writes them.
std::vector<Job> cell_jobs(const ExportOptions& options, const CommandLine& line,
                           const pipeline::PlanSettings& settings, Problems& problems) {
    const auto plan = plan_of(options.pipeline, settings, problems);
    problems.throw_if_any(ErrorKind::usage);
    auto missing = pipeline::missing_inputs(plan);
    if (!missing.empty()) throw Error(ErrorKind::missing, std::move(missing));
    pipeline::CellSettings cell = cell_settings(options.common, line);
    const auto divided = pipeline::plan_cell_jobs(plan, cell, static_cast<std::size_t>(options.cell_jobs));
    auto arguments = arguments_of(options, settings);
    for (const std::string& argument :
         {std::string("--partition"), std::string("always"), std::string("--memory"), options.common.memory,
          std::string("--keep-cells"), options.common.kept_cells})
        arguments.push_back(argument);
    auto inputs = pipeline_as_input(options);
    for (const auto& path : divided.inputs)
        if (path != options.pipeline) inputs.push_back(path.generic_string());
    const auto kept = [&](const std::string& name) { return (cell.kept / name).generic_string(); };
    std::vector<Job> jobs;
    const auto add = [&](const std::string& name, const std::string& job) -> Job& {
        jobs.push_back({name, {arguments}, inputs, {}, cell.memory});
        if (!job.empty())
            jobs.back().runs.front().insert(jobs.back().runs.front().end(), {"--cells-job", job});
        return jobs.back();
    };
    Job& first = add("the cells of " + plan.name, "cells");
    for (const char* name : cells::kept_files) first.outputs.push_back(kept(name));
    const std::vector<std::string> made = first.outputs;
    std::vector<std::string> stamps;
    for (std::size_t number = 1; number <= divided.count; ++number) {
        const std::string share = fmt::format("{}/{}", number, divided.count);
        Job& job = add(fmt::format("cells {} of {}", share, plan.name), share);
        job.inputs.insert(job.inputs.end(), made.begin(), made.end());
        job.outputs = {kept(cells::stamp_of({number, divided.count}))};
        stamps.push_back(job.outputs.front());
    }
    Job& last = add(plan.name, "");
    last.inputs.insert(last.inputs.end(), stamps.begin(), stamps.end());
    for (const auto& path : divided.outputs) last.outputs.push_back(path.generic_string());
    return jobs;
}

/// Adds errors for options that divide a run, and for conflicting options without them.
void check_cells(const ExportOptions& options, const CommandLine& line, Problems& problems) {
    const auto& sources = options.sources;
    if (options.common.kept_cells.empty()) {
        if (options.cell_jobs > 0 || options.common.partition != "auto")
            problems.add(line.find(options.cell_jobs > 0 ? "--cell-jobs" : "--partition"), "E-ARGUMENT",
                         "--partition and --cell-jobs need a run in cells", "give --keep-cells DIR");
        return check_sources(options, line, problems);
    }
    if (!sources.patterns.empty() || !sources.lists.empty() || !sources.table.empty() || options.shard > 1)
        problems.add(line.find("--keep-cells"), "E-CONFLICT",
                     "--keep-cells divides one run, so it cannot be combined with several assets",
                     "give the input as a param of the pipeline: -D input=scan.ply");
    if (options.common.memory.empty() || options.common.memory.ends_with('%'))
        problems.add(line.find("--keep-cells"), "E-ARGUMENT",
                     "jobs in cells need a fixed memory size, in bytes", "--memory 2G");
}

std::string workflow_of(const ExportOptions& options, const std::vector<Job>& jobs, std::uint64_t memory) {
    const auto program = executable().generic_string();
    const Resources resources{options.common.threads, default_threads(), batch::memory_for_jobs(memory),
                              program.empty() ? "facetmill" : program};
    return options.engine == "ninja"  ? ninja_workflow(jobs, resources)
           : options.engine == "make" ? make_workflow(jobs, resources)
                                      : snakemake_workflow(jobs, resources);
}

int export_work(ExportOptions& options, const CommandLine& line, const Console& console) {
    Problems problems;
    options.common.memory = options.memory;
    check_cells(options, line, problems);
    if (options.pipeline == "-")
        problems.add(line.mark(0), "E-ARGUMENT",
                     "the jobs of a workflow cannot read the pipeline from standard input",
                     "use a file instead");
    const auto of_all = plan_settings(options.common, line, problems);
    problems.throw_if_any(ErrorKind::usage);
    batch::Settings settings;
    set_planner(settings, options, of_all);
    settings.rehearse = true; // a job that lacks a declared file counts as failed
    confine({.read_all = true}, options.common.sandbox, console);
    if (!options.common.kept_cells.empty()) {
        const auto jobs = cell_jobs(options, line, of_all, problems);
        settle(problems, console);
        print(workflow_of(options, jobs, 0));
        return 0;
    }
    auto prepared = batch::prepare(assets_of(options, line), settings, problems);
    settle(problems, console);
    if (!prepared.missing.empty()) throw Error(ErrorKind::missing, std::move(prepared.missing));
    std::vector<Job> jobs;
    for (const auto& work : prepared.works) jobs.push_back(job_of(work, options, of_all));
    jobs = in_shards(std::move(jobs), static_cast<std::size_t>(options.shard));
    print(workflow_of(options, jobs, memory_bytes(options.memory, line)));
    return 0;
}

} // namespace

Command export_command() {
    return {"export",
            "Writes the runs of many inputs as a workflow for Ninja, Make or Snakemake.",
            export_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<ExportOptions>();
                options->common.threads = 1;
                arguments.add("--to", &options->engine, "The program that runs the workflow.")
                    .one_of({"ninja", "make", "snakemake"})
                    .required();
                add_asset_options(arguments, *options);
                arguments
                    .add("--shard", &options->shard,
                         "The number of assets per job, which share its overhead. Default: 1.")
                    .between(1, 100000);
                add_threads_option(arguments, options->common.threads,
                                   "The number of threads of each job. Default: 1.");
                add_memory_option(arguments, *options, "jobs");
                arguments.add("--keep-cells", &options->common.kept_cells,
                              "Divides one run into jobs that simplify some cells each, and keeps the cells "
                              "in\nthe folder DIR. --memory then applies to each job.");
                add_partition_option(arguments, options->common);
                arguments
                    .add("--cell-jobs", &options->cell_jobs,
                         "The number of jobs that simplify. Default: one per 2 million faces, from 2 to 64.")
                    .between(1, 100000);
                add_sandbox_option(arguments, options->common.sandbox);
                add_warning_options(arguments, options->common);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    return export_work(*options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
