#pragma once
// Shared code of batch and export: the options that name assets, and the planning of each asset.

#include "batch/batch.hpp"
#include "cli/pipeline_options.hpp"

namespace facetmill::cli {

struct AssetOptions {
    PipelineOptions common;
    std::string pipeline;
    batch::Sources sources;
    std::string memory; ///< as given
};

/// Adds PIPELINE, --input, --inputs-from, --table, --base, --output-dir, -D and --set.
void add_asset_options(Arguments& arguments, AssetOptions& options);

/// --memory: for all `jobs` ("assets") that run in parallel.
void add_memory_option(Arguments& arguments, AssetOptions& options, const std::string& jobs);

/// Adds errors in the sources: none given, conflicting sources, standard input used twice.
void check_sources(const AssetOptions& options, const CommandLine& line, Problems& problems);

/// Like batch::find_assets, with messages that point into the command line. prune: assets of earlier batches
/// may no longer exist.
[[nodiscard]] std::vector<batch::Asset> assets_of(const AssetOptions& options, const CommandLine& line,
                                                  bool prune = false);

/// The common settings with this asset's params, which take precedence, and its folder.
[[nodiscard]] pipeline::PlanSettings settings_for(const batch::Asset& asset, pipeline::PlanSettings settings);

/// Sets the pipeline, the output folder and the planner of an asset. Throws a missing-file error (E-FILE) if
/// the pipeline does not exist.
void set_planner(batch::Settings& settings, const AssetOptions& options,
                 const pipeline::PlanSettings& of_all);

} // namespace facetmill::cli
