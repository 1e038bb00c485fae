#include "geometry/simplify/targets.hpp"

#include "base/math/numbers.hpp"

namespace facetmill {

namespace {

using Method = SimplifySettings::Method;
using Topology = SimplifySettings::Topology;
using Intersections = SimplifySettings::Intersections;

/// Collects the refusals.
struct Refusals {
    std::vector<Refusal> all{};

    void conflict(bool when, const char* option, const char* message, const char* hint) {
        if (when) all.push_back({option, message, hint});
    }
    void range(bool when, const char* option, const std::string& message, const char* hint = "") {
        if (when) all.push_back({option, message, hint, "E-RANGE"});
    }
};

bool is_ratio(double ratio) { return ratio > 0 && ratio <= 1; }

bool has_target(const SimplifySettings& s) { return s.ratio || s.faces || s.vertices || s.max_error; }

bool locks(const SimplifyLocks& l) {
    return l.boundary || l.seams || l.groups || !l.body.empty() || !l.vertices.empty();
}

/// Adds the settings that exclude the method, for targets and for levels.
void refuse_by_method(const SimplifySettings& s, Refusals& refused) {
    const bool constrained = s.method == Method::constrained, cluster = s.method == Method::cluster;
    refused.conflict(constrained && s.max_error, "max_error", "the method constrained has no max_error",
                     "use constraints: {hausdorff: 0.1%} to limit the error");
    refused.conflict(constrained && s.topology == Topology::allow, "topology",
                     "the method constrained always keeps the topology", "use the method quadric");
    refused.conflict(cluster && locks(s.lock), "lock", "cluster cannot lock vertices",
                     "use the method quadric");
    refused.conflict(cluster && s.self_intersections == Intersections::avoid, "self_intersections",
                     "cluster cannot avoid self-intersections", "count them, or use the method quadric");
}

void refuse_by_levels(const SimplifySettings& s, Refusals& refused) {
    refused.conflict(s.method == Method::constrained, "lods", "the method constrained has no lods",
                     "use another method, or one simplify stage for each level");
    refused.conflict(has_target(s), "lods", "lods has its own targets",
                     "leave out ratio, faces, vertices and max_error");
    refused.conflict(s.self_intersections == Intersections::avoid, "lods",
                     "lods cannot be combined with self_intersections: avoid",
                     "use self_intersections: count, or one simplify stage for each level");
    refused.conflict(s.method == Method::cluster, "lods",
                     "lods needs a chain of collapses, which the method cluster does not have",
                     "use another method, or one simplify stage for each level");
}

void refuse_limits(const SimplifySettings& s, Refusals& refused) {
    if (s.max_quadric_error)
        refused.range(!(*s.max_quadric_error > 0), "max_quadric_error",
                      "max_quadric_error must be above 0, not " + to_string(*s.max_quadric_error));
    for (const double weight : {s.weights.uv, s.weights.normal, s.weights.colour, s.weights.skin})
        refused.range(!(weight >= 0 && std::isfinite(weight)), "weights",
                      "weights must be at least 0, not " + to_string(weight));
}

} // namespace

std::vector<Refusal> check_simplify_settings(const SimplifySettings& s) {
    Refusals refused;
    refuse_by_method(s, refused);
    refused.conflict(!s.levels.empty(), "lods", "levels are for simplify_levels", "");
    refused.range(!has_target(s), "ratio", "a target is needed: ratio, faces, vertices or max_error");
    if (s.ratio)
        refused.range(!is_ratio(*s.ratio), "ratio", "ratio is 0 < x <= 1, not " + to_string(*s.ratio));
    if (s.max_error)
        refused.range(!(*s.max_error > 0), "max_error",
                      "max_error is above 0, not " + to_string(*s.max_error));
    refuse_limits(s, refused);
    return refused.all;
}

std::vector<Refusal> check_simplify_levels(const SimplifySettings& s) {
    Refusals refused;
    refuse_by_method(s, refused);
    refuse_by_levels(s, refused);
    refused.range(s.levels.empty(), "lods", "lods needs at least one ratio", "for example [100%, 50%, 10%]");
    for (std::size_t i = 0; i < s.levels.size(); ++i) {
        refused.range(!is_ratio(s.levels[i]), "lods", "lods: each ratio must be 0 < x <= 1",
                      "for example 50%");
        refused.range(i > 0 && s.levels[i] > s.levels[i - 1], "lods",
                      "lods: ratios must go from fine to coarse", "for example [100%, 50%, 10%]");
    }
    refuse_limits(s, refused);
    return refused.all;
}

std::optional<Refusal> check_simplify_sharing(const SimplifySettings& s) {
    if (s.method == Method::cluster || s.method == Method::constrained)
        return Refusal{
            "share",
            "the costs of cluster and constrained are not comparable, so parts cannot share a target",
            "use share: equal, or the method quadric"};
    const char* const hint = "use simplify_shares to find the number of triangles of each mesh";
    if (s.max_error) return Refusal{"max_error", "meshes that share a target take no max_error", hint};
    if (s.self_intersections != Intersections::ignore)
        return Refusal{"self_intersections", "meshes that share a target take no self_intersections", hint};
    return {};
}

} // namespace facetmill

namespace facetmill::simplification {

namespace {

using Stop = SimplifyResult::Stop;

} // namespace

void throw_first(const std::vector<Refusal>& refusals) {
    if (!refusals.empty()) throw_refusal("simplify", refusals.front());
}

std::size_t share_of(std::size_t faces, double ratio) {
    return static_cast<std::size_t>(std::ceil(static_cast<double>(faces) * ratio - 1e-9));
}

Targets::Targets(std::size_t faces, const SimplifySettings& settings)
    : Targets(settings.ratio ? share_of(faces, *settings.ratio) : 0, settings.faces.value_or(0),
              settings.vertices.value_or(0)) {}

Targets::Targets(std::size_t ratio, std::size_t faces, std::size_t vertices)
    : goal{std::max(ratio, faces), vertices}, by_ratio(ratio), by_faces(faces) {}

Stop Targets::met(std::size_t faces) const {
    if (faces > goal.faces) return Stop::vertices;
    return by_faces >= by_ratio ? Stop::faces : Stop::ratio;
}

Stop Targets::reason(const Ended& end) const {
    if (end.by_error) return Stop::max_error;
    return end.outcome.stuck ? stuck_by(end.blocked) : met(end.shape.face_slots());
}

Stop stuck_by(const SimplifyResult::Blocked& b) {
    const std::size_t most = std::max({b.borders, b.seams, b.non_manifold});
    return b.error > 0 && b.error >= most ? Stop::max_quadric_error : Stop::stuck;
}

void run_passes_separate(std::span<Member> members, std::span<const CoincidentBorders* const> borders,
                         Goal goal) {
    const std::size_t wanted = goal.vertices;
    const auto totals = [&] {
        struct {
            std::size_t faces = 0, vertices = 0, doubled = 0;
        } all;
        for (std::size_t m = 0; m < members.size(); ++m) {
            const State& s = *members[m].state;
            all.faces += members[m].uses * s.rings.live_faces;
            all.vertices += members[m].uses * s.rings.live_vertices;
            if (borders[m]) all.doubled += members[m].uses * borders[m]->doubled(s);
        }
        return all;
    };
    run_passes(members, goal);
    if (std::all_of(borders.begin(), borders.end(), [](const auto* b) { return !b; })) return;
    for (auto now = totals(); !members.front().done.stuck && goal.vertices > 1 && now.faces > goal.faces;
         now = totals()) {
        if (now.vertices + now.doubled <= wanted) break;
        goal.vertices = std::min(goal.vertices - 1, now.doubled < wanted ? wanted - now.doubled : 1);
        run_passes(members, goal);
    }
}

} // namespace facetmill::simplification
