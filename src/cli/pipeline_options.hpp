#pragma once
// The options shared by run, plan, pipe and check, and the planning of a PIPELINE argument.

#include "cli/cache_options.hpp"
#include "cli/confine.hpp"
#include "pipeline/run.hpp"

#include <functional>

namespace facetmill::cli {

struct PipelineOptions {
    std::vector<std::string> defines, sets; ///< "name=value", as given
    std::vector<std::string> presets;       ///< files of params; a later file overrides an earlier one
    std::vector<std::string> reports, strict, allowed;
    std::vector<std::string> asset_roots;
    std::string output_dir, depfile, depfile_target, timings;
    int threads = 0;
    bool check_invariants = false, update_baseline = false;
    bool restat = false, explain = false;
    bool no_sync = false;
    std::string memory, partition = "auto", scratch, kept_cells, cells_job;
    pipeline::CellSettings cells{}; ///< see cell_settings
    CacheOptions cache;
    SandboxOptions sandbox;
};

/// Adds -D, --preset, --set and --asset-root.
void add_param_options(Arguments& arguments, PipelineOptions& options);
/// Adds these options and --update-baseline.
void add_value_options(Arguments& arguments, PipelineOptions& options);
/// Adds --partition.
void add_partition_option(Arguments& arguments, PipelineOptions& options);
/// Adds --partition with --memory, --scratch and --keep-cells: meshes larger than memory.
void add_cell_options(Arguments& arguments, PipelineOptions& options);
/// The settings that these options define. Throws a usage error (E-ARGUMENT).
[[nodiscard]] pipeline::CellSettings cell_settings(const PipelineOptions& options, const CommandLine& line);
/// Bytes: "8GB", "8G", "50%" of the available memory; 0 for an empty text. Throws a usage error
/// (E-ARGUMENT).
[[nodiscard]] std::uint64_t memory_bytes(const std::string& text, const CommandLine& line);
/// Adds --no-sync.
void add_sync_option(Arguments& arguments, PipelineOptions& options);
/// Adds --strict, --allow and --check-invariants.
void add_warning_options(Arguments& arguments, PipelineOptions& options);
/// Adds -j, --output-dir, --report, --depfile, --depfile-target, --strict, --allow, --cache, --no-cache,
/// --explain, --restat, --no-sync.
void add_run_options(Arguments& arguments, PipelineOptions& options);

/// Settings for a plan: splits values at "="; problems point into the command line.
[[nodiscard]] pipeline::PlanSettings plan_settings(const PipelineOptions& options, const CommandLine& line,
                                                   Problems& problems);

/// Makes a mesh among the pipelines, as in "run web part.stl", the value of the param input. Throws usage for
/// several meshes, and for a mesh without a pipeline.
void take_input(std::vector<std::string>& pipelines, PipelineOptions& options, const CommandLine& line);

/// Whether the text names a file, and not a built-in pipeline or standard input. An inaccessible file counts,
/// because opening it reports the reason. A folder, such as the outputs of an earlier run, does not hide a
/// built-in pipeline.
bool is_pipeline_file(const std::string& pipeline);

/// The text and name of a file, of standard input ("-"), or of a built-in pipeline. Throws a missing-file
/// error if it does not exist.
[[nodiscard]] std::pair<pipeline::PipelineSource, std::string> source_of(const std::string& pipeline);

/// The plan of a file, of standard input ("-"), or of a built-in pipeline by name. Adds problems; throws a
/// missing-file error for a file that cannot be read.
[[nodiscard]] pipeline::Plan plan_of(const std::string& pipeline, pipeline::PlanSettings settings,
                                     Problems& problems);

/// Whether there are errors. If so, prints all problems, and writes and names the reports of these plans as
/// far as known; the exit code is usage.
bool refused(const std::vector<pipeline::Plan>& plans, const Problems& problems, const Console& console);

/// Prints an event for each finished stage with --log json. asset: the asset in a batch, otherwise empty.
void tell_stage(const report::StageRecord& stage, const std::string& asset, const Console& console);

/// Prints the resolved lengths of a stage.
void tell_resolved(const report::StageRecord& stage, const Console& console);

/// Enters the sandbox for runs of these plans, before the first run starts.
void confine_to(const std::vector<pipeline::Plan>& plans, const PipelineOptions& options,
                const Console& console);

/// Runs a plan with messages and progress. Writes the depfile on success. Returns the exit code.
/// pipeline_file: the plan's file, for the depfile; empty if it has none. written: receives the outputs,
/// except input files that already had the same bytes.
[[nodiscard]] int run_with_messages(const pipeline::Plan& plan, const PipelineOptions& options,
                                    const Console& console, const std::string& pipeline_file,
                                    std::vector<std::filesystem::path>* written = nullptr);

/// Plans each pipeline independently; params need no value. look: receives each plan without errors, and may
/// throw for an invalid input. Finally calls settle for all problems.
void plan_each(const std::vector<std::string>& pipelines, const PipelineOptions& options,
               const CommandLine& line, const Console& console,
               const std::function<void(const std::string& pipeline, const pipeline::Plan&)>& look);

/// Prints warnings; throws a usage error if there are errors.
void settle(const Problems& problems, const Console& console);

/// Throws all of these errors as a single error with the kind of the first; does nothing if empty.
void settle(const std::vector<Error>& errors);

} // namespace facetmill::cli
