#pragma once
// Runs a pipeline on many assets in a single process. It finds the assets, skips assets that an earlier batch
// completed, runs the others on shared threads, and writes a summary.

#include "base/text/markup.hpp"
#include "batch/figures.hpp"
#include "pipeline/run.hpp"

#include <map>

namespace facetmill::batch {

/// A run of the pipeline.
struct Asset {
    std::string name;             ///< unique: the input as given, or the name of the table row
    std::filesystem::path input;  ///< empty: a row without an input
    std::filesystem::path folder; ///< folder of its outputs, relative to the output folder
    bool of_table = false;
    bool of_archive = false; ///< the input is an unpacked file; the name begins with its archive
    std::vector<std::pair<std::string, std::string>> defines; ///< params of this asset
    std::map<std::string, Mark> defined_at;                   ///< marks in the table, if they come from one
    std::map<std::string, Value> lists;                       ///< list values
};

/// The sources of assets.
struct Sources {
    std::vector<std::string> patterns; ///< --input: files or globs, each a value of the param `input`
    std::vector<std::string> lists;    ///< --inputs-from: files of names ("-": standard input)
    std::vector<std::string> archives; ///< --archive: tar or zip files; their meshes are assets
    std::string output_dir;            ///< in which archives are unpacked
    std::string table;                 ///< --table: a CSV or YAML file with one asset per row
    std::string base;                  ///< --base: the folder to mirror; empty: see find_assets
    std::function<Mark(const std::string&)> place; ///< the mark of a value on the command line
    /// --prune: the assets of earlier batches. A pattern that names one of them may have no matches any more,
    /// if the folder before its first wildcard is not empty. Empty optional: a pattern without matches is an
    /// error.
    std::optional<std::vector<std::string>> former;
};

/// The assets in the order of their sources, globs sorted by bytes, each file once. An asset's folder is the
/// folder of its input relative to the base. The default base is the part of a pattern before its first
/// wildcard, and the working directory for lists and tables. Outside the base the folder is empty. Throws a
/// missing-file error (E-FILE) if a pattern matches no file, and a malformed-input error (E-TABLE) for an
/// unreadable table.
[[nodiscard]] std::vector<Asset> find_assets(const Sources& sources);

/// The assets that earlier batches of this pipeline recorded in an output folder.
[[nodiscard]] std::vector<std::string> former_assets(const std::filesystem::path& output_dir,
                                                     const std::string& pipeline);

struct Settings {
    /// Plans the pipeline for an asset; adds problems.
    std::function<pipeline::Plan(const Asset&, Problems&)> plan;
    std::string pipeline;      ///< its name
    std::string pipeline_text; ///< changes to it, except comments, make results out of date
    std::filesystem::path output_dir;
    std::vector<std::filesystem::path> others; ///< files of the summary: no asset may write them
    std::vector<std::filesystem::path> read;   ///< other files that are read: the pipeline, lists, a table
    int jobs = 0;                              ///< number of concurrent assets and threads; 0: see run
    std::uint64_t memory = 0; ///< bytes for all concurrent assets; 0: three quarters of the available memory
    bool by_cause = false;    ///< see Summary
    std::string picture_folder, link_base;          ///< see Summary
    double time_limit = 0;                          ///< seconds for each asset, or 0 for no limit
    bool keep_going = false;                        ///< continues after a failure
    bool prune = false;                             ///< removes outputs whose source is gone
    bool pictures = false;                          ///< makes pictures for outcomes
    std::optional<ModelRowSettings> model_row = {}; ///< measures each model
    bool check_invariants = false;
    bool rehearse = false;            ///< predicts outputs with pipeline::rehearsed_headers
    bool sync = true;                 ///< see io::CommitSettings
    std::vector<std::string> strict;  ///< see RunSettings
    std::vector<std::string> allowed; ///< see Plan; for warnings of the batch itself
    cache::Store* store = nullptr;    ///< see RunSettings
};

/// A planned asset.
struct Work {
    Asset asset;
    std::vector<std::filesystem::path> inputs, outputs; ///< as far as known before it runs
    std::string
        digest; ///< digest of all options and other influences on the result, except the inputs' contents
    std::uint64_t memory = 0;                         ///< an estimate, in bytes
    std::vector<std::filesystem::path> asset_roots{}; ///< folders in which the inputs may refer to files
};

struct Prepared {
    std::vector<Work> works;
    std::vector<Diagnostic> missing;  ///< for missing inputs
    std::vector<std::string> allowed; ///< ids of warnings, as in the plans
    bool files_collide = false;       ///< if true, even the summary must not be written
};

/// Plans every asset, so that nothing runs if any plan has errors. Adds the problems of planning. Adds
/// E-DUPLICATE-OUTPUT for a file that two assets, or an asset and the summary, would write (ignoring case).
/// Adds E-OVERWRITE for an output that is also an input.
[[nodiscard]] Prepared prepare(const std::vector<Asset>& assets, const Settings& settings,
                               Problems& problems);

/// A written file. Empty: not known, or not of this kind of file.
struct OutcomeFile {
    std::string path; ///< relative to the output folder of the batch
    std::uint64_t bytes = 0;
    std::optional<std::uint64_t> faces = {}, draw_calls = {}, pixels = {};
};

/// The outcome of an asset.
struct Outcome {
    enum class Verdict { ok, failed, interrupted, not_run };
    Verdict verdict = Verdict::not_run;
    bool kept = false; ///< an earlier batch completed it, and nothing has changed since
    int exit_code = 0;
    double seconds = 0;
    Figures figures;
    std::vector<std::string> outputs; ///< relative to the output folder of the batch
    std::vector<std::string> reports; ///< the same
    std::vector<OutcomeFile> files;   ///< the outputs
    std::optional<double> deviation;  ///< the largest of its stages, in percent of the diagonal
    std::vector<Diagnostic> warnings, errors;
    std::string customer; ///< why the model was rejected, in plain words for its owner
    std::string picture;  ///< a PNG in base64, or empty
};

struct Summary {
    std::string pipeline;
    std::vector<Asset> assets;
    std::vector<Outcome> outcomes; ///< outcomes of the assets
    std::filesystem::path output_dir;
    std::string picture_folder; ///< relative to the output folder: PNG files for Markdown. Empty: none
    std::string link_base;      ///< the address of the output folder for links in Markdown. Empty: relative
    std::vector<std::string> pruned;
    std::vector<Diagnostic> warnings, errors; ///< diagnostics of the batch as a whole
    bool by_cause =
        false;         ///< reports list causes instead of assets, so their size does not grow with the assets
    int exit_code = 0; ///< the worst exit code
    int jobs = 0;
    double seconds = 0;
};

/// Callbacks during a batch; calls are serialised.
struct Listener {
    std::function<void(const Asset&, const Outcome&, const Summary& so_far)> on_finished;
    std::function<void(const Asset&, const report::StageRecord&)> on_stage; ///< after a stage of an asset
    /// The process ends after this returns, because of a signal.
    std::function<void(const Summary&)> on_interrupt;
};

/// Runs the assets. The number of jobs comes from the settings, otherwise from the jobserver in MAKEFLAGS,
/// otherwise from default_threads(). The outputs of an asset appear together, and have the same bytes for any
/// number of jobs. Completed assets are recorded in the output folder, so that the next batch skips unchanged
/// assets. Throws an output error (E-BUSY) when another batch of this pipeline is running in the same folder.
[[nodiscard]] Summary run(std::vector<Work> works, const Settings& settings, const Listener& listener);

/// The summary of assets that do not run because of these errors.
[[nodiscard]] Summary refused(const std::vector<Asset>& assets, const std::string& pipeline, ErrorKind kind,
                              const std::vector<Diagnostic>& why);

/// The memory that concurrent jobs may use: the requested amount, or (for 0) three quarters of the available
/// memory.
[[nodiscard]] std::uint64_t memory_for_jobs(std::uint64_t asked);

/// The worse of two exit codes, in the order 70, 2, 4, 7, 5, 6, 3, 1, 0.
[[nodiscard]] int worse_exit_code(int a, int b);

/// The assets in the order of a summary: the worst failures first, then assets that did not run, then
/// warnings.
[[nodiscard]] std::vector<std::size_t> worst_first(const Summary& summary);

/// A summary for a terminal: failures, and as many other assets as fit, or all. Shows only the ids of errors,
/// because the messages were printed when they occurred.
[[nodiscard]] Painted to_terminal(const Summary& summary, bool colour, bool all);
/// A report in the format of its suffix (report::form_of). It contains neither times nor which assets were
/// skipped, so that the same assets give the same text. Throws a usage error (E-REPORT) for another suffix.
[[nodiscard]] std::string render_for(const std::string& path, const Summary& summary);
/// The JSON Schema of the report in JSON.
[[nodiscard]] Json summary_schema();
/// [assets] The names of their pictures in the picture folder, each different; empty without a picture.
[[nodiscard]] std::vector<std::string> picture_names(const Summary& summary);
/// Writes a table with a row per asset in the order of the inputs, as CSV, or as JSON lines for a suffix
/// .jsonl. The columns are the plain values of an asset in the JSON report. put receives it piece by piece.
void write_rows(const std::string& path, const Summary& summary,
                const std::function<void(std::string_view)>& put);
/// Times, threads and skipped assets, as JSON.
[[nodiscard]] std::string timings_text(const Summary& summary);

} // namespace facetmill::batch
