#include "geometry/relax/relax.hpp"

#include "base/error.hpp"
#include "base/math/numbers.hpp"
#include "base/progress.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/relax/steps.hpp"
#include "mesh/face.hpp"
#include "parallel/parallel.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Settings = RelaxSettings;
using Method = Settings::Method;

/// The requirement for a setting, and its value.
struct Need {
    bool holds;
    const char* name;
    const char* range;
    double found;
};

Need need_of_lambda(const Settings& s) {
    const double f = relax_lambda(s);
    if (s.method == Method::implicit) return {f > 0 && f <= 1e6, "lambda", "0 < x <= 1e+06 for implicit", f};
    if (s.method == Method::taubin) // otherwise the outward step would amplify frequencies that the inward
                                    // step has inverted
        return {f > 0 && f < 0.7, "lambda", "0 < x < 0.7 for taubin", f};
    return {f > 0 && f <= 1, "lambda", "0 < x <= 1", f};
}

// The smallest area relative to the first iteration. Below this, the surface only shrinks and no longer
// becomes smoother.
constexpr double least_area_left = 2.0 / 3;

/// Twice the area of the mesh with its vertices at `places`, in world units.
double twice_area(const Mesh& mesh, const std::vector<Vec3>& places, const Transform& to_world) {
    return parallel_reduce(
        mesh.face_count(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                const Vec3& first = places[mesh.vertex(mesh.face_begin(f))];
                sum += length(area_vector_at(
                    mesh, f, [&](Index c) { return to_world.vector(places[mesh.vertex(c)] - first); }));
            }
            return sum;
        },
        [](double a, double b) { return a + b; });
}

/// The positions after at most this many iterations.
struct Run {
    std::vector<Vec3> places;
    std::int64_t iterations = 0;
    bool settled = false, shrank = false;
    double last_move = 0;
};

Run run(const Mesh& mesh, const Neighbourhoods& near, const Settings& settings,
        const std::vector<Vec3>& start, std::int64_t iterations, double until) {
    if (iterations == 0) return {start};
    Run run;
    const RelaxStep step = relax_step(mesh, near, settings, start);
    run.places.resize(start.size());
    std::vector<Vec3> last(iterations > 1 ? start.size() : 0);
    double first_area = 0;
    while (run.iterations < iterations && !run.settled && !run.shrank) {
        if (run.iterations > 0) run.places.swap(last);
        const std::vector<Vec3>& from = run.iterations > 0 ? last : start;
        step(from, run.places);
        ++run.iterations;
        ProgressScope::report(static_cast<double>(run.iterations) / static_cast<double>(iterations));
        if (until <= 0) continue;
        run.last_move = move_size(from, run.places, settings.to_world).largest;
        const double area = twice_area(mesh, run.places, settings.to_world);
        if (run.iterations == 1) first_area = area;
        run.shrank = area < first_area * least_area_left;
        run.settled = run.last_move <= until && !run.shrank;
    }
    if (run.shrank) { // the iteration before the last
        run.places.swap(last);
        --run.iterations;
    }
    return run;
}

bool is_position_target(const Attribute& a) {
    return a.role == Role::morph_vector && a.components == 3 && a.domain != Domain::face &&
           a.name.ends_with("_POSITION");
}

/// The positions of the vertices in the morph target; empty if wedges of a vertex disagree.
std::vector<Vec3> target_places(const Mesh& mesh, const Attribute& a) {
    std::vector<Vec3> places = mesh.positions;
    std::vector<std::uint8_t> seen(mesh.vertex_count());
    const auto at = [&](std::size_t i) { return Vec3{a.value(i, 0), a.value(i, 1), a.value(i, 2)}; };
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Index v =
            a.domain == Domain::vertex ? static_cast<Index>(i) : mesh.vertex_of_wedge(static_cast<Index>(i));
        const Vec3 place = mesh.positions[v] + at(i);
        if (seen[v] && !(places[v] == place)) return {};
        places[v] = place;
        seen[v] = 1;
    }
    return places;
}

void set_target(const Mesh& mesh, Attribute& a, const std::vector<Vec3>& target,
                const std::vector<Vec3>& base) {
    parallel_for(a.size(), [&](std::size_t i) {
        const Index v =
            a.domain == Domain::vertex ? static_cast<Index>(i) : mesh.vertex_of_wedge(static_cast<Index>(i));
        const Vec3 d = target[v] - base[v];
        for (int c = 0; c < 3; ++c) a.set_value(i, c, d[static_cast<std::size_t>(c)]);
    });
}

/// Relaxes the morph targets of positions with as many iterations as the surface, and reports the changes of
/// all targets.
AttributeChanges relax_targets(Mesh& mesh, const Neighbourhoods& near, const Settings& settings,
                               const Run& base) {
    AttributeChanges changes;
    for (auto& a : mesh.attributes) {
        if (a.role != Role::morph_vector) continue;
        AttributeChange change{a.name, a.domain, AttributeChange::Kind::kept, "not relaxed"};
        const auto start = is_position_target(a) ? target_places(mesh, a) : std::vector<Vec3>{};
        if (is_position_target(a) && start.empty() && mesh.vertex_count() > 0)
            change.why = "not relaxed: the wedges of a vertex differ";
        if (!start.empty()) {
            const Run target = run(mesh, near, settings, start, base.iterations, 0);
            set_target(mesh, a, target.places, base.places);
            change = {a.name, a.domain, AttributeChange::Kind::recomputed, "relaxed with the surface"};
        }
        changes.push_back(change);
    }
    return changes;
}

} // namespace

std::optional<Refusal> check_relax_settings(const Settings& s) {
    const Need needs[] = {{s.iterations >= 0, "iterations", "at least 0", static_cast<double>(s.iterations)},
                          need_of_lambda(s),
                          {s.pass_band > 0 && s.pass_band < 1, "pass_band", "0 < x < 1", s.pass_band},
                          {s.alpha >= 0 && s.alpha <= 1, "alpha", "0 <= x <= 1", s.alpha},
                          {s.beta >= 0 && s.beta <= 1, "beta", "0 <= x <= 1", s.beta},
                          {s.until >= 0, "until", "at least 0", s.until}};
    for (const Need& need : needs)
        if (!need.holds)
            return Refusal{need.name,
                           fmt::format("{} is {}, not {}", need.name, need.range, to_string(need.found)),
                           {},
                           "E-RANGE"};
    return {};
}

RelaxResult relax(Mesh mesh, const Settings& settings) {
    throw_refusal("relax", check_relax_settings(settings));
    ProgressSteps steps({2, 2 + static_cast<double>(settings.iterations), 2});
    RelaxResult result;
    const Neighbourhoods near = neighbourhoods(mesh, settings);
    result.held = near.held;
    steps.next();
    Run done = run(mesh, near, settings, mesh.positions, settings.iterations, settings.until);
    steps.next();
    const MoveSize moves = move_size(mesh.positions, done.places, settings.to_world);
    result.iterations = done.iterations;
    result.settled = done.settled;
    result.shrank = done.shrank;
    result.last_move = done.last_move;
    result.largest_move = moves.largest;
    result.moved = moves.count;
    const AttributeChanges targets = relax_targets(mesh, near, settings, done);
    mesh.positions = std::move(done.places);
    result.changes = settle_moved(mesh);
    for (auto& change : result.changes)
        for (const auto& target : targets)
            if (target.attribute == change.attribute && target.domain == change.domain) change = target;
    result.mesh = std::move(mesh);
    return result;
}

} // namespace facetmill
