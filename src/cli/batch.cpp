// facetmill batch: runs a pipeline over many assets in a single process.

#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "base/text/readable_numbers.hpp"
#include "batch/archives.hpp"
#include "batch/jobserver.hpp"
#include "cli/assets.hpp"
#include "cli/warning_limiter.hpp"
#include "io/gltf/document/container.hpp"
#include "io/outputs/outputs.hpp"
#include "io/rows.hpp"
#include "parallel/memory.hpp"
#include "report/form.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* batch_examples =
    R"(Each asset is one run of the pipeline. With --input, each input is an asset and becomes the param `input`. With
--table, each row is an asset and its columns become params. A row overrides -D.

The structure of input folders is mirrored. With 'scans/**/*.ply', the outputs of scans/a/b.ply are written to
OUT/a. With lists and tables, folders are mirrored from the working directory. All outputs of an asset appear
together.

OUT/.facetmill-batch.NAME-*.jsonl records completed assets. The next batch skips them if their inputs, options,
outputs and program are unchanged, even after a crash. The exit code is the most severe of all assets, in this
order: 70, 2, 4, 7, 5, 6, 3, 1.

Examples
  facetmill batch scan-to-web --input 'scans/**/*.ply' -D keep=10% --output-dir web
  find scans -name '*.ply' -print0 | facetmill batch scan.yaml --inputs-from - -o web --keep-going
  facetmill batch scan.yaml --table params.csv -o web --report index.html --report batch.json
  facetmill batch repair --input 'orders/*.{stl,3mf}' -o checked -k --table-out quotes.csv
  tar c orders | facetmill batch repair --archive - -o checked -k --archive-out - > repaired.tar
  facetmill batch scan.yaml --input 'scans/**/*.ply' -o web --prune      (removes outputs whose input no longer exists)
)";

struct BatchOptions : AssetOptions {
    bool keep_going = false, prune = false;
    std::string pictures, link_base; ///< for Markdown
    std::string archive_out;
    std::string summary;             ///< by-asset or by-id
    std::vector<std::string> tables; ///< files with a row per asset
    double overhang_angle = 45;      ///< in degrees
    std::string time_limit;          ///< as given
};

/// The options of reports, tables and archives.
void add_result_options(Arguments& arguments, BatchOptions& options) {
    arguments.add("--report", &options.common.reports,
                  "Also writes a summary: F.json, F.html, F.md, F.xml (JUnit) or F.txt.\n- writes JSON to "
                  "standard output.");
    arguments.add(
        "--time-limit", &options.time_limit,
        "The longest time for each asset, for example 30s, 500ms, 5min or 1h. An asset that takes\nlonger "
        "fails (E-TIME) and writes nothing. A stage stops at its next parallel loop or\nprogress report.");
    arguments.add("--table-out", &options.tables,
                  "Also measures each model, and writes a row per asset, even if it fails: F.csv or "
                  "F.jsonl.\nTexts that spreadsheets would run as formulas get an apostrophe in front.");
    arguments
        .add("--overhang-angle", &options.overhang_angle,
             "The slope in degrees below which faces count as overhangs in --table-out. Default: 45.")
        .not_negative();
    arguments
        .add("--summary", &options.summary,
             "by-asset lists every asset. by-id groups errors and warnings by id, in at most ten "
             "lines\non the terminal. Reports then list no assets. Use --table-out to list them.")
        .one_of({"by-asset", "by-id"});
    arguments.add("--pictures", &options.pictures,
                  "Also writes a picture of each asset as PNG into this folder below the output folder.\nThe "
                  "report F.md shows them.");
    arguments.add("--link-base", &options.link_base,
                  "The address under which the output folder is published. Links in F.md begin with it.");
    arguments.add("--archive", &options.sources.archives,
                  "A tar (also .gz or .zst) or zip file, or - for a tar on standard input.\nEach mesh in it "
                  "is an asset.");
    arguments.add("--archive-out", &options.archive_out,
                  "Also packs the outputs of successful assets into F.tar or F.zip.\n- writes a tar to "
                  "standard output.");
    arguments.add("--timings", &options.common.timings, "Writes times and skipped assets to F.json.");
}

void add_batch_options(Arguments& arguments, BatchOptions& options) {
    add_asset_options(arguments, options);
    arguments
        .add("-j,--jobs", &options.common.threads,
             "The number of assets that run at the same time, and of threads for all of them.\nDefault: "
             "jobserver, FACETMILL_JOBS, or the number of cores.")
        .between(1, 4096);
    add_memory_option(arguments, options, "assets");
    arguments.add("-k,--keep-going", &options.keep_going,
                  "Runs all assets. By default, no asset starts after one has failed.");
    arguments.add("--prune", &options.prune,
                  "Removes outputs of earlier batches whose input no longer exists.");
    add_result_options(arguments, options);
    add_sync_option(arguments, options.common);
    add_cache_options(arguments, options.common.cache);
    add_sandbox_option(arguments, options.common.sandbox);
    add_warning_options(arguments, options.common);
}

/// The number of assets that have ended.
std::size_t done_of(const batch::Summary& so_far) {
    return so_far.outcomes.size() -
           static_cast<std::size_t>(std::ranges::count(so_far.outcomes, batch::Outcome::Verdict::not_run,
                                                       &batch::Outcome::verdict));
}

/// A line that is redrawn whenever an asset ends: progress of the batch and remaining time.
class BatchBar {
  public:
    explicit BatchBar(const Console& console) : shown_(console.redraws()) {}

    void draw(const batch::Summary& so_far) {
        if (!shown_) return;
        std::size_t worked = 0, failed = 0;
        const std::size_t done = done_of(so_far);
        for (const auto& out : so_far.outcomes) {
            worked += out.verdict != batch::Outcome::Verdict::not_run && !out.kept;
            failed += out.verdict == batch::Outcome::Verdict::failed;
        }
        const std::size_t all = so_far.outcomes.size();
        constexpr std::size_t width = 24;
        const std::size_t filled = all == 0 ? width : width * done / all;
        std::string text = fmt::format("\r\033[K[{}{}] {}/{}", std::string(filled, '#'),
                                       std::string(width - filled, '.'), done, all);
        if (failed > 0) text += fmt::format(", {} failed", failed);
        if (worked > 0 && done < all)
            text += fmt::format(", about {} left", timed(so_far.seconds / static_cast<double>(worked) *
                                                         static_cast<double>(all - done)));
        std::fwrite(text.data(), 1, text.size(), stderr);
        std::fflush(stderr);
    }
    void clear() const {
        if (shown_) std::fputs("\r\033[K", stderr);
    }

  private:
    bool shown_;
};

/// Prints the messages of a finished asset together.
void tell_asset(const batch::Asset& asset, const batch::Outcome& out, const batch::Summary& so_far,
                const Console& console, bool by_cause) {
    WarningLimiter few(console);
    const bool tells = !by_cause || console.json; // otherwise the summary tells the causes
    if (!out.kept && tells)
        for (const auto& warning : out.warnings) few.tell(warning);
    if (tells)
        for (const auto& error : out.errors) few.tell(error);
    few.finish();
    console.event({{"level", "info"},
                   {"event", "asset"},
                   {"asset", asset.name},
                   {"number", done_of(so_far)},
                   {"of", so_far.outcomes.size()},
                   {"exit_code", out.exit_code},
                   {"kept", out.kept},
                   {"outputs", out.outputs},
                   {"seconds", out.seconds}});
}

/// Writes the table row by row, because a million rows may be larger than memory.
void write_table(const std::filesystem::path& target, const std::string& path,
                 const batch::Summary& summary) {
    const auto rows = [&](const auto& put) {
        batch::write_rows(path, summary, [&](std::string_view text) { put(io::bytes_of_text(text)); });
    };
    io::Outputs outputs;
    outputs.add(target, rows);
    outputs.commit();
}

void write_pictures(const batch::Summary& summary, const std::filesystem::path& folder) {
    const auto names = batch::picture_names(summary);
    io::Outputs outputs;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!names[i].empty())
            outputs.add(folder / names[i],
                        io::gltf::data_uri_bytes("data:;base64," + summary.outcomes[i].picture));
    outputs.commit();
}

void write_summary(const batch::Summary& summary, const BatchOptions& options, const Folders& places,
                   const Console& console) {
    const auto tell = [&](const std::string& path) {
        if (!console.json) console.say(fmt::format("wrote {}", places.output(path).string()));
    };
    const auto write = [&](const std::string& path, const std::string& text) {
        io::write_now(places.output(path), std::as_bytes(std::span(text)));
        tell(path);
    };
    for (const auto& report : options.common.reports) write(report, batch::render_for(report, summary));
    if (!options.pictures.empty()) write_pictures(summary, places.output(options.pictures));
    for (const auto& table : options.tables) {
        write_table(places.output(table), table, summary);
        tell(table);
    }
    if (!options.common.timings.empty()) write(options.common.timings, batch::timings_text(summary));
}

/// Prints and writes the summary.
void tell_summary(const batch::Summary& summary, const BatchOptions& options, const Folders& places,
                  const Console& console) {
    for (const auto& warning : summary.warnings) console.diagnostic(warning);
    for (const auto& error : summary.errors) console.diagnostic(error);
    console.event({{"level", "info"},
                   {"event", "end"},
                   {"pipeline", summary.pipeline},
                   {"exit_code", summary.exit_code},
                   {"seconds", summary.seconds}});
    if (!console.json) console.say(batch::to_terminal(summary, console.colour(), console.verbose));
    write_summary(summary, options, places, console);
}

batch::Listener listener_for(const BatchOptions& options, const Folders& places, const Console& console,
                             const std::shared_ptr<BatchBar>& bar) {
    batch::Listener listener;
    const bool by_cause = options.summary == "by-id";
    listener.on_finished = [&console, bar, by_cause](const batch::Asset& asset, const batch::Outcome& out,
                                                     const batch::Summary& so_far) {
        bar->clear();
        tell_asset(asset, out, so_far, console, by_cause);
        bar->draw(so_far);
    };
    if (console.verbose || console.json)
        listener.on_stage = [&console](const batch::Asset& asset, const report::StageRecord& stage) {
            tell_stage(stage, asset.name, console);
            if (!console.verbose) return;
            console.say(fmt::format("{}: {} in {}", asset.name, stage.name, timed(stage.seconds)));
            tell_resolved(stage, console);
        };
    listener.on_interrupt = [&options, &places, &console, bar](const batch::Summary& summary) {
        bar->clear();
        try {
            tell_summary(summary, options, places, console);
        } catch (const Error& e) {
            console.diagnostics(e);
        }
    };
    return listener;
}

/// The seconds of a text such as 30s. A number without a unit counts seconds.
double seconds_of(const std::string& text, const CommandLine& line) {
    if (text.empty()) return 0;
    constexpr std::pair<std::string_view, double> units[] = {
        {"ms", 1e-3}, {"min", 60}, {"h", 3600}, {"s", 1}, {"", 1}};
    for (const auto& [unit, factor] : units) {
        if (!text.ends_with(unit)) continue;
        const auto number = parse_real(std::string_view(text).substr(0, text.size() - unit.size()));
        if (number && *number > 0 && *number * factor < 1e9) return *number * factor;
        break;
    }
    throw Error(ErrorKind::usage, "E-ARGUMENT", fmt::format("--time-limit needs a time, found '{}'", text),
                "for example --time-limit 30s", line.value(text));
}

/// The settings of the batch, except the planner of an asset.
batch::Settings batch_settings(const BatchOptions& options, const CommandLine& line, const Folders& places) {
    batch::Settings settings;
    settings.jobs = options.common.threads;
    settings.memory = memory_bytes(options.memory, line);
    set_memory_limit(settings.memory);
    settings.keep_going = options.keep_going;
    settings.picture_folder = options.pictures;
    settings.pictures = !options.pictures.empty();
    settings.link_base = options.link_base;
    settings.by_cause = options.summary == "by-id";
    settings.time_limit = seconds_of(options.time_limit, line);
    settings.prune = options.prune;
    settings.check_invariants = options.common.check_invariants;
    settings.sync = !options.common.no_sync;
    settings.strict = options.common.strict;
    for (const auto& report : options.common.reports) {
        settings.others.push_back(places.output(report));
        settings.pictures |= report.ends_with(".html");
    }
    for (const auto& table : options.tables) settings.others.push_back(places.output(table));
    if (!options.tables.empty()) settings.model_row = {options.overhang_angle * pi / 180, true};
    if (!options.archive_out.empty()) settings.others.push_back(places.output(options.archive_out));
    if (!options.common.timings.empty()) settings.others.push_back(places.output(options.common.timings));
    settings.read = {options.sources.lists.begin(), options.sources.lists.end()};
    for (const auto& file : {options.pipeline, options.sources.table})
        if (!file.empty()) settings.read.emplace_back(file);
    return settings;
}

/// The files that the assets and the batch itself read and write. The output folder has the journal, and
/// outputs that only a run can name.
AllowedFiles allowed_for(const std::vector<batch::Work>& works, const batch::Settings& settings,
                         const BatchOptions& options) {
    AllowedFiles allowed;
    allow_output(allowed, settings.output_dir / "x");
    for (const auto& work : works) {
        for (const auto& input : work.inputs) allow_input(allowed, input);
        allowed.read.insert(allowed.read.end(), work.asset_roots.begin(), work.asset_roots.end());
        for (const auto& output : work.outputs) allow_output(allowed, output);
    }
    for (const auto& output : settings.others) allow_output(allowed, output);
    allowed.read.insert(allowed.read.end(), settings.read.begin(), settings.read.end());
    if (const auto folder = cache_folder(options.common.cache)) allowed.written.push_back(*folder);
    const char* makeflags = std::getenv("MAKEFLAGS");
    if (const auto fifo = batch::jobserver_file(makeflags ? makeflags : ""); !fifo.empty())
        allowed.written.push_back(fifo);
    return allowed;
}

/// Adds errors in the names of reports, tables and archives.
void check_results(const BatchOptions& options, const CommandLine& line, Problems& problems) {
    for (const auto& report : options.common.reports) {
        try {
            report::form_of(report);
        } catch (Error& e) {
            problems.add(e.at(line.value(report)));
        }
    }
    for (const auto& table : options.tables) {
        try {
            static_cast<void>(io::row_format(table));
        } catch (Error& e) {
            problems.add(e.at(line.value(table)));
        }
    }
    if (std::ranges::count(options.common.reports, std::string("-")) + (options.archive_out == "-") > 1)
        problems.add(line.find("--report"), "E-DUPLICATE-OUTPUT",
                     "standard output takes one report or one archive", "write the other to a file");
    if (!options.archive_out.empty() && !batch::is_archive_name(options.archive_out))
        problems.add(line.value(options.archive_out), "E-FORMAT",
                     fmt::format("--archive-out writes .tar or .zip, found '{}'", options.archive_out),
                     "use a name that ends in .tar or .zip");
    if (!(options.overhang_angle >= 0 && options.overhang_angle <= 90))
        problems.add(
            line.find("--overhang-angle"), "E-RANGE",
            fmt::format("--overhang-angle is between 0 and 90 degrees, found {}", options.overhang_angle));
}

/// Removes the unpacked files of archives at the end. After a signal they stay until the next batch.
class RemoveUnpacked {
  public:
    explicit RemoveUnpacked(const BatchOptions& options) : options_(options) {}
    ~RemoveUnpacked() {
        std::error_code ignored;
        for (const auto& archive : options_.sources.archives)
            std::filesystem::remove_all(batch::unpack_folder(options_.common.output_dir, archive), ignored);
    }
    RemoveUnpacked(const RemoveUnpacked&) = delete;
    RemoveUnpacked& operator=(const RemoveUnpacked&) = delete;

  private:
    const BatchOptions& options_;
};

int batch_work(const BatchOptions& options, const CommandLine& line, const Console& console) {
    Problems problems;
    check_sources(options, line, problems);
    check_results(options, line, problems);
    PipelineOptions common = options.common;
    common.reports.clear(); // the option's reports belong to the summary
    common.timings.clear();
    const auto of_all = plan_settings(common, line, problems);
    problems.throw_if_any(ErrorKind::usage);
    confine_calls_only(common.sandbox); // planning reads all headers first
    batch::Settings settings = batch_settings(options, line, of_all.places);
    set_planner(settings, options, of_all);
    const RemoveUnpacked at_end(options);
    const auto assets = assets_of(options, line, options.prune);
    auto prepared = batch::prepare(assets, settings, problems);
    const auto refuse = [&](ErrorKind kind, const std::vector<Diagnostic>& why) {
        for (const auto& d : why) console.diagnostic(d);
        const auto summary = batch::refused(assets, settings.pipeline, kind, why);
        if (!prepared.files_collide) write_summary(summary, options, of_all.places, console);
        return summary.exit_code;
    };
    if (problems.any_errors()) return refuse(ErrorKind::usage, problems.all());
    if (!prepared.missing.empty() && !options.keep_going) return refuse(ErrorKind::missing, prepared.missing);
    confine(allowed_for(prepared.works, settings, options), common.sandbox, console);
    settings.allowed = prepared.allowed.empty() ? options.common.allowed : prepared.allowed;
    const auto store = store_for(options.common.cache, settings.allowed, console, console.verbose);
    settings.store = store.get();
    const auto bar = std::make_shared<BatchBar>(console);
    const auto summary =
        batch::run(std::move(prepared.works), settings, listener_for(options, of_all.places, console, bar));
    bar->clear();
    tell_summary(summary, options, of_all.places, console);
    if (!options.archive_out.empty())
        batch::write_archive(summary, of_all.places.output(options.archive_out));
    return summary.exit_code;
}

} // namespace

Command batch_command() {
    return {"batch",
            "Runs a pipeline for each of many inputs, in one process.",
            batch_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<BatchOptions>();
                add_batch_options(arguments, *options);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    return batch_work(*options, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
