#include "geometry/simplify/simplify.hpp"

#include "base/parallel.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/simplify/prepared.hpp"
#include "geometry/simplify/coincident.hpp"

namespace facetmill {

namespace {

using namespace simplification;
using Stop = SimplifyResult::Stop;
using Method = SimplifySettings::Method;

/// The face count that the ratio asks for: rounded up, so that 10% of 15 faces is 2.
std::size_t share_of(std::size_t faces, double ratio) {
    return static_cast<std::size_t>(std::ceil(static_cast<double>(faces) * ratio - 1e-9));
}

struct Targets {
    Goal goal;
    std::size_t by_ratio = 0, by_faces = 0;

    Targets(const Work& s, const SimplifySettings& settings) {
        if (settings.ratio) by_ratio = share_of(s.live_faces, *settings.ratio);
        if (settings.faces) by_faces = *settings.faces;
        goal.faces = std::max(by_ratio, by_faces);
        if (settings.vertices) goal.vertices = *settings.vertices;
    }

    bool met(const Work& s) const { return s.live_faces <= goal.faces || s.live_vertices <= goal.vertices; }
    /// Which target stopped it.
    Stop reason(const Work& s) const {
        if (s.live_faces > goal.faces) return Stop::vertices;
        return by_faces >= by_ratio ? Stop::faces : Stop::ratio;
    }
};

/// Whether anything but positions and faces must be followed.
bool carries_attributes(const Mesh& mesh) {
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(),
                       [](const auto& a) { return a.domain != Domain::face; });
}

Fates all_kept(const Mesh& mesh) {
    Fates fates;
    for (const auto& a : mesh.attributes) fates.push_back({a.name, a.domain, Fate::Kind::kept, ""});
    return fates;
}

/// The features as they are before the first collapse, by the corners of the mesh.
void remember_features(Work& s) {
    if (!s.has_features || !s.logging) return;
    s.features_given.resize(s.flags.size());
    parallel_for(s.flags.size(), [&](std::size_t c) {
        s.features_given[3 * s.face_source[c / 3] + c % 3] = s.flags[c] & feature_edge;
    });
}

/// A mesh at work.
class Session {
  public:
    Session(Mesh given, const SimplifySettings& settings)
        : given_(std::move(given)), settings_(settings), lock_(by_used_vertices(settings.lock, given_)),
          prepared_(given_, settings), work(build_work(mesh())) {
        so_far_.shading = prepared_.seams.shading, so_far_.merged_wedges = prepared_.seams.merged;
        so_far_.faces_given = given_.face_count();
        so_far_.faces_before = so_far_.faces_after = work.live_faces;
        so_far_.vertices_before = so_far_.vertices_after = work.live_vertices;
        if (settings.method != Method::constrained) so_far_.largest_error = 0;
    }

    const Mesh& mesh() const { return prepared_.own ? *prepared_.own : given_; }

    /// What the collapses need besides the lists. way_back: all of them are logged. limits: see Work::limit,
    /// of the vertices of the mesh.
    void begin(bool way_back, const std::vector<float>& limits = {}) {
        const bool carries = carries_attributes(mesh());
        if (settings_.method != Method::cluster || carries) {
            classify(work, mesh(), lock_);
            join_touching();
            work.sides = touching.any() ? &touching.sides() : nullptr;
        }
        if (settings_.method == Method::quadric || settings_.method == Method::quadric_endpoints) {
            sum_quadrics(work);
            sum_fields(work, mesh(), settings_.weights,
                       prepared_.seams.shading != NormalSeams::Shading::faceted);
        }
        work.endpoints = settings_.method == Method::quadric_endpoints;
        work.allow = settings_.topology == SimplifySettings::Topology::allow;
        work.logging = way_back || carries;
        if (!limits.empty())
            for (const Index v : work.source) work.limit.push_back(limits[v]);
        remember_features(work);
    }
    /// Forgets all collapses.
    void start_again() {
        work = build_work(mesh());
        so_far_.collapses = 0, largest_ = 0;
    }

    /// The mesh as it came.
    SimplifyResult unchanged() const {
        SimplifyResult r = so_far_;
        r.mesh = given_;
        r.fates = all_kept(given_);
        return r;
    }

    /// The mesh as it is now. The work can go on.
    SimplifyResult result(Stop stop, const Outcome& done) {
        SimplifyResult r = so_far_;
        r.stop = stop, r.held = held;
        so_far_.passes = r.passes += done.passes;
        so_far_.collapses = r.collapses += done.collapses;
        largest_ = std::max(largest_, done.largest);
        if (r.largest_error) r.largest_error = std::sqrt(largest_) / work.scale;
        r.faces_after = work.live_faces, r.vertices_after = work.live_vertices;
        std::vector<Index> wedges;
        r.mesh = finished(work, mesh(), r.fates, wedges);
        if (touching.any()) {
            touching.part(r.mesh, wedges, r.fates);
            r.vertices_after = r.mesh.vertex_count();
        }
        settle_normals(r.mesh, prepared_.seams, r.fates);
        return r;
    }

  private:
    /// Borders that touch are worked on as seams; locked ones match anyway, and cells keep no borders.
    void join_touching() {
        if (lock_.boundary || settings_.method == Method::constrained || settings_.method == Method::cluster)
            return;
        const std::vector<Index> target = touching_vertices(work, mesh());
        if (target.empty()) return;
        if (!prepared_.own) prepared_.own.emplace(given_);
        touching.join(*prepared_.own, target);
        for (Index v = 0; v < lock_.vertices.size(); ++v) lock_.vertices[target[v]] |= lock_.vertices[v];
        work = build_work(mesh());
        classify(work, mesh(), lock_);
    }

    Mesh given_;
    const SimplifySettings& settings_;
    SimplifyLocks lock_;
    Prepared prepared_;
    SimplifyResult so_far_;
    double largest_ = 0;

  public:
    Work work;
    Touching touching;
    std::size_t held = 0; ///< vertices
};

/// As run_passes, with the vertices counted as they will be once borders that touch are apart again.
Outcome run_passes_apart(Session& session, Goal goal) {
    const std::size_t wanted = goal.vertices;
    Outcome all = run_passes(session.work, goal);
    while (session.touching.any() && !all.stuck && goal.vertices > 1 &&
           session.work.live_faces > goal.faces) {
        const std::size_t more = session.touching.doubled(session.work);
        if (session.work.live_vertices + more <= wanted) break;
        goal.vertices = std::min(goal.vertices - 1, more < wanted ? wanted - more : 1);
        const Outcome next = run_passes(session.work, goal);
        all.passes += next.passes, all.collapses += next.collapses;
        all.largest = std::max(all.largest, next.largest), all.stuck = next.stuck;
    }
    return all;
}

SimplifyResult within(Session& session, const Targets& targets, double max_error) {
    Goal goal = targets.goal;
    if (goal.vertices > 0 && session.touching.any()) // as if no border got shorter
        goal.vertices -= std::min(goal.vertices - 1, session.touching.doubled(session.work));
    Bounded done = run_within(session.work, session.mesh(), goal, max_error);
    const Stop stop = done.by_error        ? Stop::max_error
                      : done.outcome.stuck ? Stop::stuck
                                           : targets.reason(session.work);
    SimplifyResult r = session.result(stop, done.outcome);
    if (stop == Stop::max_error || stop == Stop::stuck) r.blocked = done.blocked;
    r.measured = done.measured;
    r.rolled_back = done.rolled_back, r.measurements = done.measurements;
    return r;
}

SimplifyResult clustered(Session& session, const Targets& targets, std::optional<double> max_error) {
    const Clustered done = run_cluster(session.work, session.mesh(), targets.goal, max_error);
    SimplifyResult r = session.result(done.by_error        ? Stop::max_error
                                      : done.outcome.stuck ? Stop::stuck
                                                           : targets.reason(session.work),
                                      done.outcome);
    r.cell = done.cell;
    if (max_error) r.measured = done.measured, r.measurements = done.measurements;
    return r;
}

SimplifyResult towards(Session& session, const Targets& targets, const SimplifySettings& settings) {
    if (settings.method == Method::cluster) return clustered(session, targets, settings.max_error);
    if (settings.max_error) return within(session, targets, *settings.max_error);
    const bool constrained = settings.method == Method::constrained;
    const Outcome done = constrained ? run_constrained(session.work, session.mesh().vertex_count(),
                                                       targets.goal, settings.constraints)
                                     : run_passes_apart(session, targets.goal);
    const auto blocked = done.stuck ? count_blocked(session.work) : SimplifyResult::Blocked{};
    SimplifyResult r = session.result(done.stuck ? Stop::stuck : targets.reason(session.work), done);
    r.blocked = blocked;
    return r;
}

constexpr int most_rounds = 16;   // of limiting what runs into itself; three or four are usual
constexpr int gentle_rounds = 10; // before all collapses are held back there

/// As towards, but with the self-intersections counted, and avoided on request. before: how many there were.
SimplifyResult towards_without_crossing(Session& session, const Targets& targets,
                                        const SimplifySettings& settings, std::size_t before) {
    std::vector<float> limits(session.mesh().vertex_count(), never);
    const bool avoid = settings.self_intersections == SimplifySettings::Intersections::avoid;
    for (int round = 1;; ++round) {
        SimplifyResult r = towards(session, targets, settings);
        const std::size_t after =
            limit_intersecting(session.work, r.mesh, before, round > gentle_rounds, limits);
        r.intersections_before = before, r.intersections_after = after;
        if (!avoid || after <= before || round == most_rounds) return r;
        session.start_again();
        session.begin(true, limits);
        session.held = static_cast<std::size_t>(
            std::count_if(limits.begin(), limits.end(), [](float limit) { return limit < never; }));
    }
}

} // namespace

SimplifyResult simplify(Mesh given, const SimplifySettings& settings) {
    check(settings);
    Session session(std::move(given), settings);
    const Targets targets(session.work, settings);
    if (targets.met(session.work)) return session.unchanged();
    const bool crossing = settings.self_intersections != SimplifySettings::Intersections::ignore;
    const std::size_t before = crossing ? find_self_intersections(session.mesh(), {.limit = 0}).count : 0;
    session.begin(settings.max_error || crossing || settings.method == Method::constrained);
    return crossing ? towards_without_crossing(session, targets, settings, before)
                    : towards(session, targets, settings);
}

std::vector<SimplifyResult> simplify_levels(Mesh given, const SimplifySettings& settings) {
    check_levels(settings);
    Session session(std::move(given), settings);
    const std::size_t before = session.work.live_faces;
    std::vector<SimplifyResult> levels;
    for (const double ratio : settings.levels) {
        const std::size_t faces = share_of(before, ratio);
        if (session.work.live_faces <= faces) {
            levels.push_back(levels.empty() ? session.unchanged() : levels.back());
            continue;
        }
        if (session.work.kind.empty()) session.begin(false);
        const Outcome done = run_passes(session.work, {.faces = faces});
        const auto blocked = done.stuck ? count_blocked(session.work) : SimplifyResult::Blocked{};
        levels.push_back(session.result(done.stuck ? Stop::stuck : Stop::ratio, done));
        levels.back().blocked = blocked;
    }
    return levels;
}

} // namespace facetmill
