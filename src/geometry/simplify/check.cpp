// What is refused before any work.

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "geometry/simplify/work.hpp"

namespace facetmill::simplification {

namespace {

using Method = SimplifySettings::Method;

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorKind::usage, "E-RANGE", "simplify: " + what);
}

void check_ratio(double ratio) {
    if (!(ratio > 0 && ratio <= 1)) refuse("ratio is 0 < x <= 1, not " + to_string(ratio));
}

void check_weights(const AttributeWeights& w) {
    for (const double weight : {w.uv, w.normal, w.colour, w.skin})
        if (!(weight >= 0 && std::isfinite(weight))) refuse("weights are at least 0, not " + to_string(weight));
}

void check_cluster(const SimplifySettings& s) {
    if (s.lock.boundary || s.lock.seams || s.lock.groups || !s.lock.body.empty() || !s.lock.vertices.empty())
        refuse("cluster cannot hold vertices: no lock");
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

} // namespace facetmill::simplification
