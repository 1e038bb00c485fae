#include "geometry/spatial/components_around.hpp"

#include "geometry/spatial/rays.hpp"

#include <map>

namespace facetmill {

std::vector<Index> components_around(const FaceTree& tree, const Vec3& p,
                                     const std::vector<Index>& component_of,
                                     const std::function<bool(Index component)>& counts) {
    std::map<Index, int> turns;
    visit_along_axis(tree, p, 0, true, [&](Index f, int way) {
        if (counts(component_of[f])) turns[component_of[f]] += way;
    });
    std::vector<Index> around;
    for (const auto& [component, n] : turns)
        if (n != 0) around.push_back(component);
    return around;
}

} // namespace facetmill
