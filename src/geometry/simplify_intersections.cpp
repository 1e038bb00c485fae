// Simplification without new self-intersections: what runs into each other is held and the rest done again.

#include "geometry/self_intersections.hpp"
#include "geometry/simplify_work.hpp"

namespace facetmill::simplification {

std::size_t hold_intersecting(const Work& s, const Mesh& now, std::size_t allowed,
                              std::vector<std::uint8_t>& held) {
    const SelfIntersections found = find_self_intersections(now, {.limit = SIZE_MAX});
    if (found.count <= allowed) return found.count;
    std::vector<std::uint8_t> bad(held.size());
    for (const auto& [f, g] : found.pairs)
        for (const Index face : {f, g})
            for (Index k = 0; k < 3; ++k) bad[s.source[now.vertex(3 * face + k)]] = 1;
    // What went into a bad vertex is bad; from the last step, so that the fate of a is known.
    for (auto step = s.log.steps.rbegin(); step != s.log.steps.rend(); ++step) bad[step->b] |= bad[step->a];
    for (std::size_t v = 0; v < held.size(); ++v) held[v] |= bad[v];
    return found.count;
}

} // namespace facetmill::simplification
