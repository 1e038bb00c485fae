#pragma once
// Runs many assets through one pipeline in one process: finds the assets, runs each separately on shared
// threads, skips unchanged results of earlier batches, and writes one summary.

#include "base/text/markup.hpp"
#include "batch/figures.hpp"
#include "pipeline/run.hpp"

#include <map>

namespace facetmill::batch {

/// One run of the pipeline.
struct Asset {
    std::string name;             ///< unique: the input as it was given, or what names the row of the table
    std::filesystem::path input;  ///< empty: a row without one
    std::filesystem::path folder; ///< of its outputs, from the output folder
    bool of_table = false;
    std::vector<std::pair<std::string, std::string>> defines; ///< params of this asset
    std::map<std::string, Mark> defined_at;                   ///< ... and where a table has them
    std::map<std::string, Value> lists;                       ///< ... those that are lists
};

/// The sources of assets.
struct Sources {
    std::vector<std::string> patterns; ///< --input: files or globs, each a value of the param `input`
    std::vector<std::string> lists;    ///< --inputs-from: files of names ("-": standard input)
    std::string table;                 ///< --table: a CSV or YAML file, a row an asset
    std::string base;                  ///< --base: the folder that is mirrored; empty: see find_assets
    std::function<Mark(const std::string&)> place; ///< of a value on the command line
    /// --prune: the assets of earlier batches. A pattern that names one of them may match nothing any more
    /// where the folder before its first wildcard holds something else. None: that is an error.
    std::optional<std::vector<std::string>> former;
};

/// The assets in the order of their sources, globs sorted by bytes, each file once. An asset's folder is that
/// of its input from the base: by default what stands before the first wildcard of a pattern, and the working
/// directory for lists and tables; beyond the base it is empty. Throws missing (E-FILE) when a pattern
/// matches nothing, malformed (E-TABLE) for a table that cannot be read.
std::vector<Asset> find_assets(const Sources& sources);

/// The assets that earlier batches of this pipeline have noted in an output folder.
std::vector<std::string> former_assets(const std::filesystem::path& output_dir, const std::string& pipeline);

struct Settings {
    /// Plans the pipeline for an asset; problems are added.
    std::function<pipeline::Plan(const Asset&, Problems&)> plan;
    std::string pipeline;      ///< its name
    std::string pipeline_text; ///< a change other than comments makes results out of date
    std::filesystem::path output_dir;
    std::vector<std::filesystem::path> others; ///< files of the summary: no asset may write them
    std::vector<std::filesystem::path> read;   ///< besides what assets read: the pipeline, lists, a table
    int jobs = 0;                              ///< assets and threads at a time; 0: see run
    std::uint64_t memory =
        0; ///< bytes for all assets that run at a time; 0: three quarters of the available memory
    bool keep_going = false; ///< after a failure, later assets still run
    bool prune = false;      ///< outputs go whose source is gone
    bool pictures = false;   ///< outcomes have pictures
    bool check_invariants = false;
    bool rehearse = false;            ///< outputs of works are those of pipeline::rehearsed_headers
    bool sync = true;                 ///< as io::CommitSettings
    std::vector<std::string> strict;  ///< as RunSettings
    std::vector<std::string> allowed; ///< as Plan: here for what the batch itself warns of
    cache::Store* store = nullptr;    ///< as RunSettings
};

/// An asset that was planned.
struct Work {
    Asset asset;
    std::vector<std::filesystem::path> inputs, outputs; ///< as far as they are known before it runs
    std::string digest;       ///< of all options and other influences on a result, except the inputs' content
    std::uint64_t memory = 0; ///< an estimate, in bytes
    std::vector<std::filesystem::path> asset_roots{}; ///< folders below which the inputs may name files
};

struct Prepared {
    std::vector<Work> works;
    std::vector<Diagnostic> missing;  ///< inputs that do not exist
    std::vector<std::string> allowed; ///< ids of warnings, as the plans have them
    bool files_collide = false;       ///< then not even the summary may be written
};

/// Plans every asset, so that nothing runs when one of them is wrong. Adds what planning adds;
/// E-DUPLICATE-OUTPUT for a file that two assets, or an asset and the summary, would write (names that differ
/// only in case are one); E-OVERWRITE for an output that is read, too.
Prepared prepare(const std::vector<Asset>& assets, const Settings& settings, Problems& problems);

/// How it went.
struct Outcome {
    enum class Verdict { ok, failed, interrupted, not_run };
    Verdict verdict = Verdict::not_run;
    bool kept = false; ///< an earlier batch has done it, and nothing has changed since
    int exit_code = 0;
    double seconds = 0;
    Figures figures;
    std::vector<std::string> outputs; ///< from the output folder of the batch
    std::vector<Diagnostic> warnings, errors;
    std::string picture; ///< a PNG in base64, or empty
};

struct Summary {
    std::string pipeline;
    std::vector<Asset> assets;
    std::vector<Outcome> outcomes; ///< of the assets
    std::vector<std::string> pruned;
    std::vector<Diagnostic> warnings, errors; ///< of the batch as a whole
    int exit_code = 0;                        ///< the gravest of all
    int jobs = 0;
    double seconds = 0;
};

/// Callbacks of a running batch; never called from two threads at a time.
struct Listener {
    std::function<void(const Asset&, const Outcome&, const Summary& so_far)> on_finished;
    std::function<void(const Asset&, const report::StageRecord&)> on_stage; ///< a stage of an asset has ended
    /// A signal ends the process when this returns.
    std::function<void(const Summary&)> on_interrupt;
};

/// Runs the assets. jobs: of the settings, else one for each token of the jobserver that MAKEFLAGS offers,
/// else default_threads(). The outputs of an asset appear together, and are the same bytes for any number of
/// jobs. What is done is noted in the output folder, so that the next batch leaves alone whatever has not
/// changed. Throws output (E-BUSY) when another batch of this pipeline is at work there.
Summary run(std::vector<Work> works, const Settings& settings, const Listener& listener);

/// The summary of assets that are not run because of these errors.
Summary refused(const std::vector<Asset>& assets, const std::string& pipeline, ErrorKind kind,
                const std::vector<Diagnostic>& why);

/// The memory for concurrent jobs: the requested amount, else (0) three quarters of the available memory.
std::uint64_t memory_for_jobs(std::uint64_t asked);

/// The worse_exit_code of two exit codes: 70, 2, 4, 7, 5, 6, 3, 1, 0.
int worse_exit_code(int a, int b);

/// The assets in the order of a summary: the worst failures first, followed by assets that were not run, and
/// by warnings.
std::vector<std::size_t> worst_first(const Summary& summary);

/// For a terminal: failures, and as many of the others as fit, or all of them. Of errors, which were told as
/// they arose, it has the ids.
Painted to_terminal(const Summary& summary, bool colour, bool all);
/// A report by its suffix (report::form_of). It has neither times nor what was kept, so
/// that the same assets give the same text. Throws usage (E-REPORT) for another suffix.
std::string render_for(const std::string& path, const Summary& summary);
/// The JSON Schema of the report in JSON.
Json summary_schema();
/// Times, threads, and reused results, as JSON.
std::string timings_text(const Summary& summary);

} // namespace facetmill::batch
