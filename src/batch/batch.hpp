#pragma once
// Runs many assets through a pipeline in a single process. It finds the assets, runs each separately on
// shared threads, skips the work of earlier batches, and makes a summary.

#include "base/text/markup.hpp"
#include "pipeline/run.hpp"

#include <map>

namespace facetmill::batch {

/// One run of the pipeline.
struct Asset {
    std::string name; ///< unique: the input as given, or the text that identifies the row of the table
    std::filesystem::path input;  ///< empty: a row without one
    std::filesystem::path folder; ///< of its outputs, relative to the output folder
    bool of_table = false;
    std::vector<std::pair<std::string, std::string>> defines; ///< params of this asset
    std::map<std::string, Mark> defined_at;                   ///< their locations in the table
    std::map<std::string, Value> lists;                       ///< the params that are lists
};

/// The sources of assets.
struct Sources {
    std::vector<std::string> patterns; ///< --input: files or globs, each a value of the param `input`
    std::vector<std::string> lists;    ///< --inputs-from: files with lists of names ("-": standard input)
    std::string table;                 ///< --table: a CSV or YAML file with a row per asset
    std::string base;                  ///< --base: the folder to mirror; empty: see find_assets
    std::function<Mark(const std::string&)> place; ///< of a value on the command line
    /// --prune: the assets of earlier batches. A pattern that matched such an asset may now match nothing,
    /// if the folder before its first wildcard is not empty. None: a pattern without matches is an error.
    std::optional<std::vector<std::string>> former;
};

/// The assets in the order of their sources, globs sorted by bytes, each file once. An asset's folder is the
/// folder of its input relative to the base, or empty outside the base. The default base is the path before
/// the first wildcard of a pattern, and the working directory for lists and tables. Throws missing (E-FILE)
/// if a pattern matches nothing, malformed (E-TABLE) for an invalid table.
std::vector<Asset> find_assets(const Sources& sources);

/// The assets recorded in an output folder by earlier batches of this pipeline.
std::vector<std::string> former_assets(const std::filesystem::path& output_dir, const std::string& pipeline);

struct Settings {
    /// Plans the pipeline for an asset and adds problems.
    std::function<pipeline::Plan(const Asset&, Problems&)> plan;
    std::string pipeline;      ///< its name
    std::string pipeline_text; ///< the text that invalidates results when it changes, except comments
    std::filesystem::path output_dir;
    std::vector<std::filesystem::path> others; ///< files of the summary, which no asset may write
    std::vector<std::filesystem::path> read;   ///< other files read: the pipeline, lists, a table
    int jobs = 0;                              ///< assets in parallel, and threads; 0: see run
    std::uint64_t memory = 0; ///< bytes for all assets in parallel; 0: three quarters of the available memory
    bool keep_going = false;  ///< continue after a failure
    bool prune = false;       ///< remove outputs whose source no longer exists
    bool pictures = false;    ///< add pictures to outcomes
    bool check_invariants = false;
    bool rehearse = false;            ///< take the outputs of works from pipeline::rehearsed_headers
    bool sync = true;                 ///< as io::CommitSettings
    std::vector<std::string> strict;  ///< as RunSettings
    std::vector<std::string> allowed; ///< as Plan, for warnings of the batch itself
    cache::Store* store = nullptr;    ///< as RunSettings
};

/// A planned asset.
struct Work {
    Asset asset;
    std::vector<std::filesystem::path> inputs, outputs; ///< as far as known before the run
    std::string digest;       ///< of all options and other dependencies, except the contents of the inputs
    std::uint64_t memory = 0; ///< an estimate, in bytes
    std::vector<std::filesystem::path> asset_roots{}; ///< folders that may hold files named by inputs
};

struct Prepared {
    std::vector<Work> works;
    std::vector<Diagnostic> missing;  ///< missing inputs
    std::vector<std::string> allowed; ///< ids of warnings, as in the plans
    bool files_collide = false;       ///< if true, not even the summary may be written
};

/// Plans every asset, so that no run starts if any plan is invalid. Adds the problems of planning. Adds
/// E-DUPLICATE-OUTPUT for a file that two assets, or an asset and the summary, would write (names that
/// differ only in case are equal). Adds E-OVERWRITE for an output that is also an input.
Prepared prepare(const std::vector<Asset>& assets, const Settings& settings, Problems& problems);

/// The outcome of an asset.
struct Outcome {
    enum class Verdict { ok, failed, interrupted, not_run };
    Verdict verdict = Verdict::not_run;
    bool kept = false; ///< an earlier batch made it, and its dependencies are unchanged
    int exit_code = 0;
    double seconds = 0;
    std::uint64_t faces_in = 0, faces_out = 0; ///< of the first load, and of the result
    std::uint64_t bytes = 0;                   ///< of all outputs, without reports
    std::vector<std::string> outputs;          ///< relative to the batch's output folder
    std::vector<Diagnostic> warnings, errors;
    std::string picture; ///< a PNG in base64, or empty
};

struct Summary {
    std::string pipeline;
    std::vector<Asset> assets;
    std::vector<Outcome> outcomes; ///< of the assets
    std::vector<std::string> pruned;
    std::vector<Diagnostic> warnings, errors; ///< of the batch as a whole
    int exit_code = 0;                        ///< the worst of all
    int jobs = 0;
    double seconds = 0;
};

/// Callbacks during a batch; calls never overlap.
struct Listener {
    std::function<void(const Asset&, const Outcome&, const Summary& so_far)> on_finished;
    std::function<void(const Asset&, const report::StageRecord&)> on_stage; ///< a stage of an asset ended
    /// The process ends by a signal when this returns.
    std::function<void(const Summary&)> on_interrupt;
};

/// Runs the assets. The number of jobs comes from the settings, else from the tokens of the jobserver in
/// MAKEFLAGS, else from default_threads(). The outputs of an asset appear together, and their bytes do not
/// depend on the number of jobs. A journal in the output folder lets the next batch skip unchanged assets.
/// Throws output (E-BUSY) if another batch of this pipeline uses the folder.
Summary run(std::vector<Work> works, const Settings& settings, const Listener& listener);

/// The summary of assets that do not run because of these errors.
Summary refused(const std::vector<Asset>& assets, const std::string& pipeline, ErrorKind kind,
                const std::vector<Diagnostic>& why);

/// The memory for parallel jobs: as requested, else (0) three quarters of the available memory.
std::uint64_t memory_for_jobs(std::uint64_t asked);

/// The worse_exit_code of two exit codes: 70, 2, 4, 7, 5, 6, 3, 1, 0.
int worse_exit_code(int a, int b);

/// The assets in the order of a summary: the worst failures first, then assets that did not run, then
/// warnings.
std::vector<std::size_t> worst_first(const Summary& summary);

/// For a terminal: failures, and as many others as fit, or all of them. Errors appear by id only, because
/// they were already printed.
Painted to_terminal(const Summary& summary, bool colour, bool all);
/// A report in the format of its suffix (report::form_of). It omits times and kept assets, so that the same
/// assets give the same text. Throws usage (E-REPORT) for other suffixes.
std::string render_for(const std::string& path, const Summary& summary);
/// The JSON Schema of the JSON report.
Json summary_schema();
/// Times, threads and kept assets as JSON.
std::string timings_text(const Summary& summary);

} // namespace facetmill::batch
