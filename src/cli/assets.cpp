#include "cli/assets.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

void add_asset_options(Arguments& arguments, AssetOptions& options) {
    arguments.add("PIPELINE", &options.pipeline, "A YAML file, - or a built-in pipeline.").required();
    arguments.add("--input", &options.sources.patterns,
                  "A file, or a pattern in quotes. ** matches any number of folders.");
    arguments.add("--inputs-from", &options.sources.lists,
                  "A file of names, or -. It contains one name per line, or names that end with NUL.");
    arguments.add(
        "--table", &options.sources.table,
        "A CSV file with a header, or a YAML list of maps: one row per asset, one column per param.\n"
        "Or a GeoJSON: one asset per feature, with the params feature (a polygon as WKT) and name.");
    arguments.add("--base", &options.sources.base,
                  "The input folder whose structure is mirrored. Default: the part of a pattern before "
                  "its\nwildcards.");
    arguments.add("-o,--output-dir", &options.common.output_dir, "The folder for relative paths of outputs.")
        .required();
    add_param_options(arguments, options.common);
}

void add_memory_option(Arguments& arguments, AssetOptions& options, const std::string& jobs) {
    arguments.add("--memory", &options.memory,
                  fmt::format("The memory for all {} that run at the same time:\n8G, 500MB, or 50% of the "
                              "available memory. Default: 75%.",
                              jobs));
}

void check_sources(const AssetOptions& options, const CommandLine& line, Problems& problems) {
    const auto& sources = options.sources;
    const bool files = !sources.patterns.empty() || !sources.lists.empty() || !sources.archives.empty();
    if (!files && sources.table.empty())
        problems.add(line.mark(0), "E-ARGUMENT",
                     "there are no assets: give --input, --inputs-from or --table",
                     "for example --input 'scans/**/*.ply'");
    if (files && !sources.table.empty())
        problems.add(line.find("--table"), "E-CONFLICT",
                     "--table cannot be combined with --input and --inputs-from",
                     "use its column input for the inputs");
    int streams = options.pipeline == "-";
    for (const auto* all : {&sources.lists, &sources.archives})
        for (const auto& file : *all) streams += file == "-";
    streams += sources.table == "-";
    if (streams > 1)
        problems.add(line.mark(0), "E-DUPLICATE-INPUT", "standard input can be read only once",
                     "give the pipeline or the list as a file");
}

pipeline::PlanSettings settings_for(const batch::Asset& asset, pipeline::PlanSettings settings) {
    std::erase_if(settings.defines, [&](const auto& define) {
        return asset.of_table && asset.defined_at.contains(define.first);
    });
    settings.defines.insert(settings.defines.end(), asset.defines.begin(), asset.defines.end());
    for (const auto& [name, text] : asset.defines) {
        settings.defined_at.erase(name);
        settings.defined_in.erase(name);
        settings.defined_lists.erase(name);
    }
    for (const auto& [name, list] : asset.lists) settings.defined_lists[name] = list;
    for (const auto& [name, mark] : asset.defined_at) settings.defined_at[name] = mark;
    if (!asset.folder.empty()) settings.places.output_base /= asset.folder;
    return settings;
}

std::vector<batch::Asset> assets_of(const AssetOptions& options, const CommandLine& line, bool prune) {
    auto sources = options.sources;
    sources.output_dir = options.common.output_dir;
    if (prune) sources.former = batch::former_assets(options.common.output_dir, options.pipeline);
    sources.place = [&](const std::string& text) { return line.value(text); };
    return batch::find_assets(sources);
}

void set_planner(batch::Settings& settings, const AssetOptions& options,
                 const pipeline::PlanSettings& of_all) {
    const auto named = source_of(options.pipeline);
    settings.pipeline = options.pipeline;
    settings.pipeline_text = named.first.text;
    settings.output_dir = options.common.output_dir;
    settings.plan = [named, of_all](const batch::Asset& asset, Problems& found) {
        auto own = settings_for(asset, of_all);
        own.name = named.second;
        return pipeline::plan_source(named.first, std::move(own), found);
    };
}

} // namespace facetmill::cli
