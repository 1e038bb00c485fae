#pragma once
// The options that run, plan, pipe and check share, and how a PIPELINE argument becomes a plan.

#include "cli/cache_options.hpp"
#include "cli/confine.hpp"
#include "pipeline/run.hpp"

#include <functional>

namespace facetmill::cli {

struct PipelineOptions {
    std::vector<std::string> defines, sets; ///< "name=value", as given
    std::vector<std::string> presets;       ///< files of params, a later one before an earlier one
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

/// -D, --preset, --set and --asset-root.
void add_param_options(Arguments& arguments, PipelineOptions& options);
/// ... and --update-baseline.
void add_value_options(Arguments& arguments, PipelineOptions& options);
/// --partition.
void add_partition_option(Arguments& arguments, PipelineOptions& options);
/// ... with --memory, --scratch and --keep-cells: meshes larger than memory.
void add_cell_options(Arguments& arguments, PipelineOptions& options);
/// What they ask for. Throws usage (E-ARGUMENT).
pipeline::CellSettings cell_settings(const PipelineOptions& options, const CommandLine& line);
/// Bytes: "8GB", "8G", "50%" of what is there; 0 of an empty text. Throws usage (E-ARGUMENT).
std::uint64_t memory_bytes(const std::string& text, const CommandLine& line);
/// --no-sync.
void add_sync_option(Arguments& arguments, PipelineOptions& options);
/// --strict, --allow, --check-invariants.
void add_warning_options(Arguments& arguments, PipelineOptions& options);
/// -j, --output-dir, --report, --depfile, --depfile-target, --strict, --allow, --cache, --no-cache,
/// --explain,
/// --restat, --no-sync.
void add_run_options(Arguments& arguments, PipelineOptions& options);

/// Settings for a plan: values split at "=", with problems that point into the command line.
pipeline::PlanSettings plan_settings(const PipelineOptions& options, const CommandLine& line,
                                     Problems& problems);

/// Whether that is a file, and no ready pipeline or standard input. A file that cannot be looked at is one:
/// opening it tells why.
bool is_pipeline_file(const std::string& pipeline);

/// The text of a file, of standard input ("-"), or of a ready pipeline by name, and what it is called. Throws
/// missing when there is none.
std::pair<pipeline::PipelineSource, std::string> source_of(const std::string& pipeline);

/// The plan of a file, of standard input ("-"), or of a ready pipeline by name. Problems are added; a file
/// that cannot be read throws missing.
pipeline::Plan plan_of(const std::string& pipeline, pipeline::PlanSettings settings, Problems& problems);

/// Whether there are errors. Then tells all problems, writes the reports of these plans, as far as they are
/// known, and names them; the exit code is that of usage.
bool refused(const std::vector<pipeline::Plan>& plans, const Problems& problems, const Console& console);

/// One event a stage that has ended, with --log json. asset: of a batch, or empty.
void tell_stage(const report::StageRecord& stage, const std::string& asset, const Console& console);

/// Says what lengths of a stage were resolved to.
void tell_resolved(const report::StageRecord& stage, const Console& console);

/// The sandbox of a run of these plans, before the first one starts.
void confine_to(const std::vector<pipeline::Plan>& plans, const PipelineOptions& options,
                const Console& console);

/// Runs a plan with messages and progress, and writes the depfile when all went well. Returns the exit code.
/// pipeline_file: what the plan came from, for the depfile; empty when there is none. written: gets the
/// outputs, but for files that were read and already had their bytes.
int run_with_messages(const pipeline::Plan& plan, const PipelineOptions& options, const Console& console,
                      const std::string& pipeline_file,
                      std::vector<std::filesystem::path>* written = nullptr);

/// Plans each pipeline, whatever becomes of the others; params need no value. look: gets each plan without
/// errors; it may throw what is wrong with an input. Then as settle, for all of them.
void plan_each(const std::vector<std::string>& pipelines, const PipelineOptions& options,
               const CommandLine& line, const Console& console,
               const std::function<void(const std::string& pipeline, const pipeline::Plan&)>& look);

/// Shows warnings; throws usage when there are errors.
void settle(const Problems& problems, const Console& console);

/// Throws all of these errors as one, with the kind of the first; nothing when there are none.
void settle(const std::vector<Error>& errors);

} // namespace facetmill::cli
