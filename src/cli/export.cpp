// facetmill export: the runs of many assets as a workflow of Ninja, Make or Snakemake.

#include "base/cores.hpp"
#include "cli/assets.hpp"
#include "cli/workflow.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* export_examples =
    R"(One job per asset or shard (several assets), with the inputs and outputs that are known in advance, the number of
threads and an estimate of the memory. Snakemake schedules by both. Ninja gets pools, so that the jobs that run at
the same time fit into the cores of this machine and into --memory. Make knows neither: its Makefile names the -j that
fits. The assets of a shard run one after the other. If one fails,
the others still run, and the job fails with the exit code of the last asset that failed. Snakemake then removes all
outputs of the job; Make and Ninja keep them and run the whole shard again. Paths are relative to the working
directory: run the workflow in it.
The outputs are those of `facetmill batch` with the same options, byte for byte.

Examples
  facetmill export --to ninja scan-to-web --input 'scans/**/*.ply' -o web > build.ninja && ninja
  facetmill export --to make scan.yaml --table params.csv -o web > assets.mk && make -f assets.mk -j4
  facetmill export --to snakemake scan.yaml --input 'scans/**/*.ply' -o web > Snakefile
  snakemake -j4                        (here; on a cluster by a profile: snakemake --profile slurm)
  facetmill export --to snakemake scan.yaml --table params.csv -o web --shard 100 > Snakefile
)";

struct ExportOptions : AssetOptions {
    std::string engine;
    int shard = 1;
};

/// The run of an asset, as one would type it.
Job job_of(const batch::Work& work, const ExportOptions& options, const pipeline::PlanSettings& of_all) {
    const auto own = settings_for(work.asset, of_all);
    Job job{work.asset.name, {{"run", options.pipeline}}, {}, {}, work.memory};
    auto& arguments = job.runs.front();
    const auto give = [&](const char* option, const std::string& name, const std::string& value) {
        arguments.emplace_back(option);
        arguments.push_back(fmt::format("{}={}", name, value));
    };
    for (const auto& preset : options.common.presets) {
        arguments.emplace_back("--preset");
        arguments.push_back(preset);
    }
    for (const auto& [name, value] : own.defines)
        if (!own.defined_in.contains(name)) give("-D", name, value); // else the preset has it
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
    for (const std::string& argument : {std::string("--output-dir"), own.places.output_base.string(),
                                        std::string("--threads"), threads, std::string("--quiet")})
        arguments.push_back(argument);
    std::error_code ignored; // a pipe of the shell is gone when the job runs
    if (is_pipeline_file(options.pipeline) && !std::filesystem::is_fifo(options.pipeline, ignored))
        job.inputs.push_back(options.pipeline);
    for (const auto& input : work.inputs) job.inputs.push_back(input.string());
    for (const auto& output : work.outputs) job.outputs.push_back(output.string());
    return job;
}

int export_work(const ExportOptions& options, const CommandLine& line, const Console& console) {
    Problems problems;
    check_sources(options, line, problems);
    if (options.pipeline == "-")
        problems.add(line.mark(0), "E-ARGUMENT",
                     "the jobs of a workflow cannot read the pipeline from standard input",
                     "give it as a file");
    const auto of_all = plan_settings(options.common, line, problems);
    problems.throw_if_any(ErrorKind::usage);
    batch::Settings settings;
    set_planner(settings, options, of_all);
    confine({.read_all = true}, options.common.sandbox, console);
    auto prepared = batch::prepare(assets_of(options, line), settings, problems);
    settle(problems, console);
    if (!prepared.missing.empty()) throw Error(ErrorKind::missing, std::move(prepared.missing));
    std::vector<Job> jobs;
    for (const auto& work : prepared.works) jobs.push_back(job_of(work, options, of_all));
    jobs = in_shards(std::move(jobs), static_cast<std::size_t>(options.shard));
    const Resources resources{options.common.threads, default_threads(),
                              batch::memory_for_jobs(memory_bytes(options.memory, line))};
    print(options.engine == "ninja"  ? ninja_workflow(jobs, resources)
          : options.engine == "make" ? make_workflow(jobs, resources)
                                     : snakemake_workflow(jobs, resources));
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
                arguments.add("--to", &options->engine, "The engine that the workflow is for.")
                    .one_of({"ninja", "make", "snakemake"})
                    .required();
                add_asset_options(arguments, *options);
                arguments
                    .add("--shard", &options->shard,
                         "Assets per job, which share the overhead of a job. Default: 1.")
                    .between(1, 100000);
                arguments
                    .add("-j,--threads", &options->common.threads,
                         "The number of threads of each job. Default: 1.")
                    .between(1, 4096);
                add_memory_option(arguments, *options, "jobs");
                add_sandbox_option(arguments, options->common.sandbox);
                add_warning_options(arguments, options->common);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    return export_work(*options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
