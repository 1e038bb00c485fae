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
    return std::any_of(steps.begin(), steps.end(), [](const Step& step) {
        if (step.kind == Step::Kind::stage) return step.info->loads;
        return std::any_of(step.arms.begin(), step.arms.end(),
                           [](const Arm& arm) { return loads(*arm.steps); });
    });
}

/// Whether the step looks at the scene before its stage runs.
bool looks_ahead(const Step& step) {
    return (step.when && !step.when->known) || (step.ensure && step.ensure->deviation) ||
           (step.kind != Step::Kind::stage && (step.join || step.arms_of_parts));
}

} // namespace

ProgressScope Engine::beside_stages(const std::string& what) const {
    if (settings.progress) settings.progress->beside_stages(what);
    return ProgressScope(settings.progress);
}

void Engine::emit(Event event, SceneState* flow) {
    bool lost = !flow || flow->in_cells; // a scene that cannot be had is said once
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
        const auto step_holds = run_step(step, flow, needed || &step != &steps.back());
        if (!step_holds) return false;
        holds = *step_holds && holds;
    }
    return holds;
}

/// Whether its checks hold; none where the chain ends.
std::optional<bool> Engine::run_step(const Step& step, SceneState& flow, bool needed) {
    bool skip = false;
    if (looks_ahead(step) && !fetch(step.where, step.name, flow)) return {};
    if (!failures.guarded(step.where, "the condition", [&] { skip = is_skipped(step, flow.scene); }))
        return {};
    if (skip) {
        record_skipped(step);
        return true;
    }
    std::size_t checked = record().checks.size();
    std::shared_ptr<const Surface> reference;
    if (!guarded(step, [&] { reference = reference_of(step, flow.scene); })) return {};
    const Box entered = step.ensure ? flow.bounds() : Box{};
    if (step.kind == Step::Kind::stage) {
        const auto source = [&](report::StageRecord& stage) { return recall_or_perform(step, flow, stage); };
        if (!run_stage(step, flow, source)) return {};
    } else {
        if (!run_arms(step, flow, needed)) return {};
        checked = record().checks.size(); // those of the arms are judged
    }
    if (step.ensure) {
        if (!fetch(step.where, step.name, flow)) return {};
        const std::size_t first = record().checks.size();
        if (!guarded(step, [&] { check_contract(step, flow.scene, entered, reference.get()); })) return {};
        emit({.kind = Event::Kind::judged, .step = &step, .first_check = first}, &flow);
    }
    return failures.judge_checks(checked);
}

report::StageRecord& Engine::begin(const Step& step) {
    report::StageRecord& stage = record().stages.emplace_back();
    stage.name = step.name;
    stage.stage = step.info->name;
    stage.path = step.path;
    stage.options = options_json(step);
    emit({.kind = Event::Kind::begins, .step = &step, .stage = &stage});
    return stage;
}

/// All stages of a branch or foreach; where its arms are parts, which nobody looks for, as they were planned.
void Engine::record_skipped(const Step& step) {
    for (const Arm& arm : step.arms)
        for (const Step& inner : *arm.steps) record_skipped(inner);
    if (step.kind != Step::Kind::stage) return;
    report::StageRecord& stage = begin(step);
    stage.skipped = true;
    emit({.kind = Event::Kind::skipped, .step = &step, .stage = &stage});
}

bool Engine::run_stage(const Step& step, SceneState& flow,
                       const std::function<bool(report::StageRecord&)>& source) {
    report::StageRecord& stage = begin(step);
    Event event{.kind = Event::Kind::before,
                .step = &step,
                .stage = &stage,
                .first_output = record().outputs.size(),
                .first_check = record().checks.size()};
    emit(event, &flow);
    const bool done = source(stage);
    event.kind = done ? Event::Kind::after : Event::Kind::failed;
    emit(event, &flow);
    for (const auto& warning : stage.warnings) failures.warn(warning);
    return done;
}

// --- results from the cache and from memory

bool Engine::fetch(const Mark& where, const std::string& what, SceneState& flow) {
    return flow.is_here() || failures.guarded(where, what, [&] { cache.fetch(flow); });
}

bool Engine::recall_or_perform(const Step& step, SceneState& flow, report::StageRecord& stage) {
    const Stopwatch watch;
    const bool recalled = cache.recall(step, flow, state, stage);
    const bool done = recalled || perform_stage(step, flow, stage);
    if (recalled) stage.seconds = watch.seconds();
    stage.peak_memory = peak_memory();
    return done;
}

/// Runs the stage on the scene, and remembers what it did.
bool Engine::perform_stage(const Step& step, SceneState& flow, report::StageRecord& stage) {
    const std::string what = fmt::format("'{}'", step.name);
    if (!fetch(step.where, what, flow)) return false;
    Scene& scene = flow.scene;
    auto left = std::exchange(flow.left, std::nullopt);
    if (left) emit({.kind = Event::Kind::enters, .step = &step, .left = &*left, .scene = &scene});
    stage.before = left ? left->brief : report::brief_of(scene);
    auto surfaces = left ? std::move(left->surfaces) : std::nullopt;
    const auto before = cache.before(step, flow, state);
    const Stopwatch watch;
    const ProgressScope share(settings.progress);
    const bool done = failures.guarded(step.where, what, [&] {
        Context context(state, stage, step.only, stage.before->bounds, step.where);
        if (!step.only.patterns.empty() && !step.info->loads) warn_of_empty_selection(step, scene, context);
        scene = perform(*step.stage, std::move(scene), context, surfaces);
        require_finite(scene);
        emit({.kind = Event::Kind::ran, .step = &step, .scene = &scene});
    });
    stage.seconds = watch.seconds();
    if (!done) return false;
    stage.after = report::brief_of(scene);
    if (step.info->loads) state.load_diagonal = diagonal(stage.after->bounds);
    if (step.info->loads && keeps_loaded)
        state.loaded = std::make_shared<const Surface>(surface_or_points_of(scene, filled_surface));
    cache.keep(step, flow, state, stage, before);
    flow.left = {*stage.after, std::move(surfaces)};
    return true;
}

// --- conditions and contracts

/// Checks of what the scene is at this place. Resolved lengths are recorded in `record`.
std::vector<report::Check> Engine::judged(const Assertions& assertions, const Step& step, const Scene& scene,
                                          const Box& entering, report::StageRecord& record) {
    Context context(state, record, step.only, entering, step.where);
    return evaluate(resolved(assertions, scene, context), inspect(scene, assertions.settings()), step.name);
}

bool Engine::is_skipped(const Step& step, const Scene& scene) {
    if (!step.when) return false;
    if (step.when->known) return !*step.when->known;
    report::StageRecord none; // there is a record of the step only when it runs
    const auto results = judged(step.when->predicates, step, scene, scene.bounds(), none);
    return !std::all_of(results.begin(), results.end(), [](const auto& check) { return check.passed; });
}

/// The surface that a contract on the deviation compares with.
std::shared_ptr<const Surface> Engine::reference_of(const Step& step, const Scene& scene) const {
    if (!step.ensure || !step.ensure->deviation) return {};
    if (step.ensure->deviation->from == DeviationLimits::From::load && state.loaded) return state.loaded;
    return std::make_shared<const Surface>(surface_or_points_of(scene, filled_surface));
}

/// entered: the bounds of the scene that entered the step.
void Engine::check_contract(const Step& step, const Scene& scene, const Box& entered,
                            const Surface* reference) {
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
    Context context(state, stage, step.only, reference->bounds(), step.where);
    check_deviation(*step.ensure->deviation, step.ensure->deviation_at, *reference, scene, context);
}

// --- branches

bool Engine::run_arms(const Step& step, SceneState& flow, bool needed) {
    if (step.arms_of_parts) return run_part_arms(step, flow);
    std::vector<NamedScene> results;
    bool all_done = true;
    if (!guarded(step, [&] { cache.before_arms(flow, step.arms); })) return false;
    for (const auto& arm : step.arms) {
        const bool moved = &arm == &step.arms.back() && (step.join || !needed);
        SceneState inside;
        if (!guarded(step, [&] { inside = moved ? std::move(flow) : flow.branched_off(); })) return false;
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
bool Engine::run_arm(const Step& step, const Arm& arm, SceneState& inside) {
    inside.without_cache |= step.join && (!inside.scene.documents.empty() || loads(*arm.steps));
    emit({.kind = Event::Kind::arm, .step = &step});
    const bool done =
        run_steps(*arm.steps, inside, step.join) && (!step.join || fetch(step.where, step.name, inside));
    emit({.kind = Event::Kind::arm_done, .step = &step});
    return done;
}

bool Engine::run_part_arms(const Step& step, SceneState& flow) {
    Scene& scene = flow.scene;
    std::vector<std::string> names;
    std::vector<std::size_t> parts;
    for (std::size_t p = 0; p < scene.parts.size(); ++p)
        if (step.parts.selects(scene.parts[p], scene)) {
            names.push_back(scene.parts[p].name);
            parts.push_back(p);
        }
    if (names.empty()) {
        record().warnings.push_back(
            {Severity::warning, "W-ONLY",
             fmt::format("foreach runs over none of the {} parts", scene.parts.size()), step.where,
             names_hint(scene)});
        failures.warn(record().warnings.back());
    }
    Problems problems;
    const auto arms = step.arms_of_parts(names, problems);
    check_new_files(plan, arms, problems);
    for (const auto& d : problems.all())
        if (d.severity == Severity::error) failures.add(ErrorKind::usage, {d});
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
        if (!guarded(step, [&] { inside.scene.parts.push_back(scene.parts[p]); })) return false;
        all_done = run_arm(step, arm, inside) && all_done;
        if (step.join) results[p].push_back({arm.name, std::move(inside.scene)});
    }
    if (!step.join) return true;
    if (!all_done) return false;
    scene = with_parts_replaced(std::move(scene), std::move(results));
    flow.replaced();
    return true;
}

} // namespace facetmill::pipeline
