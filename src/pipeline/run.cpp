#include "pipeline/run.hpp"

#include "base/stopwatch.hpp"
#include "base/text/words.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/outputs/early_folders.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"
#include "pipeline/between_stages.hpp"
#include "pipeline/failures.hpp"
#include "pipeline/join.hpp"
#include "pipeline/page.hpp"
#include "pipeline/page_view.hpp"
#include "pipeline/stage_cache.hpp"
#include "report/contents.hpp"
#include "report/render.hpp"
#include "report/scene_picture.hpp"
#include "stage/known_surfaces.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::pipeline {

namespace fs = std::filesystem;

namespace {

int count_stages(const Steps& steps) {
    int count = 0;
    for (const auto& step : steps) {
        count += step.kind == Step::Kind::stage;
        for (const auto& arm : step.arms) count += count_stages(*arm.steps);
    }
    return count;
}

/// Whether a contract or a stage compares with the scene as loaded.
bool compares_with_load(const Steps& steps) {
    return std::any_of(steps.begin(), steps.end(), [](const Step& step) {
        if (step.ensure && step.ensure->deviation &&
            step.ensure->deviation->from == DeviationLimits::From::load)
            return true;
        if (step.kind == Step::Kind::stage)
            return step.stage->compares_with_load && step.stage->compares_with_load(step.options.get());
        return std::any_of(step.arms.begin(), step.arms.end(),
                           [](const Arm& arm) { return compares_with_load(*arm.steps); });
    });
}

bool loads(const Steps& steps) {
    return std::any_of(steps.begin(), steps.end(), [](const Step& step) {
        if (step.kind == Step::Kind::stage) return step.stage->loads;
        return std::any_of(step.arms.begin(), step.arms.end(),
                           [](const Arm& arm) { return loads(*arm.steps); });
    });
}

void write_report(const Plan& plan, const std::string& path, const report::RunRecord& record,
                  const io::CommitSettings& commit = {}, const Json& view = nullptr) {
    const std::string text = report::render_for(path, record, view);
    io::write_now(plan.places.output(path), std::as_bytes(std::span(text)), commit);
}

class Runner {
  public:
    Runner(const Plan& plan, const RunSettings& settings) : plan_(plan), settings_(settings) {
        state_.places = plan.places;
        state_.read_back = settings.read_back;
        state_.outputs.set(settings.commit);
        record().pipeline = plan.name;
        record().about = plan.about;
        record().params = plan.params;
        record().text = plan.text;
        record().command = plan.command;
    }

    report::RunRecord run() {
        const Stopwatch watch;
        stages_ = count_stages(plan_.steps);
        keeps_loaded_ = compares_with_load(plan_.steps);
        if (keeps_loaded_) reuse_.keep_loads();
        const auto is_page = [](const std::string& path) { return path.ends_with(".html"); };
        takes_pictures_ =
            settings_.on_view || std::any_of(plan_.reports.begin(), plan_.reports.end(), is_page);
        measures_ =
            !takes_pictures_ && std::any_of(plan_.reports.begin(), plan_.reports.end(),
                                            [](const std::string& path) { return path.ends_with(".md"); });
        if (measures_) page_.leave_out_pictures();
        for (const auto& warning : plan_.warnings) {
            failures_.warn(warning);
            record().warnings.push_back(warning);
        }
        if (const auto warning = without_effect(plan_)) {
            failures_.warn(*warning);
            record().warnings.push_back(*warning);
        }
        for (const auto& missing : missing_inputs(plan_)) failures_.add(ErrorKind::missing, {missing});
        const Headers headers = read_headers(plan_);
        for (const auto& error : headers.errors) failures_.add(error);
        if (settings_.cells.job) return run_job(watch);
        if (!settings_.commit.names_only) try_outputs(headers);
        SceneState flow;
        const bool small = !failures_.any() && run_on_cells(flow);
        if (small && run_steps(plan_.steps, flow, true, on_cells_.steps) &&
            (takes_pictures_ || !plan_.reports.empty()) && fetch({}, "the inspection at the end", flow))
            failures_.guarded({}, "the inspection at the end", [&] {
                const ProgressScope share = beside_stages("inspection at the end");
                record().final_properties = report::scene_json(flow.scene, inspect(flow.scene));
                if (takes_pictures_ || measures_) page_.at_end(flow.scene);
                if (takes_pictures_) view_.at_end(flow.scene);
            });
        if (small && settings_.last_picture && !takes_pictures_ && !failures_.any() &&
            !record().stages.empty() && fetch({}, "a picture", flow))
            failures_.guarded({}, "a picture", [&] {
                record().stages.back().picture = report::small_picture(flow.scene, record().not_drawn);
            });
        finish_outputs();
        record_cost(watch);
        write_reports();
        if (settings_.progress) settings_.progress->done();
        if (settings_.on_trace) settings_.on_trace(trace_);
        return std::move(record());
    }

  private:
    report::RunRecord& record() { return state_.record; }

    void record_cost(const Stopwatch& watch) {
        record().seconds = watch.seconds();
        record().peak_memory = peak_memory();
        record().threads = threads();
    }

    /// Makes the scene of the flow be there. False after a failure.
    bool fetch(const Mark& where, const std::string& what, SceneState& flow) {
        return flow.is_here() || failures_.guarded(where, what, [&] { reuse_.fetch(flow); });
    }

    /// Whether the step looks at the scene before its stage runs.
    static bool looks_ahead(const Step& step) {
        return (step.when && !step.when->known) || (step.ensure && step.ensure->deviation) ||
               (step.kind != Step::Kind::stage && (step.join || step.arms_of_parts));
    }

    CellPlan planned_cells() const {
        CellPlan cells = plan_cells(plan_, settings_.cells);
        if (settings_.cells.job) require_jobs(plan_, cells);
        return cells;
    }

    /// Runs the first steps where they are to work on cells; the scene is in memory afterwards. False after a
    /// failure, and when all steps were done on cells.
    bool run_on_cells(SceneState& flow) {
        if (!failures_.guarded({}, "the plan", [&] { on_cells_ = planned_cells(); })) return false;
        if (on_cells_.steps == 0) return true;
        if (keeps_loaded_ && !failures_.guarded({}, "the plan", [] { refuse_reference(); })) return false;
        CellFlow cells;
        cells.means = {settings_.cells.scratch, settings_.cells.memory};
        cells.means.job = settings_.cells.job;
        if (cells.means.memory == 0) cells.means.memory = memory_there() / 4 * 3;
        output_folder_.make(plan_.places.output_base); // where temporary data usually is
        if (!failures_.guarded({}, "kept cells", [&] { open_kept(cells.means); })) return false;
        for (std::size_t i = 0; i < on_cells_.steps; ++i) {
            const Step& step = plan_.steps[i];
            if (cells.means.job && (step.stage->checks || step.stage->tells)) { // for the last run
                cells.means.key = key_after(cells.means.key, step);
                continue;
            }
            if (!run_stage_on_cells(step, cells)) return false;
            if (cells.means.job && cells.means.job->makes_cells()) return false;
        }
        if (!cells.scene) return false;
        flow.scene = std::move(*cells.scene);
        flow.replaced();
        return true;
    }

    /// A part of a run that several processes do: without outputs and reports.
    report::RunRecord run_job(const Stopwatch& watch) {
        SceneState ignored;
        if (!failures_.any()) run_on_cells(ignored);
        record_cost(watch);
        if (settings_.progress) settings_.progress->done();
        return std::move(record());
    }

    void open_kept(cells::CellResources& means) const {
        if (settings_.cells.kept.empty()) return;
        const bool beside = means.job && !means.job->makes_cells();
        means.kept = std::make_shared<cells::CellFolder>(
            cells::CellFolder::Settings{settings_.cells.kept, settings_.commit.sync, settings_.on_kept_cells,
                                        beside ? name_of(*means.job) : std::string{}});
    }

    [[noreturn]] static void refuse_reference() {
        throw Error(ErrorKind::usage, "E-CELLS",
                    "a later step compares with the scene as loaded, which is not in memory",
                    "leave the comparison out, or give more memory");
    }

    static std::string key_with_inputs(const CellFlow& cells) {
        std::vector<std::string> texts{cells.means.key};
        for (const auto& file : cells.partition->source().contents().files) texts.push_back(file.sha256);
        return cache::key_of(texts);
    }

    static report::Brief brief_of_cells(const CellFlow& cells) {
        if (cells.scene) return report::brief_of(*cells.scene);
        if (!cells.partition) return {};
        return {.parts = 1,
                .vertices = cells.partition->vertices(),
                .faces = cells.partition->faces(),
                .bounds = cells.bounds()};
    }

    static std::vector<cells::FaceSource::File> inputs_of(const CellFlow& cells) {
        if (!cells.partition) return {};
        return cells.partition->source().contents().files;
    }

    bool run_stage_on_cells(const Step& step, CellFlow& cells) {
        auto stage = new_record(step);
        stage.before = brief_of_cells(cells);
        trace_.push_back({step.name, step.stage->name, stage.options, {}, {}, {}, TracedStep::Way::always});
        const Stopwatch watch;
        const ProgressScope share(settings_.progress);
        const std::size_t checked = record().checks.size();
        const bool done = failures_.guarded(step.where, fmt::format("'{}'", step.name), [&] {
            Context context(state_, stage, step.only, cells.bounds(), step.where);
            if (step.stage->loads) context.say(on_cells_.why);
            cells.means.key = key_after(cells.means.key, step);
            const auto inputs = inputs_of(cells); // kept open
            step.stage->on_cells(step.options.get(), cells, context);
            cells::require_unchanged(inputs);
            if (step.stage->loads) state_.load_diagonal = diagonal(cells.bounds());
            if (step.stage->loads) cells.means.key = key_with_inputs(cells);
            if (cells.scene) require_finite(*cells.scene);
            if (cells.surface)
                warn_of_lost_surface({*cells.surface}, surfaces_of_parts(*cells.scene),
                                     step.stage->may_lose_with ? step.stage->may_lose_with(step.options.get())
                                                               : step.stage->may_lose,
                                     context);
            if (settings_.check_invariants && cells.scene) check_invariants(step, *cells.scene);
        });
        stage.seconds = watch.seconds();
        if (done) stage.after = brief_of_cells(cells);
        if (done && takes_pictures_ && cells.scene)
            failures_.guarded({}, "a picture",
                              [&] { page_.after(step, *cells.scene, stage, record().outputs.size()); });
        if (settings_.on_stage) settings_.on_stage(stage);
        for (const auto& warning : stage.warnings) failures_.warn(warning);
        record().stages.push_back(std::move(stage));
        return done && failures_.judge_checks(checked);
    }

    /// Runs the steps on the scene. False when the chain ended early; the scene is then worth nothing.
    /// needed: whether the scene is looked at afterwards. first: the steps before it are done.
    bool run_steps(const Steps& steps, SceneState& flow, bool needed, std::size_t first = 0) {
        bool holds = true; // no check has failed so far
        for (const auto& step : std::span(steps).subspan(first)) {
            const bool judges = step.kind == Step::Kind::stage && step.stage->checks;
            if (!holds && !judges) return false;
            const bool last = &step == &steps.back();
            bool skip = false;
            if (looks_ahead(step) && !fetch(step.where, step.name, flow)) return false;
            if (!failures_.guarded(step.where, "the condition", [&] { skip = is_skipped(step, flow.scene); }))
                return false;
            if (skip) {
                record_skipped(step);
                continue;
            }
            std::size_t checked = record().checks.size();
            std::shared_ptr<const Surface> reference;
            if (!failures_.guarded(step.where, step.name,
                                   [&] { reference = reference_of(step, flow.scene); }))
                return false;
            const Box entered = step.ensure ? flow.bounds() : Box{};
            const bool done = step.kind == Step::Kind::stage ? run_stage(step, flow)
                                                             : run_arms(step, flow, needed || !last);
            if (!done || (step.ensure && !fetch(step.where, step.name, flow))) return false;
            if (step.kind != Step::Kind::stage)
                checked = record().checks.size(); // those of the arms are judged
            if (step.ensure && !failures_.guarded(step.where, step.name, [&] {
                    const std::size_t first = record().checks.size();
                    check_contract(step, flow.scene, entered, reference.get());
                    if (takes_pictures_ || measures_) show_failures(step, flow.scene, first);
                }))
                return false;
            holds = failures_.judge_checks(checked) && holds;
        }
        return holds;
    }

    void show_failures(const Step& step, const Scene& scene, std::size_t first_check) {
        if (page_.failures(step.name, scene, first_check) && takes_pictures_) view_.failed(step.name, scene);
    }

    /// Checks of what the scene is at this place. Resolved lengths are recorded in `record`.
    std::vector<report::Check> judged(const Assertions& assertions, const Step& step, const Scene& scene,
                                      const Box& entering, report::StageRecord& record) {
        Context context(state_, record, step.only, entering, step.where);
        return evaluate(resolved(assertions, scene, context), inspect(scene, assertions.settings()),
                        step.name);
    }

    bool is_skipped(const Step& step, const Scene& scene) {
        if (!step.when) return false;
        if (step.when->known) return !*step.when->known;
        report::StageRecord none; // there is a record of the step only when it runs
        const auto results = judged(step.when->predicates, step, scene, scene.bounds(), none);
        return !std::all_of(results.begin(), results.end(), [](const auto& check) { return check.passed; });
    }

    report::StageRecord new_record(const Step& step) {
        report::StageRecord stage;
        stage.name = step.name;
        stage.stage = step.stage->name;
        stage.path = step.path;
        stage.options = options_json(step);
        ++number_; // parts found at run time may bring more stages than were planned
        if (settings_.progress) settings_.progress->stage(number_, std::max(number_, stages_), step.name);
        return stage;
    }

    /// All stages of a branch or foreach; where its arms are parts, which nobody looks for, as they were
    /// planned.
    void record_skipped(const Step& step) {
        for (const Arm& arm : step.arms)
            for (const Step& inner : *arm.steps) record_skipped(inner);
        if (step.kind != Step::Kind::stage) return;
        auto stage = new_record(step);
        stage.skipped = true;
        trace_.push_back({step.name, step.stage->name, stage.options, {}, {}, {}, TracedStep::Way::skipped});
        record().stages.push_back(std::move(stage));
    }

    bool run_stage(const Step& step, SceneState& flow) {
        auto stage = new_record(step);
        if (takes_pictures_ && fetch(step.where, "a picture", flow))
            failures_.guarded({}, "the 3D view", [&] { view_.before(step, flow.scene); });
        const Stopwatch watch;
        const std::size_t outputs = record().outputs.size(), checks = record().checks.size();
        if (takes_pictures_ && fetch(step.where, "a picture", flow))
            failures_.guarded({}, "a picture", [&] { page_.before(step, flow.scene); });
        const bool recalled = reuse_.recall(step, flow, state_, stage);
        const bool done = recalled || perform_stage(step, flow, stage);
        if (recalled) stage.seconds = watch.seconds();
        stage.peak_memory = peak_memory();
        if (done && takes_pictures_ && fetch(step.where, "a picture", flow))
            failures_.guarded({}, "a picture", [&] {
                const ProgressScope share = beside_stages(fmt::format("picture after {}", step.name));
                page_.after(step, flow.scene, stage, outputs);
                show_failures(step, flow.scene, checks);
            });
        if (done && measures_) measure_stage(step, flow, outputs, checks);
        if (settings_.on_stage) settings_.on_stage(stage);
        for (const auto& warning : stage.warnings) failures_.warn(warning);
        record().stages.push_back(std::move(stage));
        if (done && takes_pictures_)
            failures_.guarded({}, "the 3D view", [&] { view_.after(step, flow.scene, record(), outputs); });
        return done;
    }

    /// For Markdown: how far what the stage wrote is off, and what its checks found.
    void measure_stage(const Step& step, SceneState& flow, std::size_t first_output,
                       std::size_t first_check) {
        const bool measured = page_.is_measured(step, first_output);
        const bool judged = record().checks.size() > first_check;
        if (!(measured || judged) || !fetch(step.where, "the deviation", flow)) return;
        failures_.guarded({}, "the deviation", [&] {
            const ProgressScope share = beside_stages(fmt::format("deviation after {}", step.name));
            if (measured) page_.measure(step, flow.scene, first_output);
            if (judged) show_failures(step, flow.scene, first_check);
        });
    }

    /// Runs the stage on the scene, and remembers what it did.
    bool perform_stage(const Step& step, SceneState& flow, report::StageRecord& stage) {
        if (!fetch(step.where, fmt::format("'{}'", step.name), flow)) return false;
        Scene& scene = flow.scene;
        auto left = std::exchange(flow.left, std::nullopt);
        if (left && settings_.check_invariants) check_left(step, *left, scene);
        stage.before = left ? left->brief : report::brief_of(scene);
        auto surfaces = left ? std::move(left->surfaces) : std::nullopt;
        const auto before = reuse_.before(step, flow, state_);
        const Stopwatch watch;
        const ProgressScope share(settings_.progress);
        const bool done = failures_.guarded(step.where, fmt::format("'{}'", step.name), [&] {
            Context context(state_, stage, step.only, stage.before->bounds, step.where);
            if (!step.only.patterns.empty() && !step.stage->loads)
                warn_of_empty_selection(step, scene, context);
            scene = perform(*step.stage, std::move(scene), step.options.get(), context, surfaces);
            require_finite(scene);
            if (settings_.check_invariants) check_invariants(step, scene);
        });
        stage.seconds = watch.seconds();
        if (!done) return false;
        stage.after = report::brief_of(scene);
        if (step.stage->loads) state_.load_diagonal = diagonal(stage.after->bounds);
        if (step.stage->loads && keeps_loaded_)
            state_.loaded = std::make_shared<const Surface>(surface_or_points_of(scene, filled_surface));
        reuse_.keep(step, flow, state_, stage, before);
        flow.left = {*stage.after, std::move(surfaces)};
        return true;
    }

    /// Until its end, work that is not of a stage tells its share.
    ProgressScope beside_stages(const std::string& what) const {
        if (settings_.progress) settings_.progress->beside_stages(what);
        return ProgressScope(settings_.progress);
    }

    /// The surface that a contract on the deviation compares with.
    std::shared_ptr<const Surface> reference_of(const Step& step, const Scene& scene) const {
        if (!step.ensure || !step.ensure->deviation) return {};
        if (step.ensure->deviation->from == DeviationLimits::From::load && state_.loaded)
            return state_.loaded;
        return std::make_shared<const Surface>(surface_or_points_of(scene, filled_surface));
    }

    /// entered: the bounds of the scene that entered the step.
    void check_contract(const Step& step, const Scene& scene, const Box& entered, const Surface* reference) {
        report::StageRecord none; // a branch has no record of its own
        none.name = step.name;
        const bool recorded = step.kind == Step::Kind::stage && !record().stages.empty();
        const ProgressScope share = beside_stages(fmt::format("ensure of {}", step.name));
        report::StageRecord& stage = recorded ? record().stages.back() : none;
        const auto& assertions = step.ensure->assertions;
        if (!assertions.all.empty())
            for (auto& check : judged(assertions, step, scene, entered, stage))
                record().checks.push_back(std::move(check));
        if (!step.ensure->deviation || !reference) return;
        Context context(state_, stage, step.only, reference->bounds(), step.where);
        check_deviation(*step.ensure->deviation, step.ensure->deviation_at, *reference, scene, context);
    }

    // --- branches

    bool run_arms(const Step& step, SceneState& flow, bool needed) {
        if (step.arms_of_parts) return run_part_arms(step, flow);
        std::vector<NamedScene> results;
        bool all_done = true;
        if (!failures_.guarded(step.where, step.name, [&] { reuse_.before_arms(flow, step.arms); }))
            return false;
        for (const auto& arm : step.arms) {
            const bool moved = &arm == &step.arms.back() && (step.join || !needed);
            SceneState inside;
            if (!failures_.guarded(step.where, step.name, [&] {
                    if (moved)
                        inside = std::move(flow);
                    else
                        inside = flow.branched_off();
                }))
                return false;
            all_done = run_arm(step, arm, inside) && all_done;
            if (moved)
                flow.spent_before_branch = inside.spent_before_branch;
            else
                flow.spend(inside.spent_before_branch); // it is not there for the next arm
            if (step.join) results.push_back({arm.name, std::move(inside.scene)});
        }
        if (!step.join) return true; // the scene that entered goes on, whatever became of the branches
        if (!all_done) return false;
        flow.scene = joined(std::move(results));
        flow.replaced();
        return true;
    }

    /// What joins is one where its documents are the same objects, which those of the cache need not be.
    bool run_arm(const Step& step, const Arm& arm, SceneState& inside) {
        inside.without_cache |= step.join && (!inside.scene.documents.empty() || loads(*arm.steps));
        const auto reference = page_.reference();
        const bool done =
            run_steps(*arm.steps, inside, step.join) && (!step.join || fetch(step.where, step.name, inside));
        page_.set_reference(reference);
        return done;
    }

    bool run_part_arms(const Step& step, SceneState& flow) {
        Scene& scene = flow.scene;
        std::vector<std::string> names;
        std::vector<std::size_t> parts;
        for (std::size_t p = 0; p < scene.parts.size(); ++p)
            if (step.parts.selects(scene.parts[p], scene)) {
                names.push_back(scene.parts[p].name);
                parts.push_back(p);
            }
        if (names.empty()) warn_of_no_parts(step, scene);
        Problems problems;
        const auto arms = step.arms_of_parts(names, problems);
        check_new_files(arms, problems);
        for (const auto& d : problems.all())
            if (d.severity == Severity::error) failures_.add(ErrorKind::usage, {d});
        if (problems.any_errors()) return false;

        std::vector<std::vector<NamedScene>> results(scene.parts.size());
        bool all_done = true;
        for (const auto& arm : arms) {
            const std::size_t p = parts[arm.part.value_or(0)];
            SceneState inside;
            inside.without_cache = flow.without_cache;
            inside.scene.materials = scene.materials;
            inside.scene.documents = scene.documents;
            inside.scene.unit = scene.unit;
            inside.scene.up = scene.up;
            if (!failures_.guarded(step.where, step.name,
                                   [&] { inside.scene.parts.push_back(scene.parts[p]); }))
                return false;
            all_done = run_arm(step, arm, inside) && all_done;
            if (step.join) results[p].push_back({arm.name, std::move(inside.scene)});
        }
        if (!step.join) return true;
        if (!all_done) return false;
        scene = with_parts_replaced(std::move(scene), std::move(results));
        flow.replaced();
        return true;
    }

    void warn_of_no_parts(const Step& step, const Scene& scene) {
        const Diagnostic warning{Severity::warning, "W-ONLY",
                                 fmt::format("foreach runs over none of the {} parts", scene.parts.size()),
                                 step.where, names_hint(scene)};
        record().warnings.push_back(warning);
        failures_.warn(warning);
    }

    /// Now that the parts have names, so have the files written for each.
    void check_new_files(const std::vector<Arm>& arms, Problems& problems) {
        auto files = planned_files(plan_.steps, plan_.places);
        files.insert(files.end(), plan_.others.begin(), plan_.others.end());
        for (const auto& arm : arms) {
            auto inner = planned_files(*arm.steps, plan_.places);
            for (auto& file : inner) {
                const bool is_known = std::any_of(files.begin(), files.end(), [&](const auto& f) {
                    return !f.written && f.path == file.path;
                });
                if (file.written || !is_known) files.push_back(std::move(file));
            }
        }
        check_collisions(files, problems);
    }

    // --- files

    /// Stages a small file for everything that will be written, and removes it again: a folder that is full
    /// or read-only is found before the work. One error a folder.
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

    /// A texture that is copied to where it is stays as it is.
    static bool is_read(const fs::path& path, const Headers& headers) {
        return std::any_of(headers.more_inputs.begin(), headers.more_inputs.end(),
                           [&](const fs::path& input) {
                               std::error_code ignored; // what is not there is no other file
                               return fs::equivalent(input, path, ignored);
                           });
    }

    /// All that can be written are, whatever became of the others.
    void write_reports() {
        if (settings_.on_view) settings_.on_view(view_.json());
        for (const auto& path : plan_.reports) {
            const ProgressScope share = beside_stages(path);
            if (!unwritable_.contains(plan_.places.output(path).parent_path()) &&
                failures_.guarded({}, "the report", [&] {
                    write_report(plan_, path, record(), settings_.commit, view_.json());
                }))
                record().reports.push_back(path);
        }
    }

    void finish_outputs() {
        if (!failures_.any() && failures_.guarded({}, "writing the outputs", [&] {
                if (settings_.on_output)
                    for (const auto& file : state_.outputs.files()) settings_.on_output(*file);
                if (!settings_.commit.names_only) state_.outputs.commit();
            }))
            return;
        state_.outputs.discard();
        record().outputs.clear();
    }

    const Plan& plan_;
    const RunSettings& settings_;
    RunState state_;
    Failures failures_{state_.record, settings_, plan_.allowed};
    Trace trace_;
    StageCache reuse_{settings_.check_invariants ? nullptr : settings_.store, plan_.places, trace_};
    std::set<fs::path> unwritable_; ///< folders
    CellPlan on_cells_;
    io::EarlyFolders output_folder_;
    bool keeps_loaded_ = false, takes_pictures_ = false;
    bool measures_ = false; ///< how far results are off, for Markdown without a page
    Page page_{state_.record};
    PageView view_{plan_.steps, page_};
    int number_ = 0, stages_ = 0;
};

} // namespace

std::vector<std::string> report_refusal(const Plan& plan, const Problems& problems) {
    report::RunRecord record;
    record.pipeline = plan.name;
    record.about = plan.about;
    record.params = plan.params;
    record.text = plan.text;
    record.command = plan.command;
    record.exit_code = static_cast<int>(ErrorKind::usage);
    for (const auto& d : problems.all())
        if (d.severity == Severity::error)
            record.errors.push_back({d});
        else
            record.warnings.push_back(d);
    for (const auto& path : plan.reports) write_report(plan, path, record);
    return plan.reports;
}

report::RunRecord run_plan(const Plan& plan, const RunSettings& settings) {
    return Runner(plan, settings).run();
}

} // namespace facetmill::pipeline
