#include "pipeline/run.hpp"

#include "base/stopwatch.hpp"
#include "cache/state.hpp"
#include "io/outputs/early_folders.hpp"
#include "parallel/parallel.hpp"
#include "pipeline/cell_source.hpp"
#include "pipeline/observers.hpp"
#include "pipeline/time_limit.hpp"
#include "platform/available_memory.hpp"
#include "report/render.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::pipeline {

namespace fs = std::filesystem;

namespace {

/// The approximate number of outputs: files that stages name.
std::size_t count_outputs(const Steps& steps) {
    std::size_t count = 0;
    for_each_step(steps,
                  [&](const Step& step) { count += step.info && step.info->tells && !step.info->checks; });
    return count;
}

/// True if a contract or a stage compares with the scene as loaded.
bool compares_with_load(const Steps& steps) {
    bool any = false;
    for_each_step(steps, [&](const Step& step) {
        const auto* deviation = step.ensure && step.ensure->deviation ? &*step.ensure->deviation : nullptr;
        any |= (deviation && deviation->from == DeviationLimits::From::load) ||
               (step.stage && step.stage->compares_with_load());
    });
    return any;
}

bool takes_from_load(const Steps& steps) {
    bool any = false;
    for_each_step(steps, [&](const Step& step) { any |= step.stage && step.stage->takes_from_load(); });
    return any;
}

/// The record of a run before it begins.
report::RunRecord record_of(const Plan& plan) {
    report::RunRecord record;
    record.pipeline = plan.name;
    record.about = plan.about;
    record.params = plan.params;
    record.text = plan.text;
    record.command = plan.command;
    return record;
}

void write_report(const Plan& plan, const std::string& path, const report::RunRecord& record,
                  const io::CommitSettings& commit = {}, const Json& view = nullptr) {
    const std::string text = report::render_for(path, record, view);
    io::write_now(plan.places.output(path), std::as_bytes(std::span(text)), commit);
}

/// Everything around the steps: checks before them, and writing files after them.
class Runner {
  public:
    Runner(const Plan& plan, const RunSettings& settings)
        : plan_(plan), limit_(settings.progress, settings.time_limit), settings_(settings) {
        settings_.progress = limit_.progress();
        state_.places = plan.places;
        state_.read_back = settings.read_back;
        state_.outputs.set(settings_.commit);
        record() = record_of(plan);
        engine_.keeps_loaded = compares_with_load(plan.steps);
        engine_.keeps_loaded_scene = takes_from_load(plan.steps);
        if (engine_.keeps_loaded || engine_.keeps_loaded_scene) cache_.keep_loads();
        watch_trace(engine_, trace_);
        watch_progress(engine_);
        watch_invariants(engine_);
        watch_record(engine_);
        watch_model(engine_);
        watch_pictures(engine_, page_);
        watch_deviation(engine_, page_);
        watch_view(engine_, view_);
        watch_console(engine_);
    }

    report::RunRecord run() {
        const Stopwatch watch;
        const bool is_job = settings_.cells.job.has_value();
        check_before(is_job);
        SceneState flow;
        const bool in_memory = !failures_.any() && run_cells(flow);
        if (!is_job) {
            if (in_memory && engine_.run_steps(plan_.steps, flow, true, on_cells_.steps))
                engine_.emit({.kind = Event::Kind::ended}, &flow);
            finish_outputs();
        }
        limit_.end();
        record().seconds = watch.seconds();
        record().peak_memory = peak_memory();
        record().threads = threads();
        if (!is_job) write_reports();
        if (settings_.progress) settings_.progress->done();
        if (!is_job && settings_.on_trace) settings_.on_trace(trace_);
        return std::move(record());
    }

  private:
    report::RunRecord& record() { return state_.record; }

    /// Checks everything that is possible before reading a mesh.
    void check_before(bool is_job) {
        std::vector<Diagnostic> warnings = plan_.warnings;
        if (const auto warning = without_effect(plan_)) warnings.push_back(*warning);
        for (const auto& warning : warnings) {
            failures_.warn(warning);
            record().warnings.push_back(warning);
        }
        for (const auto& missing : missing_inputs(plan_)) failures_.add(ErrorKind::missing, {missing});
        const Headers headers = read_headers(plan_);
        for (const auto& error : headers.errors) failures_.add(error);
        if (!is_job && !settings_.commit.names_only) try_outputs(headers);
    }

    /// Runs the first steps on cells if necessary. Returns true if the scene is in memory afterwards.
    bool run_cells(SceneState& flow) {
        const auto planned = [&] {
            on_cells_ = plan_cells(plan_, settings_.cells);
            if (settings_.cells.job) require_jobs(plan_, on_cells_);
            if (on_cells_.steps > 0 && (engine_.keeps_loaded || engine_.keeps_loaded_scene))
                throw Error(ErrorKind::usage, "E-CELLS",
                            "a later step uses the input, which is not in memory",
                            "leave this step out, or give more memory");
        };
        if (!failures_.guarded({}, "the plan", planned)) return false;
        if (on_cells_.steps == 0) return true;
        output_folder_.make(plan_.places.output_base); // the usual place of temporary data
        return run_on_cells(engine_, on_cells_, flow);
    }

    /// Creates and removes a small test file for each output, so that a full or read-only folder is found
    /// before the work. One error per folder.
    void try_outputs(const Headers& headers) {
        constexpr std::size_t a_block = 4096;
        const io::Bytes bytes(a_block);
        auto files = planned_files(plan_.steps, plan_.places);
        files.insert(files.end(), plan_.others.begin(), plan_.others.end());
        for (const auto& path : headers.more_outputs)
            if (!is_read(path, headers)) files.push_back({path, {}, true});
        io::Outputs trial;
        for (const auto& file : files) {
            const fs::path folder = file.path.parent_path();
            if (!file.written || unwritable_.contains(folder)) continue;
            if (!failures_.guarded(file.where, "an output", [&] { trial.add(file.path, bytes, file.where); }))
                unwritable_.insert(folder);
        }
    }

    /// A texture that would be copied onto itself stays unchanged.
    static bool is_read(const fs::path& path, const Headers& headers) {
        return std::any_of(headers.more_inputs.begin(), headers.more_inputs.end(),
                           [&](const fs::path& input) {
                               std::error_code ignored; // a missing file is not the same file
                               return fs::equivalent(input, path, ignored);
                           });
    }

    /// Writes as many reports as possible, even if some fail.
    void write_reports() {
        if (settings_.on_view) settings_.on_view(view_.json());
        for (const auto& path : plan_.reports) {
            const ProgressScope share = engine_.beside_stages(path);
            if (!unwritable_.contains(plan_.places.output(path).parent_path()) &&
                failures_.guarded({}, "the report", [&] {
                    write_report(plan_, path, record(), settings_.commit, view_.json());
                }))
                record().reports.push_back(path);
        }
    }

    void finish_outputs() {
        if (!failures_.any() && failures_.guarded({}, "writing the outputs", [&] {
                const ProgressScope share = engine_.beside_stages("writing the outputs");
                if (settings_.on_output)
                    for (const auto& file : state_.outputs.files()) settings_.on_output(*file);
                if (!settings_.commit.names_only) state_.outputs.commit();
            }))
            return;
        state_.outputs.discard();
        record().outputs.clear();
    }

    const Plan& plan_;
    TimeLimit limit_;
    RunSettings settings_;
    RunState state_;
    Failures failures_{state_.record, settings_, plan_.allowed};
    Trace trace_;
    StageCache cache_{settings_.check_invariants ? nullptr : settings_.store, plan_.places, trace_};
    report::Page page_{state_.record, cache::digest_of};
    report::PageView view_{count_outputs(plan_.steps), page_};
    Engine engine_{plan_, settings_, state_, failures_, cache_};
    std::set<fs::path> unwritable_; ///< folders
    CellPlan on_cells_;
    io::EarlyFolders output_folder_;
};

} // namespace

namespace {

/// True for the value of an option such as -D or --report.
bool is_of_option(const Mark& mark) { return mark.known() && mark.source->name.starts_with('-'); }

/// The reports of a refused run; only the reports of --report if all errors are on the command line.
std::vector<std::string> reports_of_refusal(const Plan& plan, const Problems& problems) {
    std::vector<std::string> reports = plan.reports;
    const auto& all = problems.all();
    if (std::any_of(all.begin(), all.end(), [](const Diagnostic& d) {
            return d.severity == Severity::error && !is_of_option(d.where);
        }))
        return reports;
    std::erase_if(reports, [&](const std::string& report) {
        return std::none_of(plan.others.begin(), plan.others.end(), [&](const PlannedFile& file) {
            return file.written && is_of_option(file.where) && file.path == plan.places.output(report);
        });
    });
    return reports;
}

} // namespace

std::vector<std::string> report_refusal(const Plan& plan, const Problems& problems) {
    report::RunRecord record = record_of(plan);
    record.exit_code = static_cast<int>(ErrorKind::usage);
    for (const auto& d : problems.all())
        if (d.severity == Severity::error)
            record.errors.push_back({d});
        else
            record.warnings.push_back(d);
    auto reports = reports_of_refusal(plan, problems);
    for (const auto& path : reports) write_report(plan, path, record);
    return reports;
}

report::RunRecord run_plan(const Plan& plan, const RunSettings& settings) {
    return Runner(plan, settings).run();
}

} // namespace facetmill::pipeline
