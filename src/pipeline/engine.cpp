#include "pipeline/engine.hpp"

#include "base/stopwatch.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/power_scale.hpp"
#include "pipeline/between_stages.hpp"
#include "pipeline/join.hpp"
#include "platform/available_memory.hpp"
#include "stage/known_surfaces.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace facetmill::pipeline {

namespace {

bool loads(const Steps& steps) {
    bool any = false;
    for_each_step(steps, [&](const Step& step) { any |= step.info && step.info->loads; });
    return any;
}

/// True if the step needs the scene before its stage runs.
bool looks_ahead(const Step& step) {
    return (step.when && !step.when->known) || (step.ensure && step.ensure->deviation) ||
           (step.kind != Step::Kind::stage && (step.join || step.arms_of_parts));
}

/// Checks assertions on the current scene. Records resolved lengths in `record`.
std::vector<report::Check> judged(Engine& run, const Assertions& assertions, const Step& step,
                                  const Scene& scene, const Box& entering, report::StageRecord& record) {
    Context context(run.state, record, step.only, entering, step.where);
    return evaluate(resolved(assertions, scene, context), inspect(scene, assertions.settings()), step.name);
}

bool is_skipped(Engine& run, const Step& step, SceneState& flow) {
    if (!step.when) return false;
    if (step.when->known) return !*step.when->known;
    report::StageRecord none; // the step has a record only if it runs
    const auto results = judged(run, step.when->predicates, step, flow.scene, flow.drawn_bounds(), none);
    return !std::all_of(results.begin(), results.end(), [](const auto& check) { return check.passed; });
}

/// The reference surface of a contract on the deviation.
std::shared_ptr<const Surface> reference_of(Engine& run, const Step& step, const Scene& scene) {
    if (!step.ensure || !step.ensure->deviation) return {};
    if (step.ensure->deviation->from == DeviationLimits::From::load && run.state.loaded)
        return run.state.loaded;
    return std::make_shared<const Surface>(surface_or_points_of(scene, filled_surface));
}

/// entered: the bounding box of the step's input scene.
void check_contract(Engine& run, const Step& step, const Scene& scene, const Box& entered,
                    const Surface* reference) {
    report::StageRecord none; // a branch has no record
    none.name = step.name;
    const ProgressScope share = run.beside_stages(fmt::format("ensure of {}", step.name));
    report::StageRecord& stage = step.info ? run.record().stages.back() : none;
    const auto& assertions = step.ensure->assertions;
    if (!assertions.all.empty())
        for (auto& check : judged(run, assertions, step, scene, entered, stage))
            run.record().checks.push_back(std::move(check));
    if (!step.ensure->deviation || !reference) return;
    Context context(run.state, stage, step.only, reference->bounds(), step.where);
    check_deviation(*step.ensure->deviation, step.ensure->deviation_at, *reference, scene, context);
}

report::StageRecord& begin(Engine& run, const Step& step) {
    report::StageRecord& stage = run.record().stages.emplace_back();
    stage.name = step.name;
    stage.stage = step.info->name;
    stage.path = step.path;
    stage.options = options_json(step);
    run.emit({.kind = Event::Kind::begins, .step = &step, .stage = &stage});
    return stage;
}

/// Records the stages of a skipped branch or foreach. Arms over parts are recorded as planned, because the
/// parts are not looked up.
void record_skipped(Engine& run, const Step& step) {
    for (const Arm& arm : step.arms)
        for (const Step& inner : *arm.steps) record_skipped(run, inner);
    if (step.kind != Step::Kind::stage) return;
    report::StageRecord& stage = begin(run, step);
    stage.skipped = true;
    run.emit({.kind = Event::Kind::skipped, .step = &step, .stage = &stage});
}

/// Runs the stage on the scene, and stores the result in the cache.
bool perform_stage(Engine& run, const Step& step, SceneState& flow, report::StageRecord& stage) {
    const std::string what = fmt::format("'{}'", step.name);
    if (!run.fetch(step.where, what, flow)) return false;
    Scene& scene = flow.scene;
    auto left = std::exchange(flow.left, std::nullopt);
    if (left) run.emit({.kind = Event::Kind::enters, .step = &step, .left = &*left, .scene = &scene});
    stage.before = left ? left->brief : report::brief_of(scene);
    auto surfaces = left ? std::move(left->surfaces) : std::nullopt;
    const auto before = run.cache.before(step, flow, run.state);
    const Stopwatch watch;
    const ProgressScope share(run.settings.progress);
    const bool done = run.failures.guarded(step.where, what, [&] {
        const Box entering = left && left->drawn ? *left->drawn : io::drawn_bounds(scene);
        Context context(run.state, stage, step.only, entering, step.where);
        if (!step.only.patterns.empty() && !step.info->loads) warn_of_empty_selection(step, scene, context);
        scene = perform(*step.stage, std::move(scene), context, surfaces);
        require_finite(scene);
        run.emit({.kind = Event::Kind::ran, .step = &step, .scene = &scene});
    });
    stage.seconds = watch.seconds();
    if (!done) return false;
    stage.after = report::brief_of(scene);
    std::optional<Box> drawn;
    if (step.info->loads) run.state.load_diagonal = diagonal(drawn.emplace(io::drawn_bounds(scene)));
    if (step.info->loads && run.keeps_loaded)
        run.state.loaded = std::make_shared<const Surface>(surface_or_points_of(scene, filled_surface));
    if (step.info->loads && run.keeps_loaded_scene)
        run.state.loaded_scene = std::make_shared<const Scene>(scene);
    run.cache.keep(step, flow, run.state, stage, before, drawn);
    flow.left = {*stage.after, std::move(surfaces), drawn};
    return true;
}

bool recall_or_perform(Engine& run, const Step& step, SceneState& flow, report::StageRecord& stage) {
    const Stopwatch watch;
    const bool recalled = run.cache.recall(step, flow, run.state, stage);
    const bool done = recalled || perform_stage(run, step, flow, stage);
    if (recalled) stage.seconds = watch.seconds();
    stage.peak_memory = peak_memory();
    return done;
}

/// Joining merges documents only if they are the same objects, and cached scenes may contain copies.
bool run_arm(Engine& run, const Step& step, const Arm& arm, SceneState& inside) {
    inside.without_cache |= step.join && (!inside.scene.documents.empty() || loads(*arm.steps));
    run.emit({.kind = Event::Kind::arm, .step = &step});
    const bool done = run.run_steps(*arm.steps, inside, step.join) &&
                      (!step.join || run.fetch(step.where, step.name, inside));
    run.emit({.kind = Event::Kind::arm_done, .step = &step});
    return done;
}

/// Gives each arm the trail of the scene that enters, and collects the files that the arms write.
class ArmTrails {
  public:
    explicit ArmTrails(RunState& state) : state_(state), entered_(state.trail) {}
    void arm_done() {
        auto& all = state_.trail.written;
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(entered_.written.size());
        written_.insert(written_.end(), std::make_move_iterator(first), std::make_move_iterator(all.end()));
        state_.trail = entered_;
    }
    void finish() {
        auto& all = state_.trail.written;
        all.insert(all.end(), std::make_move_iterator(written_.begin()),
                   std::make_move_iterator(written_.end()));
    }

  private:
    RunState& state_;
    SceneTrail entered_;
    std::vector<WrittenScene> written_;
};

bool run_part_arms(Engine& run, const Step& step, SceneState& flow) {
    Scene& scene = flow.scene;
    std::vector<std::string> names;
    std::vector<std::size_t> parts;
    for (std::size_t p = 0; p < scene.parts.size(); ++p)
        if (step.parts.selects(scene.parts[p], scene)) {
            names.push_back(scene.parts[p].name);
            parts.push_back(p);
        }
    if (names.empty()) {
        run.record().warnings.push_back(
            {Severity::warning, "W-ONLY",
             fmt::format("foreach runs over none of the {} parts", scene.parts.size()), step.where,
             names_hint(scene)});
        run.failures.warn(run.record().warnings.back());
    }
    Problems problems;
    const auto arms = step.arms_of_parts(names, problems);
    check_new_files(run.plan, step, arms, problems);
    for (const auto& d : problems.all())
        if (d.severity == Severity::error) run.failures.add(ErrorKind::usage, {d});
    if (problems.any_errors()) return false;

    std::vector<std::vector<NamedScene>> results(scene.parts.size());
    bool all_done = true;
    ArmTrails trails(run.state);
    for (const auto& arm : arms) {
        run.state.number_scene(true); // one part of a fit scene is fit
        const std::size_t p = parts[arm.part.value_or(0)];
        SceneState inside;
        inside.without_cache = flow.without_cache;
        inside.scene.materials = scene.materials;
        inside.scene.documents = scene.documents;
        inside.scene.unit = scene.unit;
        inside.scene.up = scene.up;
        if (!run.guarded(step, [&] { inside.scene.parts.push_back(scene.parts[p]); })) return false;
        all_done = run_arm(run, step, arm, inside) && all_done;
        trails.arm_done();
        if (step.join) results[p].push_back({arm.name, std::move(inside.scene)});
    }
    trails.finish();
    if (!step.join) return true;
    if (!all_done) return false;
    run.state.number_scene(false);
    scene = with_parts_replaced(std::move(scene), std::move(results));
    flow.replaced();
    return true;
}

bool run_arms(Engine& run, const Step& step, SceneState& flow, bool needed) {
    if (step.arms_of_parts) return run_part_arms(run, step, flow);
    std::vector<NamedScene> results;
    bool all_done = true;
    if (!run.guarded(step, [&] { run.cache.before_arms(flow, step.arms); })) return false;
    ArmTrails trails(run.state);
    for (const auto& arm : step.arms) {
        const bool moved = &arm == &step.arms.back() && (step.join || !needed);
        SceneState inside;
        if (!run.guarded(step, [&] { inside = moved ? std::move(flow) : flow.branched_off(); })) return false;
        all_done = run_arm(run, step, arm, inside) && all_done;
        trails.arm_done();
        if (moved)
            flow.spent_before_branch = inside.spent_before_branch;
        else
            flow.spend(inside.spent_before_branch); // no longer available to the next arm
        if (step.join) results.push_back({arm.name, std::move(inside.scene)});
    }
    trails.finish();
    if (!step.join) return true; // the input scene continues, whatever the branches did
    if (!all_done) return false;
    run.state.number_scene(false);
    flow.scene = joined(std::move(results));
    flow.replaced();
    return true;
}

/// True if its checks hold; none if the chain ends.
std::optional<bool> run_step(Engine& run, const Step& step, SceneState& flow, bool needed) {
    bool skip = false;
    if (looks_ahead(step) && !run.fetch(step.where, step.name, flow)) return {};
    if (!run.failures.guarded(step.where, "the condition", [&] { skip = is_skipped(run, step, flow); }))
        return {};
    if (skip) {
        record_skipped(run, step);
        return true;
    }
    std::size_t checked = run.record().checks.size();
    std::shared_ptr<const Surface> reference;
    if (!run.guarded(step, [&] { reference = reference_of(run, step, flow.scene); })) return {};
    const Box entered = step.ensure ? flow.drawn_bounds() : Box{};
    if (step.kind == Step::Kind::stage) {
        const auto source = [&](report::StageRecord& stage) {
            return recall_or_perform(run, step, flow, stage);
        };
        if (!run.run_stage(step, flow, source)) return {};
    } else {
        if (!run_arms(run, step, flow, needed)) return {};
        checked = run.record().checks.size(); // the checks of the arms are already judged
    }
    if (step.ensure) {
        if (!run.fetch(step.where, step.name, flow)) return {};
        const std::size_t first = run.record().checks.size();
        if (!run.guarded(step, [&] { check_contract(run, step, flow.scene, entered, reference.get()); }))
            return {};
        run.emit({.kind = Event::Kind::judged, .step = &step, .first_check = first}, &flow);
    }
    return run.failures.judge_checks(checked);
}

} // namespace

ProgressScope Engine::beside_stages(const std::string& what) const {
    if (settings.progress) settings.progress->beside_stages(what);
    return ProgressScope(settings.progress);
}

void Engine::emit(Event event, SceneState* flow) {
    bool lost = !flow || flow->in_cells; // reports an unavailable scene once
    for (const Watch& watch : watches) {
        if (watch.kind != event.kind || (watch.wants && !watch.wants(event))) continue;
        if (!watch.scene_for) {
            watch.call(event);
            continue;
        }
        lost = lost || !fetch(event.step ? event.step->where : Mark{}, watch.scene_for, *flow);
        if (lost) continue;
        event.scene = &flow->scene;
        failures.guarded({}, watch.scene_for, [&] { watch.call(event); });
    }
}

bool Engine::run_steps(const Steps& steps, SceneState& flow, bool needed, std::size_t first) {
    bool holds = true; // no check has failed so far
    for (const auto& step : std::span(steps).subspan(first)) {
        const bool judges = step.kind == Step::Kind::stage && step.info->checks;
        if (!holds && !judges) return false;
        const auto step_holds = run_step(*this, step, flow, needed || &step != &steps.back());
        if (!step_holds) return false;
        holds = *step_holds && holds;
    }
    return holds;
}

bool Engine::run_stage(const Step& step, SceneState& flow,
                       const std::function<bool(report::StageRecord&)>& source) {
    report::StageRecord& stage = begin(*this, step);
    Event event{.kind = Event::Kind::before,
                .step = &step,
                .stage = &stage,
                .first_output = record().outputs.size(),
                .first_check = record().checks.size()};
    emit(event, &flow);
    const bool done = source(stage);
    if (done && !step.info->keeps_scene) state.number_scene(step.info->moves);
    event.kind = done ? Event::Kind::after : Event::Kind::failed;
    emit(event, &flow);
    for (const auto& warning : stage.warnings) failures.warn(warning);
    return done;
}

bool Engine::fetch(const Mark& where, const std::string& what, SceneState& flow) {
    return flow.is_here() || failures.guarded(where, what, [&] { cache.fetch(flow); });
}

} // namespace facetmill::pipeline
