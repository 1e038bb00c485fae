#include "geometry/deviation/itself.hpp"

#include "geometry/deviation/area_samples.hpp"

#include <algorithm>

namespace facetmill {

bool are_same(const Surface& first, const Surface& second) {
    return first.corners == second.corners && first.positions == second.positions &&
           std::all_of(first.positions.begin(), first.positions.end(),
                       [](const Vec3& p) { return is_finite(p); });
}

DirectedDeviation deviation_from_itself(const Surface& surface, const DeviationSettings& settings) {
    DirectedDeviation d;
    std::vector<std::uint8_t> used(surface.positions.size());
    for (const Index v : surface.corners) used[v] = 1;
    d.vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
    d.samples = AreaSamples(surface, settings.samples, settings.seed).size();
    if (settings.means) d.averaged = d.samples > 0 ? d.samples : d.vertices;
    return d;
}

} // namespace facetmill
