#pragma once
// What batch and export share: the options that name assets, and how each of them is planned.

#include "batch/batch.hpp"
#include "cli/pipeline_options.hpp"

namespace facetmill::cli {

struct AssetOptions {
    PipelineOptions common;
    std::string pipeline;
    batch::Sources sources;
    std::string memory; ///< as it was given
};

/// PIPELINE, --input, --inputs-from, --table, --base, --output-dir, -D and --set.
void add_asset_options(Arguments& arguments, AssetOptions& options);

/// --memory: for all `jobs` ("assets") that run at the same time.
void add_memory_option(Arguments& arguments, AssetOptions& options, const std::string& jobs);

/// Adds what is wrong with the sources: none, some that exclude each other, standard input twice.
void check_sources(const AssetOptions& options, const CommandLine& line, Problems& problems);

/// As batch::find_assets, with messages that point into the command line. prune: what earlier batches found
/// may be gone.
std::vector<batch::Asset> assets_of(const AssetOptions& options, const CommandLine& line, bool prune = false);

/// The settings of all assets with the params of this one, which go before, and its folder.
pipeline::PlanSettings settings_for(const batch::Asset& asset, pipeline::PlanSettings settings);

/// Sets the pipeline, the output folder and how an asset is planned. Throws missing (E-FILE) when there is no
/// such pipeline.
void set_planner(batch::Settings& settings, const AssetOptions& options,
                 const pipeline::PlanSettings& of_all);

} // namespace facetmill::cli
