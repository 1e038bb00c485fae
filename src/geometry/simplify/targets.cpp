#include "geometry/simplify/targets.hpp"

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace facetmill::simplification {

namespace {

using Stop = SimplifyResult::Stop;
using Method = SimplifySettings::Method;

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

void check_max_quadric_error(const SimplifySettings& s) {
    if (s.max_quadric_error && !(*s.max_quadric_error > 0))
        refuse("max_quadric_error is above 0, not " + to_string(*s.max_quadric_error));
}

void check_cluster(const SimplifySettings& s) {
    if (s.lock.boundary || s.lock.seams || s.lock.groups || !s.lock.body.empty() || !s.lock.vertices.empty())
        refuse("cluster cannot lock vertices");
    if (s.self_intersections == SimplifySettings::Intersections::avoid)
        refuse("cluster cannot avoid self-intersections");
}

} // namespace

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
    check_max_quadric_error(s);
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
    check_max_quadric_error(s);
    check_weights(s.weights);
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
