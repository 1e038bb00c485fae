#include "pipeline/cell_source.hpp"

#include "base/stopwatch.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/memory.hpp"
#include "pipeline/between_stages.hpp"

#include <fmt/format.h>
#include <span>

namespace facetmill::pipeline {

namespace {

std::string key_with_inputs(const CellFlow& cells) {
    std::vector<std::string> texts{cells.means.key};
    for (const auto& file : cells.partition->source().contents().files) texts.push_back(file.sha256);
    return cache::key_of(texts);
}

report::Brief brief_of_cells(const CellFlow& cells) {
    if (cells.scene) return report::brief_of(*cells.scene);
    if (!cells.partition) return {};
    return {.parts = 1,
            .vertices = cells.partition->vertices(),
            .faces = cells.partition->faces(),
            .bounds = cells.bounds()};
}

std::vector<cells::FaceSource::File> inputs_of(const CellFlow& cells) {
    if (!cells.partition) return {};
    return cells.partition->source().contents().files;
}

class CellSource {
  public:
    CellSource(Engine& engine, SceneState& flow) : engine_(engine), flow_(flow) {
        const CellSettings& settings = engine.settings.cells;
        cells_.means = {settings.scratch, settings.memory};
        cells_.means.job = settings.job;
        if (cells_.means.memory == 0) cells_.means.memory = memory_there() / 4 * 3;
    }

    void open_kept() {
        const RunSettings& settings = engine_.settings;
        if (settings.cells.kept.empty()) return;
        const auto& job = cells_.means.job;
        const bool beside = job && !job->makes_cells();
        cells_.means.kept = std::make_shared<cells::CellFolder>(
            cells::CellFolder::Settings{settings.cells.kept, settings.commit.sync, settings.on_kept_cells,
                                        beside ? name_of(*job) : std::string{}});
    }
    /// Marks the cells as processed by the step, which another job does.
    void pass(const Step& step) { cells_.means.key = key_after(cells_.means.key, step); }

    /// why: the reason that the mesh is in cells.
    bool run(const Step& step, const std::string& why, report::StageRecord& stage) {
        stage.before = brief_of_cells(cells_);
        const Stopwatch watch;
        const ProgressScope share(engine_.settings.progress);
        const bool done = engine_.failures.guarded(step.where, fmt::format("'{}'", step.name),
                                                   [&] { perform(step, why, stage); });
        stage.seconds = watch.seconds();
        if (!done) return false;
        stage.after = brief_of_cells(cells_);
        if (!cells_.scene) return true;
        flow_.scene = std::move(*cells_.scene);
        flow_.replaced();
        flow_.in_cells = false;
        return true;
    }

  private:
    void perform(const Step& step, const std::string& why, report::StageRecord& stage) {
        RunState& state = engine_.state;
        Context context(state, stage, step.only, cells_.bounds(), step.where);
        const bool loads = step.info->loads;
        if (loads) context.say(why);
        pass(step);
        const auto inputs = inputs_of(cells_); // keeps the inputs open
        step.stage->on_cells(cells_, context);
        cells::require_unchanged(inputs);
        if (loads) state.load_diagonal = diagonal(cells_.bounds());
        if (loads) cells_.means.key = key_with_inputs(cells_);
        if (!cells_.scene) return;
        require_finite(*cells_.scene);
        if (cells_.surface)
            warn_of_lost_surface({*cells_.surface}, surfaces_of_parts(*cells_.scene), step.stage->may_lose(),
                                 context);
        engine_.emit({.kind = Event::Kind::ran, .step = &step, .scene = &*cells_.scene});
    }

    Engine& engine_;
    SceneState& flow_;
    CellFlow cells_;
};

} // namespace

bool run_on_cells(Engine& engine, const CellPlan& plan, SceneState& flow) {
    const auto& job = engine.settings.cells.job;
    CellSource source(engine, flow);
    if (!engine.failures.guarded({}, "kept cells", [&] { source.open_kept(); })) return false;
    flow.in_cells = true;
    for (const Step& step : std::span(engine.plan.steps).first(plan.steps)) {
        if (job && (step.info->checks || step.info->tells)) { // the last run does it
            source.pass(step);
            continue;
        }
        const std::size_t checked = engine.record().checks.size();
        const auto run = [&](report::StageRecord& stage) { return source.run(step, plan.why, stage); };
        if (!engine.run_stage(step, flow, run) || !engine.failures.judge_checks(checked)) return false;
        if (job && job->makes_cells()) return false;
    }
    return !flow.in_cells;
}

} // namespace facetmill::pipeline
