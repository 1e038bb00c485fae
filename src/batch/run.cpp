// Runs a batch, from its planned assets to its summary.

#include "base/hash.hpp"
#include "base/out_of_memory.hpp"
#include "base/stopwatch.hpp"
#include "batch/batch.hpp"
#include "batch/jobserver.hpp"
#include "batch/journal.hpp"
#include "batch/pool.hpp"
#include "batch/reach.hpp"
#include "io/bytes.hpp"
#include "io/gltf/contents/draw_costs.hpp"
#include "io/outputs/output_files.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"
#include "platform/cores.hpp"
#include "platform/interrupts.hpp"
#include "platform/temporary_files.hpp"
#include "report/customer.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <set>

namespace facetmill::batch {

namespace fs = std::filesystem;

namespace {

using Verdict = Outcome::Verdict;

/// The path relative to the output folder of the batch.
std::string from_folder(const Asset& asset, const std::string& output) {
    return (fs::path(output).is_absolute() ? fs::path(output) : asset.folder / output)
        .lexically_normal()
        .generic_string();
}

std::string absolute_name(const fs::path& path) {
    return fs::absolute(path).lexically_normal().generic_string();
}

OutcomeFile file_of(const Asset& asset, const report::FileRecord& record) {
    OutcomeFile file{from_folder(asset, record.path), record.bytes};
    if (record.read_back.is_object() && record.read_back.contains("faces"))
        file.faces = record.read_back.value("faces", std::uint64_t{0});
    return file;
}

/// Adds the draw calls and pixels of the written files, for pages.
void add_draw_costs(std::vector<OutcomeFile>& files, const fs::path& folder) {
    for (OutcomeFile& file : files) {
        try {
            const auto input = io::Input::open(folder / file.path);
            const io::DrawCosts costs = io::draw_costs(file.path, input.bytes());
            if (costs.draw_calls > 0) file.draw_calls = costs.draw_calls;
            if (costs.pixels > 0) file.pixels = costs.pixels;
        } catch (const Error&) { // another process has removed it
        }
    }
}

/// The largest deviation that stages report for their parts, in percent of the diagonal.
std::optional<double> deviation_of(const report::RunRecord& record) {
    std::optional<double> most;
    for (const auto& stage : record.stages) {
        if (!stage.result.is_object()) continue;
        const Json parts = stage.result.value("parts", Json::array());
        for (const Json& part : parts) {
            if (!part.is_object()) continue;
            const Json deviation = part.value("deviation", Json::object());
            const Json percent = deviation.is_object() ? deviation.value("percent", Json::object()) : Json();
            if (!percent.is_object() || !percent.contains("maximum")) continue;
            const Json& maximum = percent.at("maximum");
            if (maximum.is_number()) most = std::max(most.value_or(0), maximum.get<double>());
        }
    }
    return most;
}

Outcome outcome_of(const Asset& asset, report::RunRecord& record) {
    Outcome out;
    out.exit_code = record.exit_code;
    out.verdict = record.exit_code == 0 ? Verdict::ok : Verdict::failed;
    out.seconds = record.seconds;
    out.figures = figures_of(record);
    if (record.exit_code != 0) out.customer = report::customer_text(record);
    for (const auto& file : record.outputs) out.outputs.push_back(from_folder(asset, file.path));
    for (const auto& file : record.outputs) out.files.push_back(file_of(asset, file));
    out.deviation = deviation_of(record);
    for (const auto& report : record.reports) out.reports.push_back(from_folder(asset, report));
    for (auto& stage : record.stages)
        if (!stage.picture.empty()) out.picture = std::move(stage.picture);
    return out;
}

Outcome failure(const Error& error) {
    Outcome out;
    out.verdict = Verdict::failed;
    out.exit_code = static_cast<int>(error.kind());
    out.errors.push_back(error.diagnostics().front());
    out.errors.back().where = {};
    out.customer = report::customer_text(out.errors.back(), error.kind());
    return out;
}

/// The diagnostic with the asset in its message.
Diagnostic about_asset(const Asset& asset, Diagnostic d) {
    if (d.message.find(asset.name) == std::string::npos)
        d.message = fmt::format("{}: {}", asset.name, d.message);
    return d;
}

Outcome kept_outcome(const Done& done) {
    Outcome out;
    out.verdict = Verdict::ok;
    out.kept = true;
    out.figures = done.figures;
    out.outputs = done.written;
    for (const auto& file : done.outputs) // the rest are reports
        if (std::find(out.outputs.begin(), out.outputs.end(), file.path) == out.outputs.end())
            out.reports.push_back(file.path);
    for (const auto& [id, message] : done.warnings)
        out.warnings.push_back({Severity::warning, id, message, {}, {}});
    out.files = done.files;
    out.deviation = done.deviation;
    out.picture = done.picture;
    return out;
}

Done named_done(const Work& work) {
    Done done;
    done.asset = work.asset.name;
    done.of_table = work.asset.of_table;
    if (work.asset.input.empty()) return done;
    done.source = absolute_name(work.asset.input);
    done.mount_point = mount_point_of(done.source);
    return done;
}

/// Adds the file's size, and its digest if it is missing.
void complete(Stamp& stamp, const fs::path& file) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    stamp.bytes = error ? 0 : size;
    try {
        if (stamp.sha256.empty()) stamp.sha256 = sha256(io::Input::open(file).stored());
    } catch (const Error&) { // a missing file counts as changed
    }
}

Stamp stamp_of_output(const fs::path& folder, const std::string& path, const std::string& sha256 = {}) {
    Stamp stamp{path, 0, 0, sha256};
    complete(stamp, folder / path);
    return stamp;
}

void add_reports(Done& done, const Work& work, const report::RunRecord& record, const fs::path& folder) {
    for (const auto& report : record.reports)
        done.outputs.push_back(stamp_of_output(folder, from_folder(work.asset, report)));
}

/// How the settings measure models. Empty: not.
std::string how_measured(const Settings& settings) {
    return settings.model_row ? fmt::format("overhang {}", settings.model_row->overhang_angle) : "";
}

/// The files that a successful run read and wrote. before: stamps of its inputs from before reading.
Done done_of(const Work& work, const std::vector<Stamp>& before, const report::RunRecord& record,
             const Outcome& out, const fs::path& folder, const std::string& measured) {
    Done done = named_done(work);
    done.digest = work.digest;
    std::map<std::string, std::string> sums;
    for (const auto& input : record.inputs) sums[absolute_name(input.path)] = input.sha256;
    for (const auto& absent : record.absent) done.absent.push_back(absolute_name(absent));
    const auto is_absent = [&](const std::string& name) {
        return std::find(done.absent.begin(), done.absent.end(), name) != done.absent.end();
    };
    for (const auto& input : work.inputs) { // a baseline is an input, but is in no record
        const std::string name = absolute_name(input);
        if (input != "-" && !is_absent(name)) sums.emplace(name, "");
    }
    for (auto& [path, sum] : sums) {
        Stamp stamp{path, 0, 0, sum};
        for (const auto& known : before)
            if (absolute_name(known.path) == path) stamp.time = known.time;
        complete(stamp, path);
        done.inputs.push_back(std::move(stamp));
    }
    for (const auto& file : record.outputs)
        done.outputs.push_back(stamp_of_output(folder, from_folder(work.asset, file.path), file.sha256));
    add_reports(done, work, record, folder);
    done.figures = out.figures;
    done.measured = measured;
    done.written = out.outputs;
    for (const auto& warning : out.warnings) done.warnings.emplace_back(warning.id, warning.message);
    done.files = out.files;
    done.deviation = out.deviation;
    done.picture = out.picture;
    return done;
}

/// The inputs of all assets, and the outputs so far.
class Claims {
  public:
    void read(const fs::path& input, const std::string& asset) {
        sources_.emplace(io::identity(input), asset);
    }
    void keep(const fs::path& output, const std::string& asset, const std::string& digest) {
        written_[io::identity(output)] = {asset, digest};
    }

    /// Registers an output. File names known only at run time (of parts) may give two assets the same
    /// output, or make it the input of another asset. Throws an output error before anything is written.
    void write(const Asset& asset, const io::Outputs::File& file) {
        if (!file.stream.empty() || file.is_input) return;
        const fs::path self = io::identity(file.resolved);
        const std::lock_guard lock(guard_);
        if (const auto source = sources_.find(self); source != sources_.end())
            throw Error(ErrorKind::output, "E-OVERWRITE",
                        fmt::format("'{}' would overwrite an input of {}", file.target.generic_string(),
                                    source->second),
                        "write elsewhere with --output-dir, or use the name of the asset: ${input.stem}");
        const auto [first, is_new] = written_.emplace(self, std::pair(asset.name, file.sha256));
        if (is_new || first->second.first == asset.name || first->second.second == file.sha256) return;
        throw Error(ErrorKind::output, "E-DUPLICATE-OUTPUT",
                    fmt::format("'{}' is also written for {}, with different contents",
                                file.target.generic_string(), first->second.first),
                    "use the name of the asset: ${input.stem}");
    }

  private:
    std::mutex guard_;
    std::map<fs::path, std::string> sources_; ///< by identity: inputs, and their assets
    /// By identity: outputs, their assets, and their digests.
    std::map<fs::path, std::pair<std::string, std::string>> written_;
};

/// The outputs that the assets have or would have after a run, and the outputs of other pipelines.
std::set<std::string> current_outputs(const std::vector<Work>& works, const Journal& journal,
                                      const fs::path& output_dir) {
    std::set<std::string> current = journal.outputs_of_others();
    const fs::path folder = fs::absolute(output_dir).lexically_normal();
    for (const auto& work : works) {
        for (const auto& output : work.outputs)
            current.insert(
                fs::absolute(output).lexically_normal().lexically_relative(folder).generic_string());
        const auto done = journal.all().find(work.asset.name);
        if (done == journal.all().end()) continue;
        for (const auto& output : done->second.outputs) current.insert(output.path);
    }
    return current;
}

std::optional<Diagnostic> warning_of_reach(const std::vector<std::string>& names) {
    if (names.empty()) return {};
    const std::size_t more = names.size() - 1;
    return Diagnostic{
        Severity::warning,
        "W-PRUNE",
        fmt::format("the outputs of {} were not pruned, because {} cannot be reached",
                    more == 0 ? names.front() : fmt::format("{} and {} more", names.front(), more),
                    more == 0 ? "it" : "they"),
        {},
        "mount the disk or folder that has the inputs"};
}

/// Removes outputs of removed assets, and outdated outputs of other assets. All assets must have succeeded.
/// The warning: outputs that may still have inputs stay.
std::optional<Diagnostic> prune(const std::vector<Work>& works, Journal& journal, const fs::path& output_dir,
                                std::vector<std::string>& pruned) {
    std::set<std::string> current = current_outputs(works, journal, output_dir), names;
    bool table = false;
    for (const auto& work : works) {
        names.insert(work.asset.name);
        table = table || work.asset.of_table;
    }
    std::vector<std::string> gone, out_of_reach;
    for (const auto& [name, done] : journal.all()) {
        if (names.contains(name)) continue;
        const Presence presence = presence_of(done.source, done.mount_point);
        if (presence == Presence::gone || (table && done.of_table)) {
            gone.push_back(name);
            continue;
        }
        if (presence == Presence::out_of_reach) out_of_reach.push_back(name);
        for (const auto& output : done.outputs) current.insert(output.path);
    }
    const auto note = [&](std::vector<std::string> removed) {
        for (auto& path : removed) pruned.push_back(std::move(path));
    };
    for (const auto& name : gone) note(journal.remove_all(name, current));
    for (const auto& work : works) note(journal.remove_former(work.asset.name, current));
    std::sort(pruned.begin(), pruned.end());
    return warning_of_reach(out_of_reach);
}

class BatchRun {
  public:
    BatchRun(std::vector<Work> works, const Settings& settings, const Listener& listener)
        : settings_(settings), listener_(listener), works_(std::move(works)),
          journal_(settings.output_dir, settings.pipeline) {
        summary_.pipeline = settings.pipeline;
        summary_.by_cause = settings.by_cause;
        summary_.output_dir = settings.output_dir;
        summary_.picture_folder = settings.picture_folder;
        summary_.link_base = settings.link_base;
        for (const auto& work : works_)
            for (const auto& input : work.inputs) claims_.read(input, work.asset.name);
        for (const auto& work : works_) summary_.assets.push_back(work.asset);
        summary_.outcomes.resize(works_.size());
        started_.resize(works_.size());
    }

    Summary run() {
        const Interrupts interrupts([this] { interrupted(); });
        choose_jobs();
        const auto keeping = find_kept();
        std::vector<Job> jobs;
        std::set<fs::path> folders; // folders that no job may write to
        for (std::size_t i = 0; i < works_.size(); ++i)
            if (!keeping[i])
                jobs.push_back({i, works_[i].memory, false});
            else {
                for (const auto& output : keeping[i]->outputs) {
                    const fs::path path = settings_.output_dir / output.path;
                    claims_.keep(path, works_[i].asset.name, output.sha256);
                    folders.insert(path.parent_path());
                }
                finish(i, kept_outcome(*keeping[i]), nullptr);
            }
        for (const auto& folder : folders) remove_abandoned(folder);
        const PoolSettings pool{summary_.jobs, memory(), tokens_.get()};
        Pool(pool, std::move(jobs), [this](const Job& job, const auto& beside) {
            return work(job, beside);
        }).run();
        const std::lock_guard lock(guard_);
        if (settings_.prune) prune_outputs();
        warn(journal_.compact());
        close_summary();
        over_ = true;
        return std::move(summary_);
    }

  private:
    void choose_jobs() {
        const char* makeflags = std::getenv("MAKEFLAGS");
        if (settings_.jobs == 0 && makeflags) tokens_ = Jobserver::offered(makeflags);
        summary_.jobs = settings_.jobs > 0 ? settings_.jobs : tokens_ ? allowed_cores() : default_threads();
        set_threads(summary_.jobs);
    }

    std::uint64_t memory() const { return memory_for_jobs(settings_.memory); }

    std::vector<const Done*> find_kept() {
        std::vector<const Done*> kept(works_.size());
        const auto look = [&](std::size_t i) {
            const Done* done = journal_.unchanged(works_[i].asset.name, works_[i].digest);
            const bool lacks_measures =
                done && settings_.model_row && done->measured != how_measured(settings_);
            const bool lacks_picture = done && settings_.pictures && !done->pictured;
            kept[i] = lacks_measures || lacks_picture ? nullptr : done;
        };
        if (tokens_) // there is only one thread so far
            for (std::size_t i = 0; i < works_.size(); ++i) look(i);
        else
            parallel_for(works_.size(), look, 1);
        return kept;
    }

    /// Runs on a thread of the pool.
    Next work(const Job& job, const std::function<bool()>& beside_others) {
        {
            const std::lock_guard lock(guard_);
            started_[job.index] = true;
        }
        const Stopwatch watch;
        std::optional<Done> done;
        Outcome out;
        try {
            out = run_asset(works_[job.index], done);
        } catch (const Error& e) {
            out = failure(e);
        } catch (const std::exception& e) {
            const auto limit = told_as_limit(e);
            out = failure(limit ? *limit
                                : Error(ErrorKind::bug, "E-BUG", e.what(),
                                        "please report it, with the pipeline and the input"));
        }
        const bool for_memory = std::any_of(out.errors.begin(), out.errors.end(),
                                            [](const Diagnostic& d) { return d.out_of_memory; });
        if (for_memory && !job.alone && beside_others()) return Next::again_alone;
        out.seconds = watch.seconds();
        const bool failed = out.verdict == Verdict::failed;
        finish(job.index, std::move(out), done ? &*done : nullptr);
        return failed && !settings_.keep_going ? Next::stop : Next::go_on;
    }

    Outcome run_asset(const Work& work, std::optional<Done>& done) {
        Problems problems;
        const auto plan = settings_.plan(work.asset, problems);
        problems.throw_if_any(ErrorKind::usage); // the pipeline changed after it was planned
        std::vector<Stamp> before;               // stamps from before reading
        for (const auto& input : work.inputs)
            if (const auto stamp = stamp_of(input)) before.push_back(*stamp);
        std::vector<Diagnostic> warnings;
        pipeline::RunSettings run;
        run.strict = settings_.strict;
        run.check_invariants = settings_.check_invariants;
        run.commit.sync = settings_.sync;
        run.last_picture = settings_.pictures;
        run.model_row = settings_.model_row;
        run.time_limit = settings_.time_limit;
        std::optional<cache::Store> store; // this asset's entries may be evicted when it is done
        if (settings_.store) run.store = &store.emplace(*settings_.store);
        run.on_output = [&](const io::Outputs::File& file) { claims_.write(work.asset, file); };
        run.on_warning = [&](const Diagnostic& d) { warnings.push_back(about_asset(work.asset, d)); };
        if (listener_.on_stage)
            run.on_stage = [&](const report::StageRecord& stage) {
                const std::lock_guard lock(guard_);
                listener_.on_stage(work.asset, stage);
            };
        auto record = pipeline::run_plan(plan, run);
        Outcome out = outcome_of(work.asset, record);
        if (settings_.pictures) add_draw_costs(out.files, settings_.output_dir);
        out.warnings = std::move(warnings);
        for (const auto& error : record.errors) out.errors.push_back(about_asset(work.asset, error));
        if (record.exit_code == 0) {
            done = done_of(work, before, record, out, settings_.output_dir, how_measured(settings_));
            done->pictured = settings_.pictures;
        } else if (!record.reports.empty()) {
            done = reports_of_failed(work, record);
        }
        return out;
    }

    /// Records reports so that they can be pruned; outputs of an earlier run still exist.
    Done reports_of_failed(const Work& work, const report::RunRecord& record) {
        Done done = named_done(work);
        add_reports(done, work, record, settings_.output_dir);
        const std::lock_guard lock(guard_);
        const auto earlier = journal_.all().find(work.asset.name);
        if (earlier == journal_.all().end()) return done;
        for (const auto& output : earlier->second.outputs) {
            const auto is_it = [&](const Stamp& stamp) { return stamp.path == output.path; };
            if (std::none_of(done.outputs.begin(), done.outputs.end(), is_it)) done.outputs.push_back(output);
        }
        return done;
    }

    /// Reports a warning of the batch itself; the caller holds the guard.
    void warn(std::optional<Diagnostic> warning) {
        if (!warning || is_allowed(*warning, settings_.allowed)) return;
        if (auto error = pipeline::strict_failure(*warning, settings_.strict)) {
            summary_.exit_code = worse_exit_code(summary_.exit_code, static_cast<int>(ErrorKind::check));
            summary_.errors.push_back(std::move(*error));
        } else {
            summary_.warnings.push_back(std::move(*warning));
        }
    }

    void finish(std::size_t index, Outcome out, Done* done) {
        const std::lock_guard lock(guard_);
        if (done) warn(journal_.add(std::move(*done)));
        summary_.outcomes[index] = std::move(out);
        started_[index] = false;
        summary_.exit_code = worse_exit_code(summary_.exit_code, summary_.outcomes[index].exit_code);
        summary_.seconds = watch_.seconds();
        if (listener_.on_finished)
            listener_.on_finished(works_[index].asset, summary_.outcomes[index], summary_);
    }

    void prune_outputs() {
        const bool all_made = std::all_of(summary_.outcomes.begin(), summary_.outcomes.end(),
                                          [](const Outcome& out) { return out.verdict == Verdict::ok; });
        if (all_made) return warn(prune(works_, journal_, settings_.output_dir, summary_.pruned));
        warn(Diagnostic{Severity::warning, // the outputs of assets that did not run are unknown
                        "W-PRUNE",
                        "nothing was pruned, because not all assets succeeded",
                        {},
                        "run the batch again when all assets succeed"});
    }

    void close_summary() {
        for (std::size_t i = 0; i < started_.size(); ++i)
            if (started_[i]) summary_.outcomes[i].verdict = Verdict::interrupted;
        summary_.seconds = watch_.seconds();
    }

    /// Called before a signal ends the process: the guard stays locked, so that no more callbacks follow.
    void interrupted() {
        guard_.lock();
        if (over_) return; // the caller already has the summary
        close_summary();
        if (listener_.on_interrupt) listener_.on_interrupt(summary_);
        if (tokens_) tokens_->give_all();
    }

    const Settings& settings_;
    const Listener& listener_;
    const Stopwatch watch_;
    const std::vector<Work> works_;
    std::unique_ptr<Jobserver> tokens_;
    Claims claims_;
    std::mutex guard_; ///< protects all following members
    Journal journal_;
    Summary summary_;
    std::vector<bool> started_; ///< started jobs that are not yet finished
    bool over_ = false;
};

} // namespace

Summary refused(const std::vector<Asset>& assets, const std::string& pipeline, ErrorKind kind,
                const std::vector<Diagnostic>& why) {
    Summary summary;
    summary.pipeline = pipeline;
    summary.assets = assets;
    summary.outcomes.resize(assets.size());
    summary.exit_code = static_cast<int>(kind);
    for (const auto& d : why)
        if (d.severity == Severity::error) summary.errors.push_back(d);
    return summary;
}

std::uint64_t memory_for_jobs(std::uint64_t asked) { return asked > 0 ? asked : memory_there() / 4 * 3; }

std::vector<std::string> former_assets(const fs::path& output_dir, const std::string& pipeline) {
    return Journal::assets_in(output_dir, pipeline);
}

Summary run(std::vector<Work> works, const Settings& settings, const Listener& listener) {
    return BatchRun(std::move(works), settings, listener).run();
}

} // namespace facetmill::batch
