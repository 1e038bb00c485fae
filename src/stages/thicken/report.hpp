#pragma once
// What thicken says of a part.

#include "stages/thicken/options.hpp"

#include <variant>

namespace facetmill::thicken_stage {

/// Of a surface that became a solid.
struct ThickenedSurface {
    std::string part;
    ThickenResult result;
    bool has_faces = true;
    bool looked = false; ///< for self-intersections
};
/// Of edges that became cylinders.
struct ThickenedEdges {
    std::string part;
    std::size_t cylinders = 0, without_length = 0;
};
using ThickenedPart = std::variant<ThickenedSurface, ThickenedEdges>;

struct ThickenReport {
    std::vector<ThickenedPart> parts;
};
void declare_thicken_report(DeclareFields<ThickenReport>& d);

/// Warns where the solid is open, thinner than asked for (in world units), or runs into itself.
void warn_of_walls(const Part& part, const ThickenResult& r, double thickness, const ThickenOptions& o,
                   Context& context);

} // namespace facetmill::thicken_stage
