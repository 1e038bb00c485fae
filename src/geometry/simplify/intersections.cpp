// Simplification without new self-intersections: where the result runs into itself less error is allowed, and
// all is done again.

#include "geometry/intersect/self_intersections.hpp"
#include "geometry/simplify/work.hpp"

namespace facetmill::simplification {

namespace {

constexpr float share_left = 1.0f / 4; // of a squared error: half the distance

/// Of each vertex of the mesh that came in, the largest squared error of the steps that went into it.
std::vector<float> largest_errors(const Work& s, std::size_t vertices) {
    std::vector<float> largest(vertices, 0);
    for (const Step& step : s.log.steps)
        largest[step.a] = std::max({largest[step.a], largest[step.b], step.error});
    return largest;
}

} // namespace

std::size_t limit_intersecting(const Work& s, const Mesh& now, std::size_t allowed, bool to_zero,
                               std::vector<float>& limits) {
    const SelfIntersections found = find_self_intersections(now, {.limit = SIZE_MAX});
    if (found.count <= allowed) return found.count;
    const std::vector<float> largest = largest_errors(s, limits.size());
    std::vector<float> wanted(limits.size(), never);
    for (const auto& [f, g] : found.pairs)
        for (const Index face : {f, g})
            for (Index k = 0; k < 3; ++k) {
                const Index v = s.source[s.tri[3 * face + k]];
                wanted[v] = to_zero ? 0 : largest[v] * share_left;
            }
    // What went into a vertex has its limit; from the last step, so that the fate of a is known.
    for (auto step = s.log.steps.rbegin(); step != s.log.steps.rend(); ++step)
        wanted[step->b] = std::min(wanted[step->b], wanted[step->a]);
    for (std::size_t v = 0; v < limits.size(); ++v) limits[v] = std::min(limits[v], wanted[v]);
    return found.count;
}

} // namespace facetmill::simplification
