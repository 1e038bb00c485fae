#include "geometry/simplify/simplify.hpp"

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/parallel.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/orient/orient.hpp"
#include "geometry/simplify/attributes.hpp"
#include "geometry/simplify/features.hpp"
#include "geometry/simplify/methods.hpp"

namespace facetmill {

namespace {

using namespace simplification;
using Stop = SimplifyResult::Stop;
using Method = SimplifySettings::Method;
using Intersections = SimplifySettings::Intersections;

constexpr int max_rounds = 16;    // of limiting what runs into itself; three or four are usual
constexpr int gentle_rounds = 10; // before all collapses are held back there

// What is refused before any work.

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorKind::usage, "E-RANGE", "simplify: " + what);
}

void check_ratio(double ratio) {
    if (!(ratio > 0 && ratio <= 1)) refuse("ratio is 0 < x <= 1, not " + to_string(ratio));
}

void check_weights(const AttributeWeights& w) {
    for (const double weight : {w.uv, w.normal, w.colour, w.skin})
        if (!(weight >= 0 && std::isfinite(weight)))
            refuse("weights are at least 0, not " + to_string(weight));
}

void check_cluster(const SimplifySettings& s) {
    if (s.lock.boundary || s.lock.seams || s.lock.groups || !s.lock.body.empty() || !s.lock.vertices.empty())
        refuse("cluster cannot lock vertices");
    if (s.self_intersections == SimplifySettings::Intersections::avoid)
        refuse("cluster cannot avoid self-intersections");
}

void check(const SimplifySettings& s) {
    if (!s.levels.empty()) refuse("levels are for simplify_levels");
    if (!s.ratio && !s.faces && !s.vertices && !s.max_error)
        refuse("a target is needed: ratio, faces, vertices or max_error");
    if (s.ratio) check_ratio(*s.ratio);
    if (s.max_error && s.method == Method::constrained)
        refuse("constrained has a bound of its own: hausdorff");
    if (s.max_error && !(*s.max_error > 0)) refuse("max_error is above 0, not " + to_string(*s.max_error));
    if (s.topology == SimplifySettings::Topology::allow && s.method == Method::constrained)
        refuse("constrained keeps the topology");
    if (s.method == Method::cluster) check_cluster(s);
    check_weights(s.weights);
}

void check_levels(const SimplifySettings& s) {
    if (s.method == Method::constrained || s.method == Method::cluster)
        refuse("levels are not for constrained and cluster");
    if (s.self_intersections == SimplifySettings::Intersections::avoid)
        refuse("levels cannot avoid self-intersections");
    if (s.levels.empty()) refuse("levels need ratios");
    if (s.ratio || s.faces || s.vertices || s.max_error) refuse("levels are targets of their own");
    for (const double ratio : s.levels) check_ratio(ratio);
    if (!std::is_sorted(s.levels.rbegin(), s.levels.rend())) refuse("levels go from fine to coarse");
    check_weights(s.weights);
}

/// The face count that the ratio asks for: rounded up, so that 10% of 15 faces is 2.
std::size_t share_of(std::size_t faces, double ratio) {
    return static_cast<std::size_t>(std::ceil(static_cast<double>(faces) * ratio - 1e-9));
}

struct Targets {
    Goal goal;
    std::size_t by_ratio = 0, by_faces = 0;

    Targets(std::size_t faces, const SimplifySettings& settings) {
        if (settings.ratio) by_ratio = share_of(faces, *settings.ratio);
        if (settings.faces) by_faces = *settings.faces;
        goal.faces = std::max(by_ratio, by_faces);
        if (settings.vertices) goal.vertices = *settings.vertices;
    }

    /// What stopped the work.
    Stop reason(const Ended& end) const {
        if (end.by_error) return Stop::max_error;
        if (end.outcome.stuck) return Stop::stuck;
        if (end.shape.face_slots() > goal.faces) return Stop::vertices;
        return by_faces >= by_ratio ? Stop::faces : Stop::ratio;
    }
};

/// The locks of a mesh whose unused vertices go, if single ones are locked: numbers stay right then.
SimplifyLocks by_used_vertices(SimplifyLocks lock, Mesh& mesh) {
    if (lock.vertices.empty()) return lock;
    std::vector<std::uint8_t> used(mesh.vertex_count()), locked;
    for (Index c = 0; c < mesh.corner_count(); ++c) used[mesh.vertex(c)] = 1;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) locked.push_back(lock.vertices[v]);
    drop_unused(mesh);
    lock.vertices = std::move(locked);
    return lock;
}

/// Gives a flat-shaded mesh its normals back, and says what became of normals.
void settle_normals(Mesh& mesh, const NormalSeams& seams, AttributeChanges& changes) {
    using Shading = NormalSeams::Shading;
    if (seams.shading == Shading::as_given) return;
    if (seams.shading == Shading::faceted) set_facet_normals(mesh);
    for (AttributeChange& change : changes) {
        if (change.domain != Domain::wedge) continue;
        if (change.attribute == "NORMAL")
            change = {change.attribute, change.domain, AttributeChange::Kind::recomputed,
                      seams.shading == Shading::faceted ? "flat shading: the normals of the new faces"
                                                        : "area-weighted where seams below the feature angle "
                                                          "were merged, interpolated elsewhere"};
        else if (change.attribute == "TANGENT")
            change = {change.attribute, change.domain, AttributeChange::Kind::interpolated,
                      "one of each merged normal seam, mixed at new elements"};
    }
}

/// Turns a triangle round.
void turn_round(Mesh& mesh, std::size_t f) { std::swap(mesh.corners[3 * f + 1], mesh.corners[3 * f + 2]); }

/// A mesh made ready to be simplified, and how results of it are made.
class Subject {
  public:
    Subject(Mesh given, const SimplifySettings& settings)
        : given_(std::move(given)), settings_(settings), lock_(by_used_vertices(settings.lock, given_)),
          seams_(merge_seams()), used_(prepared()) {
        start_.shading = seams_.shading;
        start_.merged_wedges = seams_.merged;
        start_.faces_given = given_.face_count();
        start_.faces_before = start_.faces_after = faces();
        start_.vertices_before = start_.vertices_after = vertices();
        if (settings.method != Method::constrained) start_.largest_error = 0;
    }

    /// What the work is done on: triangles, without the seams that only normals make, and turned round where
    /// neighbours disagree.
    const Mesh& mesh() const { return own_ ? *own_ : given_; }
    std::size_t faces() const { return mesh().face_count(); }
    std::size_t vertices() const { return used_.count; } ///< that faces use
    const CoincidentBorders* borders() const { return borders_ ? &*borders_ : nullptr; }

    /// All that the method needs. rollback: every collapse is logged. limits: see State::limits, of the
    /// vertices of the mesh; null: none.
    State state(bool rollback, const std::vector<float>* limits = nullptr) {
        State s = laid_out();
        if (borders_) s.side_of_wedge = &borders_->sides();
        if (settings_.method == Method::quadric || settings_.method == Method::quadric_endpoints) {
            set_quadrics(s);
            s.attributes = attribute_error(s, mesh(), settings_.weights,
                                           seams_.shading != NormalSeams::Shading::faceted);
        }
        s.rules = {.endpoints = settings_.method == Method::quadric_endpoints,
                   .changes_topology = settings_.topology == SimplifySettings::Topology::allow};
        if (rollback || carries_attributes(mesh())) s.log.emplace().features = feature_corners(s);
        if (limits) {
            s.limits.emplace();
            for (const Index v : s.source) s.limits->push_back((*limits)[v]);
        }
        return s;
    }

    /// The mesh as it came.
    SimplifyResult unchanged() const {
        SimplifyResult r = start_;
        r.mesh = given_;
        r.changes = kept_changes(given_.attributes);
        return r;
    }

    /// The mesh of a shape. done: all that led to it.
    SimplifyResult result(Stop stop, const Shape& shape, const std::optional<Log>& log,
                          const Outcome& done) const {
        SimplifyResult r = start_;
        r.stop = stop;
        r.passes = done.passes;
        r.collapses = done.collapses;
        if (r.largest_error) r.largest_error = std::sqrt(done.largest) / shape.frame.scale;
        Finished finished = finish(shape, mesh(), log ? &*log : nullptr);
        if (borders_) borders_->separate(finished.mesh, finished.wedges, finished.changes);
        r.mesh = std::move(finished.mesh);
        for (std::size_t f = 0; f < r.mesh.face_count() && !turned_.empty(); ++f)
            if (turned_[shape.face_source[f]]) turn_round(r.mesh, f);
        r.changes = std::move(finished.changes);
        r.faces_after = r.mesh.face_count();
        r.vertices_after = r.mesh.vertex_count();
        settle_normals(r.mesh, seams_, r.changes);
        return r;
    }

  private:
    NormalSeams merge_seams() {
        NormalSeams seams;
        if (given_.has_seams() && given_.find("NORMAL", Domain::wedge)) {
            seams = merge_normal_seams(own_.emplace(given_), settings_.feature_angle);
            if (seams.merged == 0) own_.reset();
        }
        return seams;
    }

    const Mesh& prepared() {
        if (!given_.all_triangles()) own_ = triangulated(mesh());
        return mesh();
    }

    /// A state with kinds, where the method has use for them. What is in the way of them is put right the
    /// first time.
    State laid_out() {
        if (settings_.method == Method::cluster)
            return carries_attributes(mesh()) ? classified() : lay_out(mesh(), used_);
        State s = classified();
        if (join_borders(s)) s = classified();
        if (orient_faces(s)) s = classified();
        return s;
    }

    State classified() const {
        // The length of an edge says nothing about the outline, which other methods have in their quadrics.
        // Where the topology may change, holes may close and small components vanish, corners and all.
        const bool corners = settings_.method == Method::shortest_edge &&
                             settings_.topology == SimplifySettings::Topology::keep;
        State s = lay_out(mesh(), used_);
        classify(s, mesh(), lock_, corners ? std::optional(settings_.feature_angle) : std::nullopt);
        return s;
    }

    /// Joins borders that run along each other. Locked ones match anyway.
    bool join_borders(const State& s) {
        if (borders_ || lock_.boundary || settings_.method == Method::constrained) return false;
        const std::vector<Index> target = CoincidentBorders::find(s, mesh());
        if (target.empty()) return false;
        if (!own_) own_.emplace(given_);
        borders_.emplace(*own_, target);
        used_ = UsedVertices(*own_);
        for (Index v = 0; v < lock_.vertices.size(); ++v) lock_.vertices[target[v]] |= lock_.vertices[v];
        return true;
    }

    /// Turns faces round whose neighbours disagree with them: else the edges there count as not manifold.
    bool orient_faces(const State& s) {
        const bool pinned = std::find(s.kind.begin(), s.kind.end(), Kind::pinned) != s.kind.end();
        if (!pinned || !turned_.empty()) return false;
        std::vector<std::uint8_t> turned = consistent_flips(mesh());
        start_.turned = static_cast<std::size_t>(std::count(turned.begin(), turned.end(), 1));
        if (start_.turned == 0) return false;
        if (!own_) own_.emplace(given_);
        for (std::size_t f = 0; f < turned.size(); ++f)
            if (turned[f]) turn_round(*own_, f);
        turned_ = std::move(turned);
        return true;
    }

    Mesh given_;
    const SimplifySettings& settings_;
    SimplifyLocks lock_;
    std::optional<Mesh> own_; ///< none: the mesh as given will do
    NormalSeams seams_;
    UsedVertices used_;
    std::optional<CoincidentBorders> borders_;
    std::vector<std::uint8_t>
        turned_;           ///< [faces] 1 for those that the work is done on turned round; empty: none
    SimplifyResult start_; ///< what all results have in common
};

/// As run_passes, with the vertices counted as they will be once coincident borders are separate again.
Outcome run_passes_separate(State& s, const CoincidentBorders* borders, Goal goal) {
    const std::size_t wanted = goal.vertices;
    Outcome all = run_passes(s, goal);
    while (borders && !all.stuck && goal.vertices > 1 && s.live_faces > goal.faces) {
        const std::size_t more = borders->doubled(s);
        if (s.live_vertices + more <= wanted) break;
        goal.vertices = std::min(goal.vertices - 1, more < wanted ? wanted - more : 1);
        all += run_passes(s, goal);
    }
    return all;
}

Ended run_to(State s, const CoincidentBorders* borders, const Goal& goal) {
    Ended end;
    end.outcome = run_passes_separate(s, borders, goal);
    if (end.outcome.stuck) end.blocked = count_blocked(s);
    compact(s);
    end.log = std::move(s.log);
    end.shape = std::move(s);
    return end;
}

Ended run(State s, const Subject& subject, Goal goal, const SimplifySettings& settings) {
    if (settings.method == Method::cluster)
        return run_cluster(std::move(s), subject.mesh(), goal, settings.max_error, settings.samples);
    if (settings.method == Method::constrained)
        return run_constrained(std::move(s), subject.mesh().vertex_count(), goal, settings.constraints);
    if (!settings.max_error) return run_to(std::move(s), subject.borders(), goal);
    if (goal.vertices > 0 && subject.borders()) // as if no border got shorter
        goal.vertices -= std::min(goal.vertices - 1, subject.borders()->doubled(s));
    return run_within(std::move(s), subject.mesh(), goal, *settings.max_error, settings.samples);
}

SimplifyResult result_of(const Subject& subject, const Targets& targets, const Ended& end) {
    SimplifyResult r = subject.result(targets.reason(end), end.shape, end.log, end.outcome);
    if (r.stop == Stop::max_error || r.stop == Stop::stuck) r.blocked = end.blocked;
    r.measured = end.measured;
    r.rolled_back = end.rolled_back;
    r.measurements = end.measurements;
    r.cell = end.cell;
    return r;
}

/// With the self-intersections counted, and avoided on request.
SimplifyResult simplify_crossing(Subject& subject, const Targets& targets, const SimplifySettings& settings) {
    const std::size_t before = find_self_intersections(subject.mesh(), {.limit = 0}).count;
    std::vector<float> limits(subject.mesh().vertex_count(), never);
    std::size_t passes = 0;
    for (int round = 1;; ++round) {
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
    check(settings);
    Subject subject(std::move(given), settings);
    const Targets targets(subject.faces(), settings);
    if (targets.goal.met(subject.faces(), subject.vertices())) return subject.unchanged();
    if (settings.self_intersections != Intersections::ignore)
        return simplify_crossing(subject, targets, settings);
    const bool rollback = settings.max_error || settings.method == Method::constrained;
    return result_of(subject, targets, run(subject.state(rollback), subject, targets.goal, settings));
}

std::vector<SimplifyResult> simplify_levels(Mesh given, const SimplifySettings& settings) {
    check_levels(settings);
    Subject subject(std::move(given), settings);
    std::optional<State> s;
    Outcome done;
    std::vector<SimplifyResult> levels;
    for (const double ratio : settings.levels) {
        const std::size_t faces = share_of(subject.faces(), ratio);
        if ((s ? s->live_faces : subject.faces()) <= faces) {
            levels.push_back(levels.empty() ? subject.unchanged() : levels.back());
            continue;
        }
        if (!s) s = subject.state(false);
        done += run_passes(*s, {.faces = faces});
        const auto blocked = done.stuck ? count_blocked(*s) : SimplifyResult::Blocked{};
        compact(*s);
        levels.push_back(subject.result(done.stuck ? Stop::stuck : Stop::ratio, *s, s->log, done));
        levels.back().blocked = blocked;
    }
    return levels;
}

} // namespace facetmill
