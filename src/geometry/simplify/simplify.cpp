#include "geometry/simplify/simplify.hpp"

#include "base/progress.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/simplify/input.hpp"
#include "geometry/simplify/targets.hpp"

namespace facetmill {

namespace {

using namespace simplification;
using Stop = SimplifyResult::Stop;
using Method = SimplifySettings::Method;
using Intersections = SimplifySettings::Intersections;

constexpr int max_rounds = 16;    // rounds of limiting intersecting faces; three or four are usual
constexpr int gentle_rounds = 10; // rounds before all collapses at intersecting faces are blocked

Ended run_to(State s, const CoincidentBorders* borders, const Goal& goal) {
    Ended end;
    Member alone{&s};
    run_passes_separate(std::span(&alone, 1), std::span(&borders, 1), goal);
    end.outcome = alone.done;
    if (end.outcome.stuck) end.blocked = count_blocked(s);
    compact(s);
    end.log = std::move(s.log);
    end.shape = std::move(s);
    return end;
}

Ended run(State s, const SimplifyInput& subject, Goal goal, const SimplifySettings& settings) {
    if (settings.method == Method::cluster)
        return run_cluster(std::move(s), subject.mesh(), goal, settings.max_error, settings.samples);
    if (settings.method == Method::constrained)
        return run_constrained(std::move(s), subject.mesh().vertex_count(), goal, settings.constraints);
    if (!settings.max_error) return run_to(std::move(s), subject.borders(), goal);
    if (goal.vertices > 0 && subject.borders()) // assumes that no border got shorter
        goal.vertices -= std::min(goal.vertices - 1, subject.borders()->doubled(s));
    return run_within(std::move(s), subject.mesh(), goal, *settings.max_error, settings.samples);
}

SimplifyResult result_of(const SimplifyInput& subject, const Targets& targets, const Ended& end) {
    const Stop stop = targets.reason(end);
    SimplifyResult r = stop == Stop::max_quadric_error && end.outcome.collapses == 0
                           ? subject.unchanged(stop)
                           : subject.result(stop, end.shape, end.log, end.outcome);
    if (r.stop == Stop::max_error || r.stop == Stop::max_quadric_error || r.stop == Stop::stuck)
        r.blocked = end.blocked;
    r.measured = end.measured;
    r.rolled_back = end.rolled_back;
    r.measurements = end.measurements;
    r.cell = end.cell;
    return r;
}

/// Simplifies, counts the self-intersections, and avoids them on request.
SimplifyResult simplify_crossing(SimplifyInput& subject, const Targets& targets,
                                 const SimplifySettings& settings) {
    const std::size_t before = find_self_intersections(subject.mesh(), {.limit = 0}).count;
    std::vector<float> limits(subject.mesh().vertex_count(), never);
    std::size_t passes = 0;
    ProgressRounds rounds;
    for (int round = 1;; ++round, rounds.next()) {
        const Ended end =
            run(subject.state(true, round == 1 ? nullptr : &limits), subject, targets.goal, settings);
        SimplifyResult r = result_of(subject, targets, end);
        passes += r.passes;
        r.passes = passes;
        r.held = static_cast<std::size_t>(
            std::count_if(limits.begin(), limits.end(), [](float limit) { return limit < never; }));
        const std::size_t after =
            limit_intersecting(end.shape, *end.log, r.mesh, before, round > gentle_rounds, limits);
        r.intersections_before = before;
        r.intersections_after = after;
        const bool avoid = settings.self_intersections == Intersections::avoid;
        if (!avoid || after <= before || round == max_rounds) return r;
    }
}

} // namespace

SimplifyResult simplify(Mesh given, const SimplifySettings& settings) {
    throw_first(check_simplify_settings(settings));
    ProgressSteps steps({1, 3, 6, 2});
    SimplifyInput subject(std::move(given), settings);
    const Targets targets(subject.faces(), settings);
    steps.next();
    if (targets.goal.met(subject.faces(), subject.vertices())) return subject.unchanged();
    if (settings.self_intersections != Intersections::ignore)
        return simplify_crossing(subject, targets, settings);
    const bool rollback = settings.max_error || settings.method == Method::constrained;
    State state = subject.state(rollback);
    steps.next();
    const Ended end = run(std::move(state), subject, targets.goal, settings);
    steps.next();
    return result_of(subject, targets, end);
}

std::vector<SimplifyResult> simplify_levels(Mesh given, const SimplifySettings& settings) {
    throw_first(check_simplify_levels(settings));
    SimplifyInput subject(std::move(given), settings);
    std::optional<State> s;
    Member member{};
    std::vector<SimplifyResult> levels;
    std::vector<double> lengths(settings.levels.size(), 1);
    if (!lengths.empty()) lengths.front() = 3; // most collapses happen before the first level
    ProgressSteps steps(std::move(lengths));
    const auto next = [&](SimplifyResult r) {
        levels.push_back(std::move(r));
        steps.next();
    };
    for (const double ratio : settings.levels) {
        const std::size_t faces = share_of(subject.faces(), ratio);
        if ((s ? s->rings.live_faces : subject.faces()) <= faces) {
            next(levels.empty() ? subject.unchanged() : levels.back());
            continue;
        }
        if (!s) s = subject.state(false);
        member.state = &*s;
        run_passes(std::span(&member, 1), {.faces = faces});
        const Outcome& done = member.done;
        const auto blocked = done.stuck ? count_blocked(*s) : SimplifyResult::Blocked{};
        compact(*s);
        SimplifyResult r = subject.result(done.stuck ? stuck_by(blocked) : Stop::ratio, *s, s->log, done);
        r.blocked = blocked;
        next(std::move(r));
    }
    return levels;
}

} // namespace facetmill
